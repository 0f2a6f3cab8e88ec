# SPDX-License-Identifier: MIT
"""The motion model of a person walking in front of a depth camera: (39) in meters, nearly constant size."""

import math
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.track.depth_particle.params import DepthParticleParams

MIN_POSITION_NOISE = (0.03, 0.02, 0.03)  # meters of X, Y, Z, standard deviation at zero elapsed time
AXIS_NOISE = (1.0, 0.3, 1.0)  # times position_noise; people move less vertically than horizontally
SIZE_RETURN = 0.3  # per frame, of the size to its running mean
MAX_NOISE_TIME = 1.0  # seconds over which the noise of a missed target's particles grows
FIRST_SIZE_RATE = 0.7  # learning rate of a fully visible size until it is known
MIN_SIZE = 0.1  # meters
NO_DRIFT = np.zeros(5)


class RectanglePrediction(NamedTuple):
    """p(x' | x) = N(x + drift, diag(scale²)) between lower and upper, (5,) each, of a rectangle."""

    drift: Floats
    scale: Floats
    lower: Floats
    upper: Floats


class BodyMotion(NamedTuple):
    """The target's rectangle in the camera frame, and its motion.

    state: (5,) X, Y, Z of its center, width, height, meters. velocity: (3,) m/s, smoothed.
    mean_size: (2,) running mean of width and height, meters. size_known: (2,) whether each was ever fully
    visible; until then it is a lower bound.
    """

    state: Floats
    velocity: Floats
    mean_size: Floats
    size_known: NDArray[np.bool_]

    @classmethod
    def start(cls, state: Floats, size_known: NDArray[np.bool_]) -> "BodyMotion":
        """The motion of a target at rest."""
        return cls(state, np.zeros(3), state[3:].copy(), size_known)

    def predict(self, p: DepthParticleParams, seconds: float, missed: float) -> RectanglePrediction:
        """The particles' transition density over a number of seconds.

        The noise, K of (39), grows with the speed, with ``seconds``, and with ``missed``, the seconds for
        which the target was missing before.
        """
        # Scalars, because arrays of two or three are slower.
        (vx, vy, vz), (mean_width, mean_height) = self.velocity.tolist(), self.mean_size.tolist()
        drift = NO_DRIFT
        if p.motion == "velocity":
            width, height = self.state[3:].tolist()
            to_mean = SIZE_RETURN * (mean_width - width), SIZE_RETURN * (mean_height - height)
            drift = np.array((vx * seconds, vy * seconds, vz * seconds, *to_mean))
        position = self.position_deviation(p, min(seconds + missed, max(seconds, MAX_NOISE_TIME)))
        scale = np.array((*position, p.size_noise * mean_width, p.size_noise * mean_height))
        return RectanglePrediction(drift, scale, *_bounds(p.near, p.far))

    def position_deviation(
        self, p: DepthParticleParams, seconds: float, before: Sequence[float] = MIN_POSITION_NOISE
    ) -> tuple[float, float, float]:
        """The standard deviations of X, Y, Z after a number of seconds, and ``before`` them, meters."""
        growth = (p.position_noise + p.speed_noise * math.hypot(*self.velocity.tolist())) * seconds
        (x, y, z), (along_x, along_y, along_z) = before, AXIS_NOISE
        return x + growth * along_x, y + growth * along_y, z + growth * along_z

    def update(self, state: Floats, p: DepthParticleParams, seconds: float, visible: bool) -> "BodyMotion":
        """Move to a new estimate; its step updates the velocity if both positions were ``visible``."""
        velocity = self.velocity
        if visible:
            # Scalars, as above.
            (x, y, z, _, _), (x0, y0, z0, _, _) = state.tolist(), self.state.tolist()
            vx, vy, vz = (x - x0) / seconds, (y - y0) / seconds, (z - z0) / seconds
            share, rate = min(1.0, p.max_speed / max(math.hypot(vx, vy, vz), 1e-9)), p.velocity_rate
            x, y, z = velocity.tolist()
            smoothed = x + rate * (vx * share - x), y + rate * (vy * share - y), z + rate * (vz * share - z)
            velocity = np.array(smoothed)
        return BodyMotion(state, velocity, self.mean_size, self.size_known)

    def coast(self, state: Floats, velocity_kept: float) -> "BodyMotion":
        """Move to a predicted state, and keep a share of the velocity."""
        return self._replace(state=state, velocity=velocity_kept * self.velocity)

    def grow(self, size: Floats) -> "BodyMotion":
        """Raise mean sizes that are lower bounds to at least the visible part's size (2,)."""
        if all(self.size_known.tolist()):
            return self
        mean_size = np.where(self.size_known, self.mean_size, np.maximum(self.mean_size, size))
        return self._replace(mean_size=mean_size)

    def learn_size(self, size: Floats, whole: NDArray[np.bool_], p: DepthParticleParams) -> "BodyMotion":
        """Blend in a size (2,), where it is ``whole`` (2,).

        It counts as known from then on if the other one is whole or known: if somebody is cut at the waist,
        the hidden part may be wider.
        """
        if all(whole.tolist()) and all(self.size_known.tolist()):
            (width, height), (mean_width, mean_height) = size.tolist(), self.mean_size.tolist()
            mean_width += p.size_rate * (width - mean_width)
            mean_height += p.size_rate * (height - mean_height)
            return BodyMotion(self.state, self.velocity, np.array((mean_width, mean_height)), self.size_known)
        size = np.where(whole, size, self.mean_size)
        known = whole & (whole | self.size_known)[::-1]
        first = whole & ~self.size_known
        rate = p.size_rate if self.size_known.all() else np.where(first, FIRST_SIZE_RATE, p.size_rate)
        mean_size = self.mean_size + rate * (size - self.mean_size)
        return self._replace(mean_size=mean_size, size_known=self.size_known | known)


@cache
def _bounds(near: float, far: float) -> tuple[Floats, Floats]:
    """Lower and upper bounds (5,) of a state, meters."""
    lower = np.array([-np.inf, -np.inf, near, MIN_SIZE, MIN_SIZE])
    return lower, np.array([np.inf, np.inf, far, np.inf, np.inf])
