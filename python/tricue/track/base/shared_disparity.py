# SPDX-License-Identifier: MIT
"""The disparity that most of a region shares, where none is expected yet."""

from bisect import bisect_left, bisect_right

import numpy as np
from numpy.typing import NDArray

Disparities = NDArray[np.float32]


def most_shared(disparities: Disparities, tolerance: float) -> NDArray[np.bool_]:
    """(N,) which of the disparities (N,), N > 0, most share: those within a tolerance of one whole number."""
    reach = np.float32(tolerance)
    ordered = np.sort(disparities)  # so that no candidate has to look at all of them
    best, most = None, 0
    for candidate in np.unique(np.round(ordered)):
        first = bisect_left(ordered, -reach, key=candidate.__rsub__)
        count = bisect_right(ordered, reach, lo=first, key=candidate.__rsub__) - first
        if count > most:
            best, most = candidate, count
    if best is None:
        return np.zeros(len(disparities), np.bool_)
    return np.asarray(np.abs(disparities - best) <= reach)
