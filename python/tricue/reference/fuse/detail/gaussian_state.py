# SPDX-License-Identifier: MIT
"""What the Kalman filter's steps have in common."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_covariance, require_finite, require_shape

Floats = NDArray[np.float64]


def require_belief(mean: Floats, covariance: Floats) -> None:
    """Refuse a state without numbers, that isn't finite, or whose covariance is none."""
    require_shape("mean", mean, (mean.size,))
    if mean.size < 1:
        refuse("mean", "at least one number", "none")
    require_finite("mean", mean)
    require_covariance("covariance", covariance, mean.size)


def symmetric(product: Floats) -> Floats:
    """Mean of a matrix and its transpose, which rounding has left slightly unlike."""
    return np.asarray((product + product.T) / 2)
