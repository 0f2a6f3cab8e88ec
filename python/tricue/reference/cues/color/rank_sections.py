# SPDX-License-Identifier: MIT
"""Sums of rank measures over sections (Sabeti, Parvizi, Wu 2008, equations (17), (19)-(28))."""

import numpy as np
from numpy.typing import NDArray


def rank_sections(samples: NDArray[np.uint8], sections: int) -> NDArray[np.float32]:
    """Keeps ranks as integer counts, n times r(l), so that ties and borders are exact."""
    if not 1 <= sections <= 256:
        raise ValueError(f"sections: expected 1 to 256, got {sections}")
    ellipses, channels, n = samples.shape
    if n == 0:
        raise ValueError("samples: expected at least one for each ellipse, got none")
    result = np.empty((ellipses, channels, sections), np.float32)
    for i in range(ellipses):
        for k in range(channels):
            a = _sums(samples[i, k], sections)
            result[i, k] = a / a.sum()
    return result


def _sums(levels: NDArray[np.uint8], sections: int) -> NDArray[np.int64]:
    histogram = np.bincount(levels, minlength=256)
    rank = np.cumsum(histogram)  # (17)
    q = [rank[np.argmin(np.abs(rank * sections - n * levels.size))] for n in range(sections + 1)]  # (19)-(24)
    a = [rank[(q[n] <= rank) & (rank <= q[n + 1])].sum() for n in range(sections)]  # (25)-(28)
    return np.array(a)
