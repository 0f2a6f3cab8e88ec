# SPDX-License-Identifier: MIT
"""What the depth particle tracker keeps from frame to frame."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.model import DepthModel
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.signature import Signature
from tricue.track.depth_particle.walk import Walk

Floats = NDArray[np.float64]


class ParticleSet(NamedTuple):
    """Weighted states (N, 5), their expected value and its covariance."""

    particles: Floats
    weights: Floats
    state: Floats
    covariance: Floats

    @classmethod
    def of(cls, k: Kernels, particles: Floats, weights: Floats) -> "ParticleSet":
        """With their expected value."""
        state, covariance, _ = k.summarize(particles, weights)
        return cls(particles, weights, state, covariance)

    @classmethod
    def gathered(cls, state: Floats, n: int) -> "ParticleSet":
        """n particles at one place."""
        return cls(np.repeat(state[None], n, axis=0), np.full(n, 1 / n), state, np.zeros((5, 5)))


class State(NamedTuple):
    """All that changes from frame to frame."""

    shape: tuple[int, ...]
    camera: Floats  # (4,) fx, fy, cx, cy
    plane: Floats
    model: DepthModel
    walk: Walk
    signature: Signature
    particles: ParticleSet
    objects: Objects
    score: float
    mean: float  # running mean of the log-likelihood
    mean_filled: float  # the same of the share of the rectangle that is at the target's depth
    random: dict[str, Any]  # of the random numbers' generator
    timestamp: float | None
    missed: float = 0.0  # seconds for which it was not seen
    hidden: bool = False  # by something nearer
    spread: Floats | float = 0.0  # metres, (3,) of X, Y, Z: how far a target that isn't seen may have gone
    occluder: Floats | None = None  # (3,) metres: where that is, while the target is missed

    def lost(self, p: DepthParticleParams) -> bool:
        """Whether it has been gone for long, though nothing is in front of it."""
        return self.missed >= p.lost_after and not self.hidden
