# SPDX-License-Identifier: MIT
"""The estimate of weighted particles (Sabeti, Parvizi, Wu 2008, section III.C; Kong, Liu, Wong 1994)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import require_finite, require_shape, require_weights


def summarize(
    particles: NDArray[np.float64], weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Computes the weighted sums by their definitions."""
    require_shape("weights", weights, (len(particles),))
    require_finite("particles", particles)
    require_weights(weights)
    shares = weights / weights.sum()
    mean = shares @ particles
    centered = particles - mean
    covariance = centered.T @ (shares[:, np.newaxis] * centered)
    return mean, covariance, float(1 / (shares**2).sum())
