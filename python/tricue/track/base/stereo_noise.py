# SPDX-License-Identifier: MIT
"""How far what is measured in a stereo pair may be off."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@lru_cache(maxsize=16)
def measurement_variances(place: float, disparity: float) -> Floats:
    """(3,) of x, y and disparity, square pixels, of their standard deviations."""
    return np.array([place**2, place**2, disparity**2])
