# SPDX-License-Identifier: MIT
from types import SimpleNamespace

import numpy as np
import pytest
from tricue.evaluation import confidence
from tricue.track.base.track import Status

from benchmarks.quality.common.frame_results import FrameResults

BOX, AWAY, NAN = (10.0, 10, 20, 20), (100.0, 100, 20, 20), float("nan")


def test_numbers_of_pooled_frames():
    """Every frame counts the same; the time of a run's first frame is unknown, and each other frame has that
    of its update. Depths are compared where they are known.
    """
    run = SimpleNamespace(
        scores=np.array([1.0, 0.9, 0.2]),
        statuses=(Status.TRACKED, Status.TRACKED, Status.LOST),
        seconds=np.array([0.001, 0.003]),
        positions=np.array([[0, 0, 2.1], [0, 0, 1.5], [NAN, NAN, NAN]]),
        covariances=np.array([np.diag([9, 9, 0.04]), np.diag([9, 9, 0.25]), np.full((3, 3), NAN)]),
    )
    boxes, truth, there = np.array([BOX, BOX, AWAY]), np.array([BOX] * 3), np.zeros(3, np.bool_)
    frames = FrameResults.of(run, boxes, truth, there, depths=np.array([2.0, NAN, 2.0]))
    np.testing.assert_array_equal(frames.overlaps, [1, 1, 0])
    np.testing.assert_array_equal(frames.tracked, [True, True, False])
    np.testing.assert_array_equal(frames.seconds, [NAN, 0.001, 0.003])
    np.testing.assert_allclose(frames.depth_errors, [0.1, NAN, NAN])
    np.testing.assert_allclose(frames.depth_sigmas, [0.2, 0.5, NAN])
    assert np.isnan(FrameResults.of(run, boxes, truth, there).depth_errors).all()
    assert frames.milliseconds == pytest.approx(2)
    assert frames.mean_overlap == pytest.approx(2 / 3)
    assert frames.auc == pytest.approx(2 / 3 * 20 / 21)
    twice = FrameResults.pooled([frames, frames])
    assert len(twice.seconds) == 6
    assert twice.milliseconds == frames.milliseconds
    assert twice.auroc == confidence.auroc(frames.overlaps, frames.scores, frames.absent) == 1


def test_a_failed_tracker_has_no_times_from_then_on():
    """Its frames count as lost, and their times are unknown."""
    lost = np.full((4, 3, 3), NAN)
    run = SimpleNamespace(
        scores=np.zeros(4), statuses=4 * (Status.LOST,), seconds=np.array([0.001]), positions=lost[:, 0],
        covariances=lost,
    )  # fmt: skip
    boxes, truth = np.full((4, 4), NAN), np.array([BOX] * 4)
    frames = FrameResults.of(run, boxes, truth, np.zeros(4, np.bool_))
    np.testing.assert_array_equal(frames.seconds, [NAN, 0.001, NAN, NAN])
    assert frames.milliseconds == pytest.approx(1)
