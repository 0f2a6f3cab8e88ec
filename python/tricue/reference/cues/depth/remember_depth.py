# SPDX-License-Identifier: MIT
"""The last depth of each pixel that wasn't the target's."""

import numpy as np

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import refuse, require_shape


def remember_depth(
    depth: Depth, before: Depth, region: tuple[int, int, int, int], z: float, reach: float
) -> Depth:
    """Copies the image, and restores the earlier depth where the target is."""
    if before.shape == (0, 0):
        before = np.full(depth.shape, np.nan, np.float32)
    require_shape("before", before, depth.shape)
    if not np.isfinite(z):
        refuse("z", "a finite number", float(z))
    if not 0 <= reach < np.inf:
        refuse("reach", "a finite number, not negative", float(reach))
    left, top, right, bottom = (max(each, 0) for each in region)
    inside = np.zeros(depth.shape, np.bool_)
    inside[top:bottom, left:right] = True
    with np.errstate(over="ignore", invalid="ignore"):
        own = inside & (np.abs(depth - np.float32(z)) < np.float32(reach))
    return np.where(own, before, depth)
