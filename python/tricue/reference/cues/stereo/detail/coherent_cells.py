# SPDX-License-Identifier: MIT
"""The cells at an expected disparity: a part of head_cells's twin."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def coherent_cells(
    disparities: NDArray[np.float32], expected: float, tolerance: float, fill: int
) -> NDArray[np.uint8]:
    """(H, W) 1 at the expected disparity, else 0.

    Cells with a disparity vote. A cell without one gets the majority in the square around it, whose side is
    ``fill`` cells.
    """
    if not np.isfinite(expected):
        refuse("expected", "a finite number", float(expected))
    if not tolerance >= 0:
        refuse("tolerance", "0 or more", float(tolerance))
    if not (1 <= fill <= 127 and fill % 2):
        refuse("fill", "an odd number from 1 to 127", fill)
    off = abs(disparities - np.float32(expected))
    votes = (off <= np.float32(tolerance)).astype(int) - (off > np.float32(tolerance))
    around = np.pad(votes, fill // 2)
    sums = np.zeros(votes.shape, int)
    for y in range(fill):
        for x in range(fill):
            sums += around[y : y + votes.shape[0], x : x + votes.shape[1]]
    return np.where(votes == 0, sums > 0, votes > 0).astype(np.uint8)
