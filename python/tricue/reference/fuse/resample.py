# SPDX-License-Identifier: MIT
"""Systematic resampling (Kitagawa 1996)."""

import numpy as np
from numpy.typing import NDArray


def resample(weights: NDArray[np.float64], offset: float) -> NDArray[np.int64]:
    """Choose N particles by one comb of N equally spaced teeth, shifted by ``offset`` in [0, 1)."""
    if not 0.0 <= offset < 1.0:
        raise ValueError("offset: expected a number in [0, 1)")
    if not np.all(np.isfinite(weights)) or np.any(weights < 0):
        raise ValueError("weights: expected finite numbers, none negative")
    cumulative = np.cumsum(weights)
    if weights.size == 0 or not cumulative[-1] > 0:
        raise ValueError("weights: expected at least one above zero")
    teeth = (np.arange(weights.size) + offset) * (cumulative[-1] / weights.size)
    return np.minimum(np.searchsorted(cumulative, teeth, side="right"), weights.size - 1)
