# SPDX-License-Identifier: MIT
"""Bootstrap intervals of means over sequences (Efron 1979)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

LEVEL, DRAWS, SEED = 0.95, 10_000, 0


class Interval(NamedTuple):
    """A mean, and the ends of its interval."""

    mean: float
    low: float
    high: float


def mean_interval(values: ArrayLike, clusters: Sequence[str]) -> Interval:
    """The mean of some values and its LEVEL percentile interval; the same for the same arguments.

    values: (N,). clusters: (N,) what each value is of: values of one cluster, such as those of sequences of
    the same recording, depend on each other, so that clusters are drawn. The ends are NaN with a single
    cluster; with few of them the interval is too narrow.
    """
    value = np.asarray(values, np.float64)
    if not value.size or value.shape != (len(clusters),):
        raise ValueError(f"values: expected a number for each of {len(clusters)} names, got {value.shape}")
    _, index = np.unique(np.asarray(clusters), return_inverse=True)
    counts = np.bincount(index)
    if len(counts) == 1:
        return Interval(float(value.mean()), float("nan"), float("nan"))
    drawn = np.random.default_rng(SEED).integers(len(counts), size=(DRAWS, len(counts)))
    sums = np.bincount(index, value)
    means = sums[drawn].sum(axis=1) / counts[drawn].sum(axis=1)
    low, high = np.quantile(means, [(1 - LEVEL) / 2, (1 + LEVEL) / 2]).tolist()
    return Interval(float(value.mean()), low, high)
