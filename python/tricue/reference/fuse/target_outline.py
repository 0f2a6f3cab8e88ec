# SPDX-License-Identifier: MIT
"""The rectangle around the target's pixels in its blocks; ours."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import require_shape
from tricue.reference.fuse.block_mask import block_mask
from tricue.reference.fuse.detail.block_grid import BlockGrid, placed, require_numbers
from tricue.reference.fuse.temporal_window import temporal_window


def target_outline(
    mask: NDArray[np.uint8],
    disparity: NDArray[np.float32],
    grid: BlockGrid,
    states: NDArray[np.int64],
    target: float,
    tolerance: float,
) -> tuple[tuple[int, int, int, int], int]:
    """Combines masks, and calls temporal_window for the rectangle."""
    require_shape("mask", mask, disparity.shape)
    require_numbers(grid, states, "states")
    mine = block_mask(placed(grid)[states == 1], *mask.shape)
    near = np.abs(disparity - np.float32(target)) <= np.float32(tolerance)
    box, count, _ = temporal_window(mine & ((mask != 0) | near), 0, 0.0)
    return box, count
