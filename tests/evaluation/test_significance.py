# SPDX-License-Identifier: MIT
import math

import numpy as np
import pytest
from tricue.evaluation.markdown import telling
from tricue.evaluation.significance import compare

SEQUENCES = [f"s{index}" for index in range(20)]
APART = {name: name for name in SEQUENCES}  # a recording each


def made(mean, seed, spread=0.02):
    """A tracker's numbers by sequence: the sequence's own difficulty, and a little noise."""
    hard = np.random.default_rng(0).uniform(-0.3, 0.3, len(SEQUENCES))
    noise = np.random.default_rng(seed).normal(0, spread, len(SEQUENCES))
    return dict(zip(SEQUENCES, (mean + hard + noise).tolist(), strict=True))


def test_pairing_finds_what_intervals_of_means_hide():
    """Sequences differ far more than trackers: the intervals of the means overlap, the pair's excludes 0."""
    found = compare({"good": made(0.6, 1), "bad": made(0.55, 2), "same": made(0.6, 3)}, APART)
    assert found.means["bad"].high > found.means["good"].low
    pair = found.pair("good", "bad")
    assert pair.different
    assert pair.difference.low > 0
    assert not found.pair("good", "same").different
    assert found.leaders() == {"good", "same"}
    assert found.leaders(-1) == {"bad"}


def test_a_pair_is_the_same_from_both_sides():
    """The difference changes its sign, the p-values don't."""
    found = compare({"a": made(0.6, 1), "b": made(0.55, 2)}, APART)
    one, other = found.pair("a", "b"), found.pair("b", "a")
    assert (one.p, one.adjusted) == (other.p, other.adjusted)
    assert one.difference.mean == -other.difference.mean
    assert one.difference.low == -other.difference.high
    assert found.pair("a", "a") is None


def test_many_equal_trackers_are_not_told_apart():
    """Of 66 pairs of twelve equal trackers some have an interval of their own that excludes 0; with all pairs
    in mind none is different, and all are among the best.
    """
    found = compare({f"t{seed}": made(0.5, seed) for seed in range(12)}, APART)
    assert any(pair.difference.excludes_zero for pair in found.pairs)
    assert not any(pair.different for pair in found.pairs)
    assert len(found.leaders()) == 12


def test_few_recordings_tell_nothing():
    """However many sequences and however large the difference: five recordings have no leader."""
    recordings = {name: str(index % 5) for index, name in enumerate(SEQUENCES)}
    found = compare({"good": made(0.9, 1), "bad": made(0.1, 2)}, recordings)
    assert found.recordings == 5
    assert not found.telling
    assert not found.leaders()
    assert math.isnan(found.pair("good", "bad").adjusted)
    assert not found.means["good"].known
    assert found.means["good"].mean == pytest.approx(np.mean(list(made(0.9, 1).values())))


def test_many_pairs_of_few_recordings_have_no_leader():
    """Of six recordings the least p is 1/32: two trackers can be told apart, three have three pairs, of which
    none can differ by Holm's method, however large the difference; so none is among the best.
    """
    six = {name: name for name in SEQUENCES[:6]}
    values = {
        name: {each: made(mean, 1)[each] for each in six}
        for name, mean in (("a", 0.9), ("b", 0.5), ("c", 0.1))
    }
    two = compare({name: values[name] for name in "ab"}, six)
    assert two.separable
    assert two.leaders() == {"a"}
    three = compare(values, six)
    assert three.telling
    assert not three.separable
    assert not three.leaders()
    assert telling(three).endswith(
        "None is marked: with so few recordings, no p of 3 pairs can be under 0.05 after Holm's correction."
    )
    assert not compare({"a": values["a"]}, six).separable


def test_trackers_are_compared_where_both_ran():
    """Undefined numbers are left out; a pair without a common sequence isn't one."""
    half = {name: value for name, value in made(0.6, 1).items() if name < "s2"}
    rest = {name: value for name, value in made(0.6, 2).items() if name >= "s2"}
    unknown = dict.fromkeys(SEQUENCES, math.nan)
    found = compare({"half": half, "rest": rest, "all": made(0.6, 3), "none": unknown}, APART)
    assert found.pair("half", "rest") is None
    assert found.pair("half", "all").sequences == len(half)
    assert math.isnan(found.means["none"].mean)
