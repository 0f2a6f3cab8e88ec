# SPDX-License-Identifier: MIT
"""Pixel counts in the blocks of the target window (Okada, Shirai, Miura 1996, section 4.4)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import require_shape
from tricue.reference.fuse.detail.rectangle_pixels import rectangle_pixels

Counts = NDArray[np.int64]

MIN_MEASURED_SHARE = 0.2  # of a block's pixels; the mean of fewer disparities isn't used


def block_counts(
    mask: NDArray[np.uint8],
    disparity: NDArray[np.float32],
    blocks: Floats,
    expected: float = np.nan,
    tolerance: float = 0.0,
) -> tuple[Counts, Counts, Counts, Floats, Counts]:
    """Counts the pixels of one block at a time."""
    require_shape("mask", mask, disparity.shape)
    require_shape("blocks", blocks, (len(blocks), 4))
    pixels, targets, measured, similar = (np.zeros(len(blocks), np.int64) for _ in range(4))
    mean = np.full(len(blocks), np.nan)
    for i, (x0, y0, x1, y1) in enumerate(blocks):
        inside = rectangle_pixels((x0, y0, x1, y1), mask.shape, "blocks")
        seen = disparity[inside]
        seen_finite = seen[np.isfinite(seen)]
        similar[i] = np.count_nonzero(np.abs(seen_finite - np.float32(expected)) <= np.float32(tolerance))
        pixels[i], measured[i] = seen.size, seen_finite.size
        targets[i] = np.count_nonzero(mask[inside])
        if seen_finite.size:
            mean[i] = seen_finite.astype(np.float64).mean()
    return pixels, targets, measured, mean, similar
