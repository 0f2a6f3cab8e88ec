# SPDX-License-Identifier: MIT
"""Where depth jumps from one pixel to the next."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.base.depth_pixels import has_depth

NEIGHBORS = [(y, x) for y in (0, 1, 2) for x in (0, 1, 2) if (y, x) != (1, 1)]


def depth_edges(depth: NDArray[np.float32], gap: float, slope: float) -> NDArray[np.uint8]:
    """Compares the image with itself shifted to each of the 8 neighbors."""
    for name, value in (("gap", gap), ("slope", slope)):
        if not 0 <= value < np.inf:
            refuse(name, "a finite number, not negative", float(value))
    height, width = depth.shape
    measured = has_depth(depth)
    padded = np.pad(np.where(measured, depth, np.float32(np.inf)), 1, constant_values=np.inf)
    edges = np.zeros(depth.shape, np.bool_)
    with np.errstate(over="ignore", invalid="ignore"):
        for y, x in NEIGHBORS:
            neighbor = padded[y : y + height, x : x + width]
            edges |= depth - neighbor > np.float32(gap) + np.float32(slope) * (neighbor * neighbor)
    return (edges & measured).astype(np.uint8)
