# SPDX-License-Identifier: MIT
"""The target's grid of blocks, placed in the image."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_shape

BlockGrid = tuple[Floats, tuple[float, float, float, float, float]]


def placed(grid: BlockGrid) -> Floats:
    """(N, 4) x0, y0, x1, y1, pixels: size times the corners, plus (x, y), minus (left, top)."""
    corners, (size, x, y, left, top) = grid
    require_shape("corners", corners, (len(corners), 4))
    with np.errstate(invalid="ignore", over="ignore"):
        blocks = corners * size + [x, y, x, y] - np.array([left, top, left, top])
    strange = np.count_nonzero(~np.isfinite(blocks))
    if strange:
        refuse("corners", "finite numbers, where they are placed", f"{strange} others")
    return np.asarray(blocks)


def require_numbers(grid: BlockGrid, numbers: NDArray[np.int64], name: str) -> None:
    """Refuse numbers unless there is one for each block."""
    corners, _ = grid
    if len(numbers) != len(corners):
        refuse(name, f"{len(corners)} numbers", len(numbers))
