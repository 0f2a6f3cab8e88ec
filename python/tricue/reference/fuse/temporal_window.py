# SPDX-License-Identifier: MIT
"""The rectangle around the target pixels of one frame (Okada, Shirai, Miura 1996, section 4, figure 4)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

Mask = NDArray[np.uint8]
Pixels = NDArray[np.bool_]


def temporal_window(
    mask: Mask, neighbors: int, share: float, trim: float = 0.02
) -> tuple[tuple[int, int, int, int], int, Mask]:
    """Counts neighbors by a box sum, labels regions by flood fill, and sorts coordinates for the box."""
    _require(neighbors, share, trim)
    left = _large_regions(_cleaned(mask != 0, neighbors), share)
    count = int(np.count_nonzero(left))
    if count == 0:
        return (0, 0, 0, 0), 0, left.astype(np.uint8)
    rows, columns = np.nonzero(left)
    out = int(np.floor(trim * count))
    (y0, y1), (x0, x1) = ((np.sort(each)[out], np.sort(each)[-1 - out] + 1) for each in (rows, columns))
    return (int(x0), int(y0), int(x1), int(y1)), count, left.astype(np.uint8)


def _cleaned(pixels: Pixels, neighbors: int) -> Pixels:
    """The set pixels with enough set neighbors; none is set outside the image."""
    height, width = pixels.shape
    padded = np.pad(pixels, 1).astype(int)
    square = sum(padded[i : i + height, j : j + width] for i in range(3) for j in range(3))
    return np.asarray(pixels & (square - pixels >= neighbors))


def _large_regions(pixels: Pixels, share: float) -> Pixels:
    """The pixels without those of regions smaller than a share of the largest."""
    regions = _regions(pixels)
    largest = max(map(len, regions), default=0)
    left = np.zeros_like(pixels)
    for region in regions:
        if len(region) >= share * largest:
            left[tuple(np.transpose(region))] = True
    return left


def _regions(pixels: Pixels) -> list[list[tuple[int, int]]]:
    """The pixels (row, column) of every 8-connected region."""
    waiting = {(int(y), int(x)) for y, x in np.argwhere(pixels)}
    regions = []
    while waiting:
        region = [waiting.pop()]
        for y, x in region:  # the list grows while it is read
            around = {(y + i, x + j) for i in (-1, 0, 1) for j in (-1, 0, 1)} & waiting
            waiting -= around
            region += around
        regions.append(region)
    return regions


def _require(neighbors: int, share: float, trim: float) -> None:
    if not 0 <= neighbors <= 8:
        refuse("neighbors", "0 to 8", neighbors)
    if not 0 <= share <= 1:
        refuse("share", "a number in [0, 1]", float(share))
    if not 0 <= trim < 0.5:
        refuse("trim", "a number in [0, 0.5)", float(trim))
