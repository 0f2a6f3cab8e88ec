# SPDX-License-Identifier: MIT
"""Where a depth image differs from an earlier one."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import refuse, require_shape


def changed_depth(depth: Depth, before: Depth, noise: float, slope: float) -> NDArray[np.uint8]:
    """Compares all pixels at once; NaN differs from everything."""
    require_shape("before", before, depth.shape)
    for name, value in (("noise", noise), ("slope", slope)):
        if not 0 <= value < np.inf:
            refuse(name, "a finite number, not negative", float(value))
    with np.errstate(over="ignore", invalid="ignore"):
        limit = np.float32(noise) + np.float32(slope) * depth * depth
        same: NDArray[np.bool_] = np.abs(depth - before) <= limit
    return (~same).astype(np.uint8)
