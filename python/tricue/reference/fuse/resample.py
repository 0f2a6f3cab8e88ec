# SPDX-License-Identifier: MIT
"""Systematic resampling (Kitagawa 1996)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_weights


def resample(weights: NDArray[np.float64], offset: float) -> NDArray[np.int64]:
    """Searches the cumulative weights for evenly spaced points."""
    if not 0.0 <= offset < 1.0:
        refuse("offset", "a number in [0, 1)", float(offset))
    require_weights(weights)
    cumulative = np.cumsum(weights)
    teeth = (np.arange(weights.size) + offset) * (cumulative[-1] / weights.size)
    last = np.flatnonzero(weights)[-1]  # for points that rounding puts above the total
    chosen: NDArray[np.int64] = np.minimum(np.searchsorted(cumulative, teeth, side="right"), last)
    return chosen
