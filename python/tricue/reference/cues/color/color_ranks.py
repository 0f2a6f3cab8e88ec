# SPDX-License-Identifier: MIT
"""Color ranks, equation (17) of Sabeti, Parvizi, Wu 2008, as mid-ranks."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def color_ranks(samples: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Averages the cumulative histograms below and up to each level, channel by channel."""
    n = samples.shape[2]
    if n < 1:
        refuse("samples", "at least one an ellipse", "none")
    ranks = np.empty(samples.shape, np.float32)
    for i, ellipse in enumerate(samples):
        for k, channel in enumerate(ellipse):
            histogram = np.bincount(channel, minlength=256)
            up_to = np.cumsum(histogram)
            below = up_to - histogram
            ranks[i, k] = ((below + up_to) / (2 * n))[channel]
    return ranks
