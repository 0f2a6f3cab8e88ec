# SPDX-License-Identifier: MIT
"""Joint color histograms."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def joint_histogram(samples: NDArray[np.uint8], bins: int) -> NDArray[np.float32]:
    """Counts the indices of the samples' bins with bincount."""
    if bins not in (1, 2, 4, 8, 16, 32, 64):
        refuse("bins", "a power of two from 1 to 64", bins)
    histograms = np.zeros((len(samples), bins**3), np.float32)
    for i, ellipse in enumerate(samples):
        b, g, r = ellipse.astype(np.intp) * bins // 256
        counts = np.bincount((b * bins + g) * bins + r, minlength=bins**3)
        histograms[i] = counts / max(samples.shape[2], 1)
    return histograms
