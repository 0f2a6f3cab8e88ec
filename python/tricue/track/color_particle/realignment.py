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
from tricue.track.color_particle.state import ColorParticleSet

WINDOWS, BLOCKS = 32, 32  # windows per frame, with the estimate; blocks of windows, used in turn
NEAR, FAR = 0.1, 0.3  # standard deviations of the windows' positions, in target sides; in turn
SCALE = 0.05  # standard deviation of the logarithm of their size
CLOSER = 0.3  # the second search, around the best window, has these deviations times this
MIN_LOG_LIKELIHOOD = 0.0  # nats; colors and ranks together say that it is the target
GAIN_TO_FORGET = 10.0  # nats; if another window is this much better, what was learned wasn't the target

Sizes = tuple[tuple[float, float], tuple[float, float]]  # smallest and largest semi-axes, pixels
ANY_SIZE: Sizes = (0.0, 0.0), (math.inf, math.inf)


def _even_numbers(n: int) -> Floats:
    """(n, 3) numbers in [0, 1) that fill the cube more evenly than random ones, Roberts' sequence R3."""
    root = 1.2207440846057596  # of x**4 = x + 1
    return np.modf(0.5 + np.outer(np.arange(1, n + 1), [root**-1, root**-2, root**-3]))[0]


def _offsets(closer: float) -> list[Floats]:
    """BLOCKS arrays (WINDOWS - 1, 4): shifts, semi-axes, and factors of the windows around an ellipse.

    Shifts are normal, by Box and Muller; the logarithm of the factor is uniform. Windows that are nearer keep
    the size from drifting no better, and find what is hardly better twice as often.
    """
    first, second, third = np.moveaxis(_even_numbers(BLOCKS * WINDOWS).reshape(BLOCKS, WINDOWS, 3), 2, 0)
    radius = 2 * closer * np.resize([FAR, NEAR], WINDOWS) * np.sqrt(-2 * np.log(1 - first))
    angle = 2 * np.pi * second
    factor = np.exp(closer * SCALE * np.sqrt(12) * (third - 0.5))
    offsets = np.stack([radius * np.cos(angle), radius * np.sin(angle), factor, factor], axis=2)
    return list(offsets[:, 1:].copy())


FIRST_LOOK, CLOSER_LOOK = _offsets(1.0), _offsets(CLOSER)


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
    best, highest, here = first.best_near(k, image, ellipse, FIRST_LOOK[block % BLOCKS])
    if highest <= max(here, MIN_LOG_LIKELIHOOD):
        return Realignment(ellipse, here, 0.0)
    best, highest, _ = first.best_near(k, image, best, CLOSER_LOOK[block % BLOCKS])
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
    k: Kernels,
    image: Image,
    appearance: Appearance,
    particles: ColorParticleSet,
    ellipse: Floats,
    bounds: Floats,
) -> ColorParticleSet:
    """The particles, moved so that their estimate is another ellipse (4,); clipped to bounds (2, 4)."""
    shifted = np.clip(particles.particles + (ellipse - particles.ellipse), *bounds)
    log_likelihood = float(appearance.log_likelihood(k, image, ellipse[None])[0])
    seen = appearance.observe(k, image, ellipse)
    return particles._replace(particles=shifted, ellipse=ellipse, log_likelihood=log_likelihood, seen=seen)
