# SPDX-License-Identifier: MIT
"""Filling of a depth image with many small gaps."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_count
from tricue.reference.base.depth_pixels import has_depth

NEIGHBORS = [(y, x) for y in (0, 1, 2) for x in (0, 1, 2) if (y, x) != (1, 1)]
MAX_PASSES = 1000
SMALL = 3  # pixels: largest width of a small gap
VOTES = 2  # smallest number of neighbors on the nearest surface


def fill_gaps(
    depth: NDArray[np.float32], gap: float, slope: float, max_gap_share: float, passes: int
) -> NDArray[np.float32]:
    """Fills from the 8 shifted images, again as long as the image has many gaps."""
    for name, value in (("gap", gap), ("slope", slope)):
        if not 0 <= value < np.inf:
            refuse(name, "a finite number, not negative", float(value))
    if not 0 <= max_gap_share <= 1:
        refuse("max_gap_share", "a share from 0 to 1", float(max_gap_share))
    require_count("passes", passes, 0, MAX_PASSES)
    image = np.where(has_depth(depth), depth, np.float32(np.nan))
    for number in range(passes):
        measured = np.isfinite(image)
        least = max_gap_share / 2 if number > 0 else max_gap_share
        if _small_gaps(measured) <= least * measured.sum():
            break
        image = np.where(measured, image, _surfaces(image, gap, slope))
    return image


def _small_gaps(measured: NDArray[np.bool_]) -> int:
    """The number of gaps of 1 to SMALL unmeasured pixels in a row between two measured ones."""
    width = measured.shape[1]
    padded = np.pad(measured, ((0, 0), (0, SMALL + 1)))
    goes_on = np.any([padded[:, 1 + gap : 1 + gap + width] for gap in range(1, SMALL + 1)], axis=0)
    return int((measured & ~padded[:, 1 : 1 + width] & goes_on).sum())


def _surfaces(image: NDArray[np.float32], gap: float, slope: float) -> NDArray[np.float32]:
    """(H, W) the mean of each pixel's neighbors on the nearest surface; NaN where these are too few."""
    height, width = image.shape
    padded = np.pad(image, 1, constant_values=np.nan)
    around = [padded[y : y + height, x : x + width] for y, x in NEIGHBORS]
    nearest = np.fmin.reduce(around)
    total, votes = np.zeros((2, height, width), np.float32)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        reach = nearest + (np.float32(gap) + np.float32(slope) * (nearest * nearest))
        reach = np.fmin(reach, np.finfo(np.float32).max)  # where the square overflows
        for neighbor in around:
            on_it = neighbor <= reach
            total += np.where(on_it, neighbor, np.float32(0))
            votes += on_it
        mean = total / votes
    return np.where((votes >= VOTES) & np.isfinite(mean), mean, np.float32(np.nan))
