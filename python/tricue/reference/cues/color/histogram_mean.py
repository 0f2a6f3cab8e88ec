# SPDX-License-Identifier: MIT
"""The mean color of a histogram (Moreno et al. 2002, equation (7))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.cues.color.detail.color_space import ColorSpace, mean_color, require_histogram


def histogram_mean(histogram: NDArray[np.float64], space: ColorSpace) -> NDArray[np.float64]:
    """Averages the centers of all bins, weighted by the histogram."""
    require_histogram(histogram, *space)
    return mean_color(histogram, *space)
