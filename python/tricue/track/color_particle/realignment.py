# SPDX-License-Identifier: MIT
"""Realignment: searches near the estimate for the first frame's appearance.

A model that learns what it follows drifts: small errors add up over thousands of frames. The first frame's
appearance doesn't drift. Where it is recognized with certainty, and better than at the estimate, is the
target.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image
from tricue.kernels import Kernels
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.state import ParticleSet

WINDOWS, BLOCKS = 48, 32  # windows per frame; blocks of windows, used in turn
NEAR, FAR = 0.1, 0.3  # standard deviations of the windows' positions, in target sides; half of them each
SCALE = 0.05  # standard deviation of the logarithm of their size
CLOSER = 0.3  # the second search, around the best window, has these deviations times this
MIN_LOG_LIKELIHOOD = 0.0  # nats; colors and ranks together say that it is the target
GAIN_TO_FORGET = 10.0  # nats; if another window is this much better, what was learned wasn't the target

Sizes = tuple[tuple[float, float], tuple[float, float]]  # smallest and largest semi-axes, pixels
ANY_SIZE: Sizes = (0.0, 0.0), (math.inf, math.inf)


def _patterns(closer: float) -> list[Floats]:
    """BLOCKS matrices (4, 4 n): an ellipse (4,) times one gives n windows, first the ellipse itself."""
    normal = np.random.default_rng(0).standard_normal((BLOCKS, WINDOWS, 3))  # any numbers do; drawn once
    spread = 2 * closer * np.repeat([NEAR, FAR], WINDOWS // 2)[:, None]  # semi-axes
    linear = np.tile(np.eye(4), (BLOCKS, WINDOWS + 1, 1, 1))
    linear[:, 1:, [2, 3], [0, 1]] = spread * normal[..., :2]
    linear[:, 1:, [2, 3], [2, 3]] = np.exp(closer * SCALE * normal[..., 2:])
    return list(np.ascontiguousarray(linear.transpose(0, 2, 1, 3)).reshape(BLOCKS, 4, -1))


FIRST_LOOK, CLOSER_LOOK = _patterns(1.0), _patterns(CLOSER)


class Realignment(NamedTuple):
    """The ellipse (4,) most like the first frame's appearance, and its gain over the estimate, nats.

    log_likelihood: of the ellipse, by the first frame's appearance.
    """

    ellipse: Floats
    log_likelihood: float
    gain: float


def realign(
    k: Kernels, image: Image, first: Appearance, ellipse: Floats, block: int, sizes: Sizes = ANY_SIZE
) -> Realignment:
    """Search around an ellipse (4,); without a certain, better one the gain is 0 and the ellipse the same.

    sizes: bounds of the semi-axes.
    """
    best, highest, here = _look(k, image, first, ellipse, FIRST_LOOK[block % BLOCKS])
    if highest <= max(here, MIN_LOG_LIKELIHOOD):
        return Realignment(ellipse, here, 0.0)
    best, highest, _ = _look(k, image, first, best, CLOSER_LOOK[block % BLOCKS])
    (min_minor, min_major), (max_minor, max_major) = sizes
    x, y, minor, major = best.tolist()
    allowed = min(max(minor, min_minor), max_minor), min(max(major, min_major), max_major)
    if allowed != (minor, major):
        best = np.array([x, y, *allowed])
        highest = float(first.log_likelihood(k, image, best[None])[0])
        if highest <= here:
            return Realignment(ellipse, here, 0.0)
    return Realignment(best, highest, highest - here)


def moved(
    k: Kernels, image: Image, appearance: Appearance, particles: ParticleSet, ellipse: Floats, bounds: Floats
) -> ParticleSet:
    """The particles, moved so that their estimate is another ellipse (4,); clipped to bounds (2, 4)."""
    shifted = np.clip(particles.particles + (ellipse - particles.ellipse), *bounds)
    log_likelihood = float(appearance.log_likelihood(k, image, ellipse[None])[0])
    seen = appearance.observe(k, image, ellipse)
    return particles._replace(particles=shifted, ellipse=ellipse, log_likelihood=log_likelihood, seen=seen)


def _look(
    k: Kernels, image: Image, first: Appearance, ellipse: Floats, pattern: Floats
) -> tuple[Floats, float, float]:
    """The window most like the first frame's target, its log-likelihood, and that of the ellipse itself."""
    windows = (ellipse @ pattern).reshape(-1, 4)
    log_likelihood = first.log_likelihood(k, image, windows).tolist()
    highest = max(log_likelihood)
    return windows[log_likelihood.index(highest)], highest, log_likelihood[0]
