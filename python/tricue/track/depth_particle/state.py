# SPDX-License-Identifier: MIT
"""The state that the depth particle tracker keeps from frame to frame."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.depth_model import DepthModel
from tricue.track.depth_particle.motion import BodyMotion
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.signature import Signature


class DepthParticleSet(NamedTuple):
    """Weighted particles and their estimate.

    particles: (N, 5) X, Y, Z, width, height, meters. weights: (N,) with sum 1. state: (5,) mean and
    covariance (5, 5) of the weighted particles.
    """

    particles: Floats
    weights: Floats
    state: Floats
    covariance: Floats

    @classmethod
    def at_state(cls, state: Floats, n: int) -> "DepthParticleSet":
        """n particles with the same state (5,) and weight."""
        return cls(np.repeat(state[None], n, axis=0), np.full(n, 1 / n), state, np.zeros((5, 5)))


class DepthParticleState(NamedTuple):
    """Everything that changes from frame to frame; immutable, ``update`` replaces it."""

    shape: tuple[int, ...]  # of the first frame
    camera: Floats  # (4,) fx, fy, cx, cy, pixels
    plane: Floats  # (6,) the floor, as find_floor gives it
    model: DepthModel
    motion: BodyMotion
    signature: Signature
    particles: DepthParticleSet
    objects: Objects  # of the last frame
    others: NDArray[np.float32]  # (h, w) meters, the depth last seen in each pixel apart from the target
    score: float
    mean_log_likelihood: float  # running mean over the frames in which the target was learned
    mean_inside: float  # the same, for the share of the rectangle at the target's depth
    timestamp: float | None
    frames: int = 0  # since the first
    missed_seconds: float = 0.0
    occluded: bool = False  # whether the target is missed because something is in front of it
    position_spread: Floats | None = None  # (3,) meters, standard deviation of X, Y, Z of a missed target
    occluder: Floats | None = None  # (3,) meters, position of what hides the target, while it is missed

    def is_lost(self, p: DepthParticleParams) -> bool:
        """Whether the target is LOST: missed for long although nothing is in front of it."""
        return self.missed_seconds >= p.lost_after and not self.occluded
