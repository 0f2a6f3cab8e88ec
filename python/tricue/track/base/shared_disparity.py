# SPDX-License-Identifier: MIT
"""The disparity that most of a region shares, where none is expected yet."""

import numpy as np
from numpy.typing import NDArray

Disparities = NDArray[np.float32]


def most_shared(disparities: Disparities, tolerance: float) -> NDArray[np.bool_]:
    """(N,) which of the disparities (N,), N > 0, most share: those within a tolerance of one whole number."""
    best, most = np.zeros(len(disparities), np.bool_), 0
    for candidate in np.unique(np.round(disparities)):
        near = np.abs(disparities - candidate) <= np.float32(tolerance)
        count = int(np.count_nonzero(near))
        if count > most:  # one mask is kept: of depths in a wrong unit there are tens of thousands
            best, most = near, count
    return best
