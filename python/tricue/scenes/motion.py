# SPDX-License-Identifier: MIT
"""Random motion over time: paths in the image, smooth oscillations, and steps of brightness."""

import numpy as np

from tricue.camera.numbers import positive, positive_whole
from tricue.scenes.arrays import Array


def sample_path(frames: int, reach: tuple[float, float], max_speed: float, rng: np.random.Generator) -> Array:
    """A smooth random path: offsets (frames, 2), pixels, within ±reach, at most ``max_speed`` per frame.

    Each axis is a sum of two sines with random phases; the speed is uneven, lower in turns. A step is at most
    the curve's largest derivative times the step of its parameter, which bounds the speed.
    """
    positive_whole(frames, "frames", "a count")
    positive(max_speed, "max_speed", "pixels per frame")
    phases = rng.uniform(0, 2 * np.pi, (2, 2))
    size = np.array(reach)[:, None] * _SHARES
    longest = np.hypot(*_sines(np.linspace(0, 2 * np.pi, 4001), phases + np.pi / 2, size * _TURNS).T).max()
    pace = 0.8 + 0.2 * np.sin(2 * np.pi * (np.arange(frames) / 23 + rng.random()))
    return _sines(np.cumsum(pace) * max_speed / longest, phases, size)


_SHARES = np.array([0.75, 0.25])
_TURNS = np.array([[1.0, 3.0], [2.0, 3.0]])  # periods of each axis' two sines in one round of the curve


def _sines(angle: Array, phases: Array, size: Array) -> Array:
    """The curve (n, 2) at each angle; with phases + pi / 2 and sizes times _TURNS it is the derivative."""
    curve: Array = (size * np.sin(angle[:, None, None] * _TURNS + phases)).sum(axis=2)
    return curve


def sample_gain_steps(frames: int, low: float, high: float, rng: np.random.Generator) -> Array:
    """A gain per frame: 1 at first, then a jump every 10 to 20 frames, by at least a quarter of the range."""
    gains = np.ones(frames)
    start = int(rng.integers(10, 21))
    while start < frames:
        # Adding a quarter to three quarters, modulo 1, keeps the distance from the last share.
        share = (gains[start - 1] - low) / (high - low) + rng.uniform(0.25, 0.75)
        gains[start:] = low + (share % 1.0) * (high - low)
        start += int(rng.integers(10, 21))
    return gains


def sample_sway(time: Array, shortest: float, longest: float, rng: np.random.Generator) -> Array:
    """A smooth oscillation (M,) within [-1, 1]: two sines with periods in this range, seconds."""
    periods, phases = rng.uniform(shortest, longest, 2), rng.uniform(0, 2 * np.pi, 2)
    waves: Array = np.sin(2 * np.pi * time[:, None] / periods + phases) @ [0.65, 0.35]
    return waves
