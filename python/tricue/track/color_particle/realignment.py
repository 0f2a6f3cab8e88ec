# SPDX-License-Identifier: MIT
"""Looking near the estimate for what the first frame showed.

A model that learns what it follows wanders off by small errors, which add up over thousands of frames. The
first frame's appearance doesn't. Wherever it is surely seen, and better than at the estimate, the target is.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.state import ParticleSet

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

WINDOWS, BLOCKS = 48, 32  # looked at in a frame; blocks of windows, which take turns
NEAR, FAR = 0.1, 0.3  # standard deviations of the windows' places, of the target's sides: half of them each
SCALE = 0.05  # standard deviation of the logarithm of their size
CLOSER = 0.3  # a second look, around the best window, is as much closer
MIN_LOG_LIKELIHOOD = 0.0  # nats: by its colors and ranks together it is the target
GAIN_TO_FORGET = 10.0  # nats: so much better than the estimate, what was learned wasn't the target


def _patterns(closer: float) -> list[Floats]:
    """BLOCKS of (4, 4 n): an ellipse (4,) times one of them gives n windows, first the ellipse itself."""
    normal = np.random.default_rng(0).standard_normal((BLOCKS, WINDOWS, 3))  # any numbers do: drawn once
    spread = 2 * closer * np.repeat([NEAR, FAR], WINDOWS // 2)[:, None]  # semi-axes
    linear = np.tile(np.eye(4), (BLOCKS, WINDOWS + 1, 1, 1))
    linear[:, 1:, [2, 3], [0, 1]] = spread * normal[..., :2]
    linear[:, 1:, [2, 3], [2, 3]] = np.exp(closer * SCALE * normal[..., 2:])
    return list(np.ascontiguousarray(linear.transpose(0, 2, 1, 3)).reshape(BLOCKS, 4, -1))


FIRST_LOOK, CLOSER_LOOK = _patterns(1.0), _patterns(CLOSER)


class Realignment(NamedTuple):
    """Where the first frame's appearance is seen best, (4,), and how much better than at the estimate, nats.

    log_likelihood: there, by the first frame's appearance.
    """

    ellipse: Floats
    log_likelihood: float
    gain: float


def realign(k: Kernels, image: Image, first: Appearance, ellipse: Floats, block: int) -> Realignment:
    """Look around an ellipse (4,); the gain is 0, and the ellipse the same, where nothing better is sure."""
    best, most, here = _look(k, image, first, ellipse, FIRST_LOOK[block % BLOCKS])
    if most <= max(here, MIN_LOG_LIKELIHOOD):
        return Realignment(ellipse, here, 0.0)
    best, most, _ = _look(k, image, first, best, CLOSER_LOOK[block % BLOCKS])
    return Realignment(best, most, most - here)


def moved(
    k: Kernels, image: Image, appearance: Appearance, particles: ParticleSet, ellipse: Floats, bounds: Floats
) -> ParticleSet:
    """Particles whose estimate is another ellipse (4,), within bounds (2, 4): all move as it does."""
    shifted = np.clip(particles.particles + (ellipse - particles.ellipse), *bounds)
    log_likelihood = float(appearance.log_likelihood(k, image, ellipse[None])[0])
    seen = appearance.observe(k, image, ellipse)
    return particles._replace(particles=shifted, ellipse=ellipse, log_likelihood=log_likelihood, seen=seen)


def _look(
    k: Kernels, image: Image, first: Appearance, ellipse: Floats, pattern: Floats
) -> tuple[Floats, float, float]:
    """The window that is most like the first frame's target, its log-likelihood, and that of the ellipse."""
    windows = (ellipse @ pattern).reshape(-1, 4)
    log_likelihood = first.log_likelihood(k, image, windows).tolist()
    most = max(log_likelihood)
    return windows[log_likelihood.index(most)], most, log_likelihood[0]
