# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.papers.roc import Roc, roc


def random_pairs(seed, count=3):
    """Score maps that overlap between the classes, and their masks."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        mask = rng.random((9, 7)) < 0.4
        yield np.clip(rng.normal(np.where(mask, 60, -20), 90), -255, 255).astype(np.int16), mask


@given(st.integers(0, 2**32 - 1))
def test_curve_counts_pixels_above_each_threshold(seed):
    """Every point of the curve is what counting the pixels above its threshold gives."""
    pairs = list(random_pairs(seed))
    scores = np.concatenate([score.ravel() for score, _ in pairs])
    mask = np.concatenate([mask.ravel() for _, mask in pairs])
    curve = roc(pairs)
    for fpr, tpr, threshold in zip(curve.fpr, curve.tpr, curve.thresholds, strict=True):
        assert fpr == np.mean(scores[~mask] > threshold)
        assert tpr == np.mean(scores[mask] > threshold)


@given(st.integers(0, 2**32 - 1))
def test_area_is_the_rank_statistic(seed):
    """The area is the share of pairs (skin, other) in the right order, ties counted half (Mann-Whitney)."""
    pairs = list(random_pairs(seed))
    scores = np.concatenate([score.ravel() for score, _ in pairs]).astype(int)
    mask = np.concatenate([mask.ravel() for _, mask in pairs])
    difference = scores[mask][:, None] - scores[~mask][None]
    assert roc(pairs).area == pytest.approx(
        np.mean(np.where(difference == 0, 0.5, difference > 0)), abs=1e-12
    )


@given(st.integers(0, 2**32 - 1))
def test_curve_is_monotone_from_corner_to_corner(seed):
    """Both rates rise from 0 to 1 as the threshold falls."""
    curve = roc(random_pairs(seed))
    assert (curve.fpr[0], curve.tpr[0], curve.fpr[-1], curve.tpr[-1]) == (0, 0, 1, 1)
    assert np.all(np.diff(curve.fpr) >= 0)
    assert np.all(np.diff(curve.tpr) >= 0)
    assert np.all(np.diff(curve.thresholds) == -1)


@given(st.integers(0, 2**32 - 1), st.floats(0, 1))
def test_chosen_threshold_keeps_the_rate_and_no_lower_one_does(seed, rate):
    """The threshold at a chosen rate keeps it, and the next lower threshold would not."""
    curve = roc(random_pairs(seed))
    threshold, tpr = curve.at_false_positive_rate(rate)
    chosen = np.flatnonzero(curve.thresholds == threshold)[0]
    assert curve.fpr[chosen] <= rate
    assert curve.tpr[chosen] == tpr
    assert chosen + 1 == len(curve.fpr) or curve.fpr[chosen + 1] > rate


def test_perfect_and_useless_scores():
    """A score that separates the classes has area 1, and a constant one 1/2."""
    mask = np.array([[True, False, True]])
    assert roc([(np.where(mask, 9, 8), mask)]).area == 1.0
    assert roc([(np.zeros((1, 3), int), mask)]).area == 0.5


MASK = np.array([[True, False]])


@pytest.mark.parametrize(
    ("pairs", "error", "words"),
    [
        ([(np.zeros((1, 2), int), MASK.astype(int))], ValueError, "masks: expected bool"),
        ([(np.zeros((2, 1), int), MASK)], ValueError, "masks: expected bool of shape"),
        ([(np.zeros((1, 2)), MASK)], TypeError, "scores: expected integers"),
        ([(np.full((1, 2), 256), MASK)], ValueError, "scores: expected values in"),
        ([(np.zeros((1, 2), int), MASK | True)], ValueError, "masks: .*, found only skin"),
        ([], ValueError, "masks: expected skin and other pixels, found no skin"),
    ],
)
def test_bad_maps_are_named(pairs, error, words):
    """Every malformed argument is refused by name."""
    with pytest.raises(error, match=words):
        roc(pairs)


@pytest.mark.parametrize("rate", [-0.1, 1.1, np.nan])
def test_bad_rate_is_named(rate):
    """A false-positive rate outside [0, 1] is refused by name."""
    curve = Roc(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([1.0, 0.0]))
    with pytest.raises(ValueError, match="rate: expected"):
        curve.at_false_positive_rate(rate)
