# SPDX-License-Identifier: MIT
"""The disparity that most of a region shares, when none is expected yet."""

import numpy as np
from numpy.typing import NDArray

Disparities = NDArray[np.float32]


def most_shared(disparities: Disparities, tolerance: float) -> NDArray[np.bool_]:
    """Which of the disparities (N,), N > 0, are within ``tolerance`` of the most common whole number."""
    reach, ordered = np.float32(tolerance), np.sort(disparities)
    candidates = np.unique(np.round(ordered))
    ends = np.searchsorted(ordered, candidates + reach, "right")
    counts = ends - np.searchsorted(ordered, candidates - reach, "left")
    return np.asarray(np.abs(disparities - candidates[np.argmax(counts)]) <= reach)
