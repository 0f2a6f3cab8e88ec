# SPDX-License-Identifier: MIT
"""How a person moves in front of a depth camera: (39) in metres, at the speed of a walk, of one size."""

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.prediction import Prediction
from tricue.track.depth_particle.params import DepthParticleParams

Floats = NDArray[np.float64]

STAND = np.array([0.03, 0.02, 0.03])  # metres of position noise in no time
UPRIGHT = np.array([1.0, 0.3, 1.0])  # people move up and down less than about
RETURN = 0.3  # per frame, of the size to the remembered one
MAX_SPREAD_TIME = 1.0  # seconds for which a hidden target's place gets less certain
EARLY = 0.7  # rate at which a size is learned when it is seen whole for the first time
SMALLEST = 0.1  # metres


class Walk(NamedTuple):
    """The target in metres, camera frame: state (5,) X, Y, Z of its rectangle's centre, width, height.

    velocity: (3,) m/s, smoothed. size: (2,) the usual width and height. known: (2,) whether they were ever
    seen whole; until then they are lower bounds.
    """

    state: Floats
    velocity: Floats
    size: Floats
    known: NDArray[np.bool_]

    @classmethod
    def start(cls, state: Floats, known: NDArray[np.bool_]) -> "Walk":
        """At rest."""
        return cls(state, np.zeros(3), state[3:].copy(), known)

    def predict(self, p: DepthParticleParams, seconds: float, missed: float) -> Prediction:
        """Where particles go next in so many seconds; missed: seconds before them without the target.

        The noise, K of (39), grows with both.
        """
        drift = np.concatenate([self.velocity * seconds, RETURN * (self.size - self.state[3:])])
        time = min(seconds + missed, max(seconds, MAX_SPREAD_TIME))
        noise = STAND + p.agility * time * UPRIGHT
        scale = np.concatenate([noise, p.size_noise * self.size])
        return Prediction(drift, scale, *_bounds(p.near, p.far))

    def seen(self, state: Floats, p: DepthParticleParams, seconds: float, steady: bool) -> "Walk":
        """At a new place; the velocity is learned where both this place and the last were ``steady``."""
        velocity = self.velocity
        if steady:
            step = (state[:3] - self.state[:3]) / seconds
            step *= min(1.0, p.fastest / max(math.hypot(*step.tolist()), 1e-9))
            velocity = velocity + p.velocity_rate * (step - velocity)
        return self._replace(state=state, velocity=velocity)

    def coasted(self, state: Floats, keep: float) -> "Walk":
        """At a predicted place, with a share of the velocity kept."""
        return self._replace(state=state, velocity=keep * self.velocity)

    def outgrown(self, size: Floats) -> "Walk":
        """A size never seen whole is at least what is seen of it."""
        if self.known.all():
            return self
        return self._replace(size=np.where(self.known, self.size, np.maximum(self.size, size)))

    def measured(self, size: Floats, whole: NDArray[np.bool_], p: DepthParticleParams) -> "Walk":
        """The usual size, learned from what is seen; where that is cut, it is at least so much."""
        seen = size if whole.all() else np.where(whole, size, np.maximum(size, self.size))
        rate = p.size_rate if self.known.all() else np.where(whole & ~self.known, EARLY, p.size_rate)
        return self._replace(size=self.size + rate * (seen - self.size), known=self.known | whole)


@cache
def _bounds(near: float, far: float) -> tuple[Floats, Floats]:
    """The least and the greatest state."""
    lower = np.array([-np.inf, -np.inf, near, SMALLEST, SMALLEST])
    return lower, np.array([np.inf, np.inf, far, np.inf, np.inf])
