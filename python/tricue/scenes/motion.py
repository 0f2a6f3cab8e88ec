# SPDX-License-Identifier: MIT
"""Paths along which a target moves, and steps by which its brightness changes."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def wander(frames: int, reach: tuple[float, float], max_speed: float, rng: np.random.Generator) -> Array:
    """A smooth nonlinear motion, (frames, 2) offsets in pixels within ±reach, no step longer than
    ``max_speed``.

    The target runs along a closed Lissajous curve with random phases. As its position is an arc length on
    that curve, and a chord is never longer than its arc, the speed of the run bounds the steps.
    """
    if frames < 1:
        raise ValueError(f"frames: expected 1 or more, got {frames}")
    if not (max_speed > 0 and np.isfinite(max_speed)):
        raise ValueError(f"max_speed: expected pixels a frame above 0, got {max_speed}")
    angle = np.linspace(0, 2 * np.pi, 4001)
    phase = rng.uniform(0, 2 * np.pi, 4)
    x = reach[0] * (0.8 * np.sin(angle + phase[0]) + 0.2 * np.sin(3 * angle + phase[1]))
    y = reach[1] * (0.8 * np.sin(2 * angle + phase[2]) + 0.2 * np.sin(3 * angle + phase[3]))
    arc = np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(y))))
    travelled = np.cumsum(_speeds(frames, max_speed, rng)) % arc[-1]
    return np.column_stack([np.interp(travelled, arc, x), np.interp(travelled, arc, y)])


def _speeds(frames: int, max_speed: float, rng: np.random.Generator) -> Array:
    """Speeds between a tenth of ``max_speed`` and all of it, two waves of 23 and 37 frames added."""
    turns = np.arange(frames)[:, None] / [23.0, 37.0] + rng.random(2)
    wave = (np.sin(2 * np.pi * turns).sum(axis=1) + 2) / 4
    speeds: Array = max_speed * (0.1 + 0.9 * wave / wave.max())
    return speeds


def steps(frames: int, low: float, high: float, rng: np.random.Generator) -> Array:
    """A gain per frame: 1 at first, then changed abruptly every 10 to 20 frames, by a quarter of [low, high]
    or more.
    """
    gains = np.ones(frames)
    start = int(rng.integers(10, 21))
    while start < frames:
        # Adding a quarter to three quarters of a circle keeps away from where it was, on both sides.
        share = (gains[start - 1] - low) / (high - low) + rng.uniform(0.25, 0.75)
        gains[start:] = low + (share % 1.0) * (high - low)
        start += int(rng.integers(10, 21))
    return gains
