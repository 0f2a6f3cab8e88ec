# SPDX-License-Identifier: MIT
"""Color histograms of samples (the model with which figure 2 of Sabeti, Parvizi, Wu 2008 compares)."""

import numpy as np
from numpy.typing import NDArray


def color_histogram(samples: NDArray[np.uint8], bins: int) -> NDArray[np.float32]:
    """Counts each channel of each ellipse with bincount."""
    if not 1 <= bins <= 256 or 256 % bins:
        raise ValueError(f"bins: expected a divisor of 256, got {bins}")
    ellipses, channels, n = samples.shape
    if n == 0:
        raise ValueError("samples: expected at least one for each ellipse, got none")
    cells = samples.astype(np.int64) * bins // 256
    histograms = np.empty((ellipses, channels, bins), np.float32)
    for i in range(ellipses):
        for k in range(channels):
            histograms[i, k] = np.bincount(cells[i, k], minlength=bins) / n
    return histograms.reshape(ellipses, channels * bins)
