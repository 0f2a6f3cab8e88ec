# SPDX-License-Identifier: MIT
"""The places at which an ellipse is evaluated: shared by the twins of the search for heads."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse

Grid = tuple[int, int, int]


def require_grid(grid: Grid) -> None:
    """Refuse a grid unless rows, columns and step are 1 to 1024 and it spans at most 16384 pixels."""
    if min(grid) < 1 or max(grid) > 1024 or max(grid[:2]) * grid[2] > 16384:
        refuse("grid", "rows, cols and a step of 1 to 1024, over at most 16384 pixels", grid)


def places(ellipse: Floats, grid: Grid) -> Floats:
    """(rows, cols, 4): the ellipse at every place of the grid."""
    rows, cols, step = grid
    moved = np.tile(ellipse, (rows, cols, 1))
    moved[..., 0] += (np.arange(cols) - cols // 2) * step
    moved[..., 1] += (np.arange(rows)[:, None] - rows // 2) * step
    return moved
