# SPDX-License-Identifier: MIT
"""The cells at an expected disparity (Moreno et al. 2002, section 3.2)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def coherent_cells(
    disparities: NDArray[np.float32], expected: float, tolerance: float, window: int
) -> NDArray[np.uint8]:
    """Cells vote for or against; those without a vote take the sum of a window's."""
    if not np.isfinite(expected):
        refuse("expected", "a finite number", float(expected))
    if not tolerance >= 0:
        refuse("tolerance", "0 or more", float(tolerance))
    if not (1 <= window <= 127 and window % 2):
        refuse("window", "an odd number from 1 to 127", window)
    off = abs(disparities - np.float32(expected))
    votes = (off <= np.float32(tolerance)).astype(int) - (off > np.float32(tolerance))
    around = np.pad(votes, window // 2)
    sums = np.zeros(votes.shape, int)
    for y in range(window):
        for x in range(window):
            sums += around[y : y + votes.shape[0], x : x + votes.shape[1]]
    return np.where(votes == 0, sums > 0, votes > 0).astype(np.uint8)
