# SPDX-License-Identifier: MIT
"""Significance tests: means over sequences with intervals, and each pair's paired difference.

A pair is compared on the sequences on which both ran. Its interval isn't adjusted: one in twenty excludes 0
by chance. A pair counts as different by its p-value, which is adjusted for the number of pairs.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from tricue.evaluation.bootstrap import (
    LEVEL,
    MIN_CLUSTERS,
    Interval,
    holm,
    mean_interval,
    separable,
    sign_flip_p,
)

Values = Mapping[str, float]
"""One number per sequence: the mean over one tracker's runs on it; NaN where undefined."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two trackers on the sequences that both have. difference: the first's mean minus the second's."""

    first: str
    second: str
    sequences: int
    recordings: int
    difference: Interval
    p: float
    """The p-value of this pair's sign-flip test alone; NaN if there are too few recordings."""
    adjusted: float
    """The same, adjusted for all pairs of the comparison by Holm's method."""

    @property
    def different(self) -> bool:
        """Whether they differ at LEVEL, given the number of pairs."""
        return self.adjusted < 1 - LEVEL


@dataclass(frozen=True, slots=True)
class TrackerComparison:
    """Several trackers, compared by one number. means: by tracker. pairs: all with a sequence in common."""

    means: Mapping[str, Interval]
    pairs: Sequence[Pair]
    recordings: int
    """The number of independent recordings among the sequences."""

    @property
    def telling(self) -> bool:
        """Whether there are enough recordings for intervals."""
        return self.recordings >= MIN_CLUSTERS

    @property
    def separable(self) -> bool:
        """Whether there are enough recordings to tell trackers apart, given the number of pairs."""
        return separable([each.recordings for each in self.pairs if not math.isnan(each.p)])

    def pair(self, first: str, second: str) -> Pair | None:
        """The pair in this order; None if they have no sequence in common."""
        for each in self.pairs:
            if (each.first, each.second) == (first, second):
                return each
            if (each.first, each.second) == (second, first):
                return _swapped(each)
        return None

    def leaders(self, better: int = 1) -> frozenset[str]:
        """The tracker with the best mean, and those that can't be distinguished from it; none with too few
        recordings. better: 1 if higher is better, -1 if lower.
        """
        known = {name: each.mean for name, each in self.means.items() if not math.isnan(each.mean)}
        if not self.separable or len(known) < 2:
            return frozenset()
        best = max(known, key=lambda name: better * known[name])
        equals = {each for each in known if (pair := self.pair(best, each)) and not pair.different}
        return frozenset({best, *equals})


def compare(values: Mapping[str, Values], recordings: Mapping[str, str]) -> TrackerComparison:
    """Compare trackers. values: by tracker. recordings: the recording of each sequence; sequences of one
    recording are resampled together, and a sequence not listed is a recording of its own.
    """
    known = {
        name: {sequence: value for sequence, value in each.items() if not math.isnan(value)}
        for name, each in values.items()
    }
    means = {name: interval_of(each, recordings) for name, each in known.items()}
    found = [_pair(first, second, known, recordings) for first, second in combinations(known, 2)]
    pairs = [each for each in found if each is not None]
    adjusted = holm([each.p for each in pairs])
    sequences = {sequence for each in known.values() for sequence in each}
    return TrackerComparison(
        means,
        [_with_adjusted(each, p) for each, p in zip(pairs, adjusted, strict=True)],
        len({recordings.get(each, each) for each in sequences}),
    )


def interval_of(values: Values, recordings: Mapping[str, str]) -> Interval:
    """The mean over sequences with its interval; NaN without any."""
    if not values:
        return Interval(math.nan, math.nan, math.nan)
    return mean_interval(list(values.values()), [recordings.get(each, each) for each in values])


def _pair(
    first: str, second: str, values: Mapping[str, Values], recordings: Mapping[str, str]
) -> Pair | None:
    one, other = values[first], values[second]
    common = [each for each in one if each in other]
    if not common:
        return None
    differences = [one[each] - other[each] for each in common]
    clusters = [recordings.get(each, each) for each in common]
    p = sign_flip_p(differences, clusters)
    interval = mean_interval(differences, clusters)
    return Pair(first, second, len(common), len(set(clusters)), interval, p, p)


def _with_adjusted(pair: Pair, adjusted: float) -> Pair:
    return Pair(pair.first, pair.second, pair.sequences, pair.recordings, pair.difference, pair.p, adjusted)


def _swapped(pair: Pair) -> Pair:
    mean, low, high = pair.difference
    turned = Interval(-mean, -high, -low)
    return Pair(pair.second, pair.first, pair.sequences, pair.recordings, turned, pair.p, pair.adjusted)
