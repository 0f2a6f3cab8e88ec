# SPDX-License-Identifier: MIT
"""Where a peak is between samples."""

import math

import numpy as np
from numpy.typing import NDArray

MAX_OFFSET = 0.5  # samples; a peak farther off would be at the next one
MIN_SHARE = 0.05  # of the peak, of a neighbor in its logarithm


def gaussian_peak_offset(values: NDArray[np.floating], index: int) -> float:
    """Offset of a peak from the largest value, by a Gaussian, which a correlation filter answers with: a
    parabola through the logarithms of it and its neighbors.
    """
    if not 0 < index < len(values) - 1:
        return 0.0
    before, top, after = values[index - 1 : index + 2].tolist()
    if top <= 0:
        return 0.0
    least = MIN_SHARE * top
    return _parabola(*(math.log(max(each, least)) for each in (before, top, after)))


def _parabola(before: float, top: float, after: float) -> float:
    bend = before - 2 * top + after
    return min(max(0.5 * (before - after) / bend, -MAX_OFFSET), MAX_OFFSET) if bend < 0 else 0.0
