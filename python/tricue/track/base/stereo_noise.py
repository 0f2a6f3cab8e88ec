# SPDX-License-Identifier: MIT
"""The uncertainty of measurements in a stereo pair."""

from functools import lru_cache

import numpy as np

from tricue.arrays import Floats


@lru_cache(maxsize=16)
def measurement_variances(place: float, disparity: float) -> Floats:
    """The variances (3,) of x, y and disparity, square pixels, from their standard deviations."""
    return np.array([place**2, place**2, disparity**2])
