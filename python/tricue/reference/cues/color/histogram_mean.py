# SPDX-License-Identifier: MIT
"""The mean color of a histogram (Moreno et al. 2002, equation (7))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.cues.color.detail.color_space import mean_color, require_histogram


def histogram_mean(
    histogram: NDArray[np.float64], bins: tuple[int, int, int], chroma: int
) -> NDArray[np.float64]:
    """Averages the centers of all bins, weighted by the histogram."""
    require_histogram(histogram, bins, chroma)
    return mean_color(histogram, bins, chroma)
