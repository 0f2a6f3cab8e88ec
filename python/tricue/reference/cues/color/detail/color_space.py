# SPDX-License-Identifier: MIT
"""The color space (B - G, G - R, B + G + R) of Birchfield 1998, divided into bins."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

Bins = tuple[int, int, int]
ColorSpace = tuple[Bins, int]


def require_space(bins: Bins, chroma: int) -> None:
    """Refuse anything but 1 to 256 bins per axis, at most 65535 in all, and chroma in [1, 255]."""
    if min(bins) < 1 or max(bins) > 256 or np.prod(bins) > 65535:
        refuse("bins", "1 to 256 on each axis and at most 65535 in all", bins)
    if not 1 <= chroma <= 255:
        refuse("chroma", "1 to 255", chroma)


def require_histogram(histogram: Floats, bins: Bins, chroma: int) -> None:
    """Refuse anything but a histogram over the color space."""
    require_space(bins, chroma)
    require_shape("histogram", histogram, (int(np.prod(bins)),))
    require_finite("histogram", histogram)
    if histogram.min() < 0:
        refuse("histogram", "no negative number", float(histogram.min()))
    with np.errstate(over="ignore"):
        total = float(histogram.sum())
    if not 0 < total < np.inf:
        refuse("histogram", "a finite sum above 0", total)


def axes(bins: Bins, chroma: int) -> list[tuple[int, int, int]]:
    """(bins, lowest level, levels) of each axis."""
    return [(bins[0], -chroma, 2 * chroma), (bins[1], -chroma, 2 * chroma), (bins[2], 0, 766)]


def centers(bins: Bins, chroma: int) -> list[Floats]:
    """For each axis, the mean of the integer levels in each of its bins."""
    return [lowest + (np.arange(n) + 0.5) * levels / n - 0.5 for n, lowest, levels in axes(bins, chroma)]


def mean_color(histogram: Floats, bins: Bins, chroma: int) -> Floats:
    """(3,): the mean of the bins' centers, weighted by the histogram."""
    weights = histogram.reshape(bins)
    grids = np.meshgrid(*centers(bins, chroma), indexing="ij")
    sums = np.array([np.sum(weights * grid) for grid in grids], np.float64)
    return np.asarray(sums / weights.sum())


def indices(pixels: NDArray[np.uint8], bins: Bins, chroma: int) -> NDArray[np.int64]:
    """The bins of BGR pixels (n, 3)."""
    b, g, r = pixels.astype(np.int64).T
    index = np.zeros(len(pixels), np.int64)
    for value, (n, lowest, levels) in zip((b - g, g - r, b + g + r), axes(bins, chroma), strict=True):
        level = np.clip(value - lowest, 0, levels - 1)  # values beyond an axis are in its end bins
        index = index * n + level * n // levels
    return index
