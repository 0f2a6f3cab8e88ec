# SPDX-License-Identifier: MIT
"""A limit on a position's covariance, which would grow without bound while a filter only predicts."""

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats

MAX_SIGMA = 100.0  # meters, standard deviation of a position; beyond it the position counts as unknown


def limit_covariance(covariance: Floats, moving: NDArray[np.intp]) -> Floats:
    """The covariance (n, n) of a state that begins with a position in meters, limited to MAX_SIGMA.

    moving: the indices of position and velocity in the state. All are scaled by the same factor, so that the
    result stays a covariance.
    """
    largest = max(covariance.item(0, 0), covariance.item(1, 1), covariance.item(2, 2))
    if largest <= MAX_SIGMA**2:
        return covariance
    scale = np.ones(len(covariance))
    scale[moving] = MAX_SIGMA / largest**0.5
    limited: Floats = covariance * np.outer(scale, scale)
    return limited
