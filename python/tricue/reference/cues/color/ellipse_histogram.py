# SPDX-License-Identifier: MIT
"""Histograms of pixels inside ellipses and in the rings around them (Moreno et al. 2002, equation (1))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.detail.ellipse_shape import count, masks_of, require_bins, require_ellipses

Counts = NDArray[np.int32]


def ellipse_histogram(
    bins: NDArray[np.uint16],
    ellipses: NDArray[np.float64],
    size: int,
    margin: float,
    mask: NDArray[np.uint8] | None = None,
) -> tuple[Counts, Counts]:
    """Counts the bins under the mask of each ellipse and of each ring."""
    require_ellipses("ellipses", ellipses, margin)
    require_bins(bins, size)
    if mask is not None and mask.shape != bins.shape:
        refuse("mask", f"shape {bins.shape}", mask.shape)
    counted = np.ones(bins.shape, np.bool_) if mask is None else mask != 0
    inside = np.zeros((len(ellipses), size), np.int32)
    around = np.zeros((len(ellipses), size), np.int32)
    for i, ellipse in enumerate(ellipses):
        for counts, pixels in zip((inside, around), masks_of(ellipse, margin, bins.shape), strict=True):
            counts[i] = count(bins, pixels & counted, size)
    return inside, around
