# SPDX-License-Identifier: MIT
"""Turned samples of a picture: the nearest ones of an upright square around them.

Upright squares are sampled fast, and a target is mostly upright.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.arrays import Floats
from tricue.track.fused.target import axes

Places = NDArray[np.int64]

UPRIGHT_SHARE = 1.5  # side of the upright square in sides of the turned one; sqrt(2) at least
DENSITY = 2  # of the upright square's pixels, so that the nearest one is near


def upright_side(side: int) -> int:
    """Pixels a side of the upright square around a turned one of so many."""
    return round(DENSITY * UPRIGHT_SHARE * side)


@lru_cache(maxsize=256)
def turned_grid(turn: int, side: int) -> Places:
    """(side, side) places of a turned square's pixels in the upright one around it."""
    steps = DENSITY * (np.arange(side, dtype=np.float64) + 0.5 - side / 2)
    return nearest_pixels(steps[None, :], steps[:, None], turn, upright_side(side))


def nearest_pixels(right: Floats, down: Floats, turn: int, side: int) -> Places:
    """Places (y side + x) in a square patch of points, given in pixels from its center along turned axes."""
    cosine, sine = axes(turn)
    x, y = (
        np.clip(np.floor(side / 2 + offset), 0, side - 1)
        for offset in (cosine * right - sine * down, sine * right + cosine * down)
    )
    places: Places = (y * side + x).astype(np.int64)
    return places
