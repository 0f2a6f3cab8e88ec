# SPDX-License-Identifier: MIT
"""Logistic regression with weighted samples."""

import numpy as np

from benchmarks.quality.common.frame_results import Array, Flags

PENALTY = 1e-3
"""Regularization of the squared weights of standardized features, per total weight of the samples."""
STEPS = 30
"""Steps of Newton's method."""
MAX_LOG_ODDS = 30.0
"""Beyond this the probability doesn't change."""


def fit(features: Array, labels: Flags, weights: Array) -> Array:
    """(F + 1,) log-odds per unit of each feature, and their offset.

    features: (N, F). labels: (N,). weights: (N,) of the samples.
    """
    mean, spread = np.average(features, axis=0, weights=weights), features.std(axis=0) + 1e-9
    inputs = np.column_stack([(features - mean) / spread, np.ones(len(features))])
    penalty = PENALTY * weights.sum() * np.append(np.ones(features.shape[1]), 0.0)
    found: Array = np.zeros(inputs.shape[1])
    for _ in range(STEPS):
        probability = _probability(inputs @ found)
        slope = inputs.T @ (weights * (probability - labels)) + penalty * found
        bend = (inputs.T * (weights * probability * (1 - probability))) @ inputs + np.diag(penalty)
        found = found - np.linalg.solve(bend, slope)
    per_unit = found[:-1] / spread
    return np.append(per_unit, found[-1] - per_unit @ mean)


def predict(features: Array, found: Array) -> Array:
    """(N,) probabilities of samples, (N, F), by what was fitted, (F + 1,)."""
    return _probability(features @ found[:-1] + found[-1])


def _probability(log_odds: Array) -> Array:
    return 1 / (1 + np.exp(-np.clip(log_odds, -MAX_LOG_ODDS, MAX_LOG_ODDS)))
