# SPDX-License-Identifier: MIT
"""Kalman update in Joseph's form (Kalman 1960; Bucy, Joseph 1968)."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_covariance, require_finite, require_shape
from tricue.reference.fuse.detail.gaussian_state import require_belief, symmetric


def kalman_update(
    mean: Floats,
    covariance: Floats,
    measurement: Floats,
    observation: Floats,
    noise: Floats,
    max_distance: float = np.inf,
) -> tuple[Floats, Floats, Floats, Floats]:
    """Inverts S for the gain, and computes the covariance in Joseph's form."""
    require_belief(mean, covariance)
    if measurement.size < 1:
        refuse("measurement", "at least one number", "none")
    require_finite("measurement", measurement)
    require_shape("observation", observation, (measurement.size, mean.size))
    require_finite("observation", observation)
    require_covariance("noise", noise, measurement.size)
    if not max_distance > 0:
        refuse("max_distance", "a number above 0", float(max_distance))

    y = measurement - observation @ mean
    s = _innovation_covariance(covariance, observation, noise)
    distance = np.sqrt(y @ np.linalg.solve(s, y))
    if distance > max_distance:
        covariance = (distance / max_distance) ** 2 * covariance
        s = _innovation_covariance(covariance, observation, noise)
    gain = covariance @ observation.T @ np.linalg.inv(s)
    rest = np.eye(mean.size) - gain @ observation
    return mean + gain @ y, symmetric(rest @ covariance @ rest.T + gain @ noise @ gain.T), y, s


def _innovation_covariance(covariance: Floats, observation: Floats, noise: Floats) -> Floats:
    s = symmetric(observation @ covariance @ observation.T + noise)
    if not positive_definite(s):
        refuse("noise", "with the state's a positive definite innovation covariance", "one that isn't")
    return s


def positive_definite(s: Floats) -> bool:
    """Whether Cholesky's pivots are larger than rounding errors, relative to the variances."""
    if not np.isfinite(s).all():
        return False
    try:
        pivots = np.linalg.cholesky(s).diagonal() ** 2
    except np.linalg.LinAlgError:
        return False
    return bool(np.all(pivots > np.finfo(float).eps * len(s) * s.diagonal()))
