# SPDX-License-Identifier: MIT
"""Bootstrap intervals of means over sequences (Efron 1979), and tests of paired differences.

Whole recordings are resampled: seeds and starts of a sequence are averaged first, and the sequences of one
recording, such as its several targets, stay together. Percentile intervals of few values are too narrow; they
are widened to match Student's t, following Hesterberg (2015, "What teachers should know about the
bootstrap"). With fewer than MIN_CLUSTERS recordings there is no interval and no test: even with five
differences of the same sign, the exact p-value is only 1/16.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import accumulate
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tricue.arrays import Floats

LEVEL, DRAWS, SEED = 0.95, 10_000, 0
MIN_CLUSTERS = 6  # for an interval and a test
MAX_EXACT = 14  # recordings for which all signs are tried; for more, this many are drawn:
SIGN_DRAWS = 20_000


class Interval(NamedTuple):
    """A mean, and the ends of its interval; these are NaN if there are too few recordings."""

    mean: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Whether it has ends."""
        return not math.isnan(self.low)

    @property
    def excludes_zero(self) -> bool:
        """Whether 0 lies outside; False without an interval."""
        return self.low > 0 or self.high < 0


def mean_interval(values: ArrayLike, clusters: Sequence[str], least: int = MIN_CLUSTERS) -> Interval:
    """The mean of values and its LEVEL interval; deterministic.

    values: (N,). clusters: (N,) the name of each value's cluster. Values of one cluster, such as the
    sequences of one recording, depend on each other, so whole clusters are resampled. least: the number of
    clusters, 2 or more, below which the ends are NaN. ValueError unless each value has a name and there is at
    least one value.
    """
    sums, counts = _by_cluster(values, clusters)
    mean, size = float(sums.sum() / counts.sum()), len(sums)
    if size < max(least, 2):
        return Interval(mean, math.nan, math.nan)
    drawn = _drawn(size)
    means = (drawn @ sums) / (drawn @ counts)
    tail = _tail(size)
    low, high = np.quantile(means, [tail, 1 - tail]).tolist()
    return Interval(mean, low, high)


def sign_flip_p(differences: ArrayLike, clusters: Sequence[str]) -> float:
    """The two-sided p-value of the hypothesis that paired differences have mean 0: Fisher's randomization
    test.

    If two trackers are alike, each recording's difference could as well have the opposite sign. The p-value
    is the share of sign combinations whose mean is at least as far from 0. For up to MAX_EXACT recordings all
    are tried, else SIGN_DRAWS are drawn with a fixed seed. NaN with fewer than MIN_CLUSTERS.
    """
    sums, _ = _by_cluster(differences, clusters)
    size = len(sums)
    if size < MIN_CLUSTERS:
        return math.nan
    signs = _signs(size)
    drawn = int(size > MAX_EXACT)  # then the actual signs count as another draw
    observed = abs(float(sums.sum()))
    as_far = np.abs(signs @ sums) >= observed - 1e-12 * np.abs(sums).sum()
    return float((as_far.sum() + drawn) / (len(signs) + drawn))


def least_p(size: int) -> float:
    """The smallest p-value that :func:`sign_flip_p` can give for this number of recordings: if all
    differences are equal, only equal signs are as far from 0. NaN with fewer than MIN_CLUSTERS.
    """
    return sign_flip_p(np.ones(size), [str(each) for each in range(size)]) if size else math.nan


def separable(sizes: Sequence[int]) -> bool:
    """Whether any of several tests can show a difference: whether its smallest possible p-value is below 1 -
    LEVEL by Holm's method. sizes: the number of recordings of each.
    """
    return any(len(sizes) * least_p(size) < 1 - LEVEL for size in {*sizes})


def holm(p_values: Sequence[float]) -> list[float]:
    """The p-values adjusted for their number (Holm 1979), in the same order; NaN stays and isn't counted."""
    known = sorted((p, index) for index, p in enumerate(p_values) if not math.isnan(p))
    factors = range(len(known), 0, -1)
    rising = accumulate((min(1.0, factor * p) for factor, (p, _) in zip(factors, known, strict=True)), max)
    adjusted = [math.nan] * len(p_values)
    for (_, index), p in zip(known, rising, strict=True):
        adjusted[index] = p
    return adjusted


@lru_cache(maxsize=4)
def _drawn(size: int) -> Floats:
    """How often each cluster is in each draw, (DRAWS, size)."""
    indices = np.random.default_rng(SEED).integers(size, size=(DRAWS, size))
    return np.array([np.bincount(each, minlength=size) for each in indices], dtype=np.float64)


@lru_cache(maxsize=4)
def _signs(size: int) -> Floats:
    """All sign combinations of ``size`` differences, or SIGN_DRAWS draws of them, (N, size)."""
    if size <= MAX_EXACT:
        bits = (np.arange(2**size)[:, None] >> np.arange(size)) & 1
    else:
        bits = np.random.default_rng(SEED).integers(2, size=(SIGN_DRAWS, size))
    return (1 - 2 * bits).astype(np.float64)


def _by_cluster(values: ArrayLike, clusters: Sequence[str]) -> tuple[Floats, Floats]:
    """The sum of each cluster's values, and their number."""
    value = np.asarray(values, np.float64)
    if not value.size or value.shape != (len(clusters),):
        raise ValueError(f"values: expected a number for each of {len(clusters)} names, got {value.shape}")
    _, index = np.unique(np.asarray(clusters), return_inverse=True)
    return np.bincount(index, value).astype(np.float64), np.bincount(index).astype(np.float64)


def _tail(size: int) -> float:
    """The share of the draws beyond each end of the interval of a mean of ``size`` values."""
    from scipy.stats import norm, t

    wide = math.sqrt(size / (size - 1)) * t.ppf((1 + LEVEL) / 2, size - 1)
    return float(norm.cdf(-wide))
