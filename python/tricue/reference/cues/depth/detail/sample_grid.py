# SPDX-License-Identifier: MIT
"""A grid of squares under whose centers depths are read."""

import numpy as np

from tricue.reference.base.checks import refuse, require_count

SampleGrid = tuple[float, float, float, int, int]  # x0, y0, step, rows, columns

MAX_GRID_SIDE = 4096


def require_grid(grid: SampleGrid) -> None:
    """Refuse numbers out of range."""
    x0, y0, step, rows, columns = grid
    for name, number in (("x0", x0), ("y0", y0)):
        if not np.isfinite(number):
            refuse(name, "a finite number", float(number))
    if not 0 < step < np.inf:
        refuse("step", "a finite number above 0", float(step))
    for name, count in (("rows", rows), ("columns", columns)):
        require_count(name, count, 1, MAX_GRID_SIDE)
