# SPDX-License-Identifier: MIT
"""Importance weights under the mixture proposal (Sabeti, Parvizi, Wu 2008, equations (2), (30), (31))."""

import numpy as np

from tricue.reference.base import checks
from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import Detection, Dynamics


def reweight(
    log_likelihood: Floats, proposed: Floats, previous: Floats, dynamics: Dynamics, detection: Detection
) -> tuple[Floats, float]:
    """Computes densities in the log domain, and subtracts the largest log-weight before the exponential."""
    _check(log_likelihood, proposed, previous)
    checks.require_dynamics(dynamics, proposed.shape[1])
    checks.require_detection(detection, proposed.shape[1])
    (drift, scale), (mean, root, share) = dynamics, detection
    log_weights = log_likelihood
    if share > 0:
        size = len(mean)
        if not scale[:size].min() > 0:
            checks.refuse("scale", "numbers above 0 where the mean has some", float(scale[:size].min()))
        to = proposed[:, :size]
        log_p = _log_gaussian(to - previous[:, :size] - drift[:size], np.diag(scale[:size]))
        log_detection = _log_gaussian(to - mean, root)
        # (2) with numerator and denominator divided by p: L / (share N / p + 1 - share)
        log_weights = log_likelihood - np.logaddexp(np.log(share) + log_detection - log_p, np.log1p(-share))
    return _normalized(log_weights)


def _log_gaussian(offsets: Floats, root: Floats) -> Floats:
    """Log density of N(0, root root^T) without the constant -K/2 log 2 pi, by forward substitution."""
    z = np.empty_like(offsets)
    with np.errstate(over="ignore"):
        for d in range(offsets.shape[1]):
            rest = _bounded(offsets[:, d])
            for e in np.flatnonzero(root[d, :d]):
                rest = rest - _bounded(root[d, e] * z[:, e])
            z[:, d] = _bounded(rest / root[d, d])
    return np.asarray(-0.5 * (z**2).sum(axis=1) - np.log(root.diagonal()).sum())


def _bounded(z: Floats) -> Floats:
    """Deviations limited to ±1e150, where the density is 0 anyway and squares are still finite."""
    return np.clip(z, -1e150, 1e150)


def _normalized(log_weights: Floats) -> tuple[Floats, float]:
    """Equation (31) by log-sum-exp."""
    count, greatest = log_weights.size, float(log_weights.max())
    if greatest == -np.inf:
        return np.full(count, 1 / count), -np.inf
    weights = np.exp(log_weights - greatest)
    total = float(weights.sum())
    return weights / total, greatest + float(np.log(total / count))


def _check(log_likelihood: Floats, proposed: Floats, previous: Floats) -> None:
    if log_likelihood.size == 0:
        checks.refuse("log_likelihood", "at least one particle", "none")
    strange = log_likelihood[~(log_likelihood < np.inf)]
    if strange.size:
        checks.refuse("log_likelihood", "numbers below infinity", float(strange[0]))
    checks.require_shape("log_likelihood", log_likelihood, (len(proposed),))
    checks.require_shape("previous", previous, proposed.shape)
    checks.require_finite("proposed", proposed)
    checks.require_finite("previous", previous)
