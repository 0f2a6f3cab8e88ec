# SPDX-License-Identifier: MIT
"""The histogram of a depth image under a mask."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.base.depth_pixels import has_depth


def depth_histogram(
    depth: NDArray[np.float32], mask: NDArray[np.uint8], near: float, far: float, levels: int
) -> NDArray[np.float64]:
    """Counts the levels of the pixels under the mask with bincount."""
    require_shape("mask", mask, depth.shape)
    if not np.isfinite(near):
        refuse("near", "a finite number", float(near))
    if not (np.isfinite(far) and far > near):
        refuse("far", "a finite number above near", float(far))
    if not 1 <= levels <= 65536:
        refuse("levels", "1 to 65536", levels)
    z = depth[has_depth(depth) & (mask != 0)]
    z = z[(near <= z.astype(np.float64)) & (z.astype(np.float64) < far)]
    with np.errstate(over="ignore", invalid="ignore"):  # where far and near are neighbors
        place = (z - np.float32(near)) * np.float32(np.divide(levels, far - near))
    level = np.where(place < levels - 1, place, levels - 1).astype(np.intp)
    return np.bincount(level, minlength=levels).astype(np.float64)
