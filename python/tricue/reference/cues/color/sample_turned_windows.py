# SPDX-License-Identifier: MIT
"""Turned windows of an image, resampled on a grid; averaged where the grid is coarser than the pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import (
    MAX_IMAGE_SIDE,
    refuse,
    require_count,
    require_finite,
    require_shape,
)

UNIT = 16  # places are rounded to this fraction of a pixel, so that integer sums are exact in any order
MAX_SIDE = 4  # pixels: side of the square that a sample is the mean of

Whole = NDArray[np.intp]


def sample_turned_windows(
    image: NDArray[np.uint8], windows: Floats, rows: int, columns: int
) -> NDArray[np.uint8]:
    """Adds up the pixels of all squares of a window at once, for one place in the squares at a time."""
    _require_arguments(image, windows, rows, columns)
    height, width = image.shape[:2]
    repeated = ((0, int(height == 1)), (0, int(width == 1)), (0, 0))
    levels = np.pad(image, repeated, mode="edge").astype(np.intp)
    height, width = levels.shape[:2]
    samples = np.empty((len(windows), rows, columns, 3), np.uint8)
    for i, (x, y, right_x, right_y, down_x, down_y) in enumerate(windows.tolist()):
        step = min(_step(right_x, right_y, columns), _step(down_x, down_y, rows))
        side = min(int(min(max(step + 0.5, 1.0), MAX_SIDE)), height - 1, width - 1)
        left = _fixed(_corners(x, right_x / columns, columns, down_x / rows, rows, side), width - side)
        top = _fixed(_corners(y, right_y / columns, columns, down_y / rows, rows, side), height - side)
        sums = np.zeros((rows, columns, 3), np.intp)
        for row, high in _covered(top, side, height):
            for column, wide in _covered(left, side, width):
                sums += (high * wide)[..., None] * levels[row, column]
        whole = (UNIT * side) ** 2
        samples[i] = (2 * sums + whole) // (2 * whole)
    return samples


def _step(x: float, y: float, count: int) -> float:
    """The distance between consecutive samples, pixels, for so many along a vector."""
    with np.errstate(over="ignore"):
        return float(np.sqrt(np.float64(x) * x + np.float64(y) * y) / count)


def _corners(middle: float, right: float, columns: int, down: float, rows: int, side: int) -> Floats:
    """(rows, columns) one coordinate of the squares' top left corners, pixels."""
    with np.errstate(over="ignore", invalid="ignore"):
        starts = middle - 0.5 * side + (np.arange(rows) + 0.5 - 0.5 * rows) * down
        corners: Floats = starts[:, None] + (np.arange(columns) + 0.5 - 0.5 * columns) * right
    return corners


def _fixed(corners: Floats, most: int) -> Whole:
    """Corners limited to [0, ``most``], in units of 1 / UNIT pixel; NaN, from an overflow, becomes 0."""
    inside = np.minimum(np.where(corners > 0, corners, 0.0), most)
    return np.floor(inside * UNIT + 0.5).astype(np.intp)


def _covered(fixed: Whole, side: int, size: int) -> list[tuple[Whole, Whole]]:
    """The pixels along an axis that squares cover, one after the other, and their covered parts of UNIT."""
    first, fraction = fixed // UNIT, fixed % UNIT
    shares = [UNIT - fraction, *[np.full_like(fixed, UNIT)] * (side - 1), fraction]
    return [(np.minimum(first + k, size - 1), share) for k, share in enumerate(shares)]


def _require_arguments(image: NDArray[np.uint8], windows: Floats, rows: int, columns: int) -> None:
    if image.shape[0] < 1 or image.shape[1] < 1:
        refuse("image", "at least one pixel", "none")
    require_shape("windows", windows, (len(windows), 6))
    require_finite("windows", windows)
    if not (windows[:, 2:4].any(axis=1) & windows[:, 4:].any(axis=1)).all():
        refuse("windows", "sides that aren't 0", 0.0)
    for name, count in (("rows", rows), ("columns", columns)):
        require_count(name, count, 1, MAX_IMAGE_SIDE)
