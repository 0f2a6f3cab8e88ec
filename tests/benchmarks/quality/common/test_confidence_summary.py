# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common.confidence_summary import reliability, summarize
from benchmarks.quality.common.frame_results import FrameResults

NAN = float("nan")


def made(overlaps, scores, tracked=None, absent=None):
    """Frames of these numbers."""
    count = len(overlaps)
    return FrameResults(
        np.array(overlaps, float),
        np.zeros(count, np.bool_) if absent is None else np.array(absent),
        np.array(scores, float),
        np.ones(count, np.bool_) if tracked is None else np.array(tracked),
        *[np.full(count, NAN)] * 3,
    )


def test_shares_of_lost_frames_and_of_those_on_the_target():
    """Lost is an overlap under 0.1 or an absent target, on the target one above 0.3; unknown frames count for
    neither.
    """
    found = summarize(
        made(
            overlaps=[1.0, 0.31, 0.3, 0.05, 0.0, NAN, 0.8],
            scores=[1.0, 0.2, 0.5, 0.4, 0.1, 0.9, 0.3],
            tracked=[True, False, False, True, False, False, True],
            absent=[False] * 6 + [True],
        )
    )
    assert found.lost == 3 / 6
    assert found.tracked_of_lost == 2 / 3
    assert found.untracked_of_on_target == 1 / 2
    # Of the pairs of (1, 0.2) with (0.4, 0.1, 0.3) four are in order; the frame of overlap 0.3 is in none.
    assert found.auroc == pytest.approx(4 / 6)


def test_calibration_by_hand():
    """Ten frames in two bins: 0.95 where 6 of 8 are on the target, 0.25 where 1 of 2 is. The deviations are
    0.2 and 0.25, their mean by frames 0.21.
    """
    frames = made([0.9] * 6 + [0.2, 0.0] + [0.5, 0.0], [0.95] * 8 + [0.25] * 2)
    found = reliability(frames)
    assert (len(found.counts), found.counts[9], found.counts[2]) == (10, 8, 2)
    assert found.scores[9] == pytest.approx(0.95)
    assert found.overlaps[[2, 9]] == pytest.approx([0.5, 0.75])
    summary = summarize(frames)
    assert summary.deviation == pytest.approx(0.25)
    assert summary.calibration_error == pytest.approx(0.8 * 0.2 + 0.2 * 0.25)


def test_bins_of_few_frames_have_no_say_in_the_largest_deviation():
    """One of 101 frames is a hundredth at most, and its wrong score counts in the mean alone; of 100 it does
    in both.
    """
    rare, enough = (made([1.0] * count + [0.0], [1.0] * count + [0.85]) for count in (100, 99))
    assert summarize(rare).deviation == 0
    assert summarize(rare).calibration_error == pytest.approx(0.85 / 101)
    assert summarize(enough).deviation == pytest.approx(0.85)


def test_probabilities_are_calibrated():
    """Frames that are on the target with the probability that is their score have no error but noise: of
    20,000 in ten bins, the share of a bin has a deviation of 0.011 at most.
    """
    rng = np.random.default_rng(0)
    scores = rng.random(20_000)
    summary = summarize(made((rng.random(20_000) < scores).astype(float), scores))
    assert summary.deviation < 4 * 0.011
    assert summary.calibration_error < 0.02


def test_nothing_known():
    """Frames without truth have no numbers."""
    assert np.isnan(summarize(made([NAN, NAN], [1.0, 0.5]))).all()
