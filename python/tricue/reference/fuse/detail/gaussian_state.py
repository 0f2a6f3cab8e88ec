# SPDX-License-Identifier: MIT
"""Shared by the Kalman filter's steps."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_covariance, require_finite, require_shape


def require_belief(mean: Floats, covariance: Floats) -> None:
    """Refuse a state that is empty, isn't finite, or has an invalid covariance."""
    require_shape("mean", mean, (mean.size,))
    if mean.size < 1:
        refuse("mean", "at least one number", "none")
    require_finite("mean", mean)
    require_covariance("covariance", covariance, mean.size)


def symmetric(product: Floats) -> Floats:
    """The mean of a matrix and its transpose, which differ slightly by rounding."""
    return np.asarray((product + product.T) / 2)
