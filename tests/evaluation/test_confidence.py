# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from tricue.evaluation import confidence

frames = st.lists(
    st.tuples(st.sampled_from([0.0, 0.05, 0.1, 0.7]), st.integers(0, 4)), min_size=1, max_size=30
)


@given(frames)
def test_auroc_is_the_chance_that_the_better_frame_scores_higher(pairs):
    """Over all pairs of a frame on the target and a lost one, counted one by one, ties half: the same number,
    or NaN where there is no such pair.
    """
    overlaps, scores = np.array(pairs).T
    good, bad = scores[overlaps >= 0.1], scores[overlaps < 0.1]
    wins = [(a > b) + (a == b) / 2 for a in good for b in bad]
    expected = np.mean(wins) if wins else np.nan
    np.testing.assert_allclose(confidence.auroc(overlaps, scores / 4), expected, rtol=1e-12)


def test_auroc_is_scipys():
    """It is Mann and Whitney's U over the product of the sample sizes, as SciPy computes it, with ties."""
    rng = np.random.default_rng(0)
    overlaps, scores = rng.uniform(0, 0.3, 400), rng.integers(0, 20, 400) / 20
    lost = overlaps < 0.1
    u = stats.mannwhitneyu(scores[~lost], scores[lost]).statistic
    assert confidence.auroc(overlaps, scores) == pytest.approx(u / (lost.sum() * (~lost).sum()), rel=1e-12)


def test_auroc_has_its_closed_forms():
    """1 for a score that tells all, 0 for its opposite, 0.5 for one that says nothing."""
    overlaps = np.array([0.0, 0.05, 0.6, 0.8])
    assert confidence.auroc(overlaps, [0.1, 0.2, 0.3, 0.4]) == 1
    assert confidence.auroc(overlaps, [0.4, 0.3, 0.2, 0.1]) == 0
    assert confidence.auroc(overlaps, [0.4] * 4) == 0.5


@given(frames)
def test_auroc_depends_on_the_order_of_scores_alone(pairs):
    """Scores of any range count as those in [0, 1] of the same order; NaN is the lowest of all."""
    overlaps, scores = np.array(pairs).T
    expected = confidence.auroc(overlaps, scores / 4)
    for other in (1e6 * scores - 3e6, np.where(scores == 0, np.nan, np.log(np.maximum(scores, 1)) - 9)):
        np.testing.assert_allclose(confidence.auroc(overlaps, other), expected, rtol=1e-12)


def test_absent_frames_are_lost_and_unknown_ones_do_not_count():
    """Beside a true absence the overlap doesn't matter, NaN or not; NaN alone leaves the frame out."""
    overlaps, absent = np.array([0.9, np.nan, 0.9, np.nan]), np.array([False, True, True, False])
    np.testing.assert_array_equal(confidence.lost(overlaps, absent), [False, True, True, False])
    assert confidence.auroc(overlaps, [0.8, 0.2, 0.9, 0.0], absent) == 0.5
    said = np.array([True, True, False, True])
    assert confidence.tracked_while_lost(overlaps, said, absent) == (0.5, 1 / 3)
    assert confidence.tracked(overlaps, said, absent) == 2 / 3
    np.testing.assert_array_equal(
        confidence.reliability(overlaps, [0.8, 0.2, 0.9, 0.0], absent).counts.sum(), 3
    )


def test_tracked_while_lost_counts_frames():
    """Of five frames three are lost, in two of which the tracker says that all is well."""
    overlaps = np.array([0.5, 0.0, 0.09, 0.05, 0.1])
    said = np.array([True, True, True, False, True])
    assert confidence.tracked_while_lost(overlaps, said) == (pytest.approx(2 / 3), pytest.approx(0.4))


def test_empty_classes_are_nan():
    """What isn't defined is NaN, and no warning: no lost frame, none on the target, none at all."""
    assert np.isnan(confidence.auroc([0.8, 0.9], [0.1, 0.2]))
    assert np.isnan(confidence.auroc([0.0, 0.0], [0.1, 0.2]))
    assert np.isnan(confidence.auroc([np.nan], [0.1]))
    np.testing.assert_array_equal(confidence.tracked_while_lost([0.8], np.array([True])), [np.nan, 0.0])
    np.testing.assert_array_equal(confidence.tracked_while_lost([np.nan], np.array([True])), [np.nan, np.nan])
    assert np.isnan(confidence.tracked([np.nan], np.array([True])))


def test_reliability_is_the_mean_in_each_bin():
    """Bins hold their lower edge, the last also 1; means and counts are those of a loop over the frames."""
    rng = np.random.default_rng(1)
    scores = np.concatenate([rng.integers(0, 11, 200) / 10, [0.0, 0.1, 1.0]])
    overlaps = rng.uniform(0, 1, scores.size)
    curve = confidence.reliability(overlaps, scores, bins=5)
    for index, (low, high) in enumerate(zip(curve.edges, curve.edges[1:], strict=False)):
        inside = (scores >= low) & ((scores < high) | (high == 1))
        assert curve.counts[index] == inside.sum()
        assert curve.overlaps[index] == pytest.approx(overlaps[inside].mean())
        assert curve.scores[index] == pytest.approx(scores[inside].mean())


def test_reliability_of_few_frames_has_gaps():
    """An empty bin is NaN; in an absent frame the overlap is 0 whatever the box was."""
    curve = confidence.reliability([0.8, 0.6], [0.95, 0.92], np.array([False, True]))
    np.testing.assert_array_equal(curve.counts, [0] * 9 + [2])
    np.testing.assert_allclose(curve.overlaps, [np.nan] * 9 + [0.4])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: confidence.auroc([[0.5]], [0.5]), "overlaps: expected an array of shape"),
        (lambda: confidence.auroc([0.5], [0.5, 0.6]), "scores: expected an array of shape"),
        (lambda: confidence.reliability([0.5], [1.5]), r"scores: expected numbers in \[0, 1\]"),
        (lambda: confidence.reliability([0.5], [np.nan]), r"scores: expected numbers in \[0, 1\]"),
        (lambda: confidence.auroc([0.5], [0.5], [1]), "absent: expected bool"),
        (lambda: confidence.tracked_while_lost([0.5], [0.9]), "reported_present: expected bool"),
        (lambda: confidence.reliability([0.5], [0.5], bins=0), "bins: expected 1 or more"),
    ],
)
def test_bad_input_is_named(call, words):
    """Every malformed argument is refused by name."""
    with pytest.raises(ValueError, match=words):
        call()
