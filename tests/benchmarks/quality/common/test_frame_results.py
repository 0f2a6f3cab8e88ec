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
    of its update.
    """
    run = SimpleNamespace(
        scores=np.array([1.0, 0.9, 0.2]),
        statuses=(Status.TRACKED, Status.TRACKED, Status.LOST),
        seconds=np.array([0.001, 0.003]),
    )
    frames = FrameResults.of(
        run, np.array([BOX, BOX, AWAY]), np.array([BOX] * 3), absent=np.zeros(3, np.bool_)
    )
    np.testing.assert_array_equal(frames.overlaps, [1, 1, 0])
    np.testing.assert_array_equal(frames.tracked, [True, True, False])
    np.testing.assert_array_equal(frames.seconds, [NAN, 0.001, 0.003])
    assert frames.milliseconds == pytest.approx(2)
    assert frames.auc == pytest.approx(2 / 3 * 20 / 21)
    twice = FrameResults.pooled([frames, frames])
    assert len(twice.seconds) == 6
    assert twice.milliseconds == frames.milliseconds
    assert twice.auroc == confidence.auroc(frames.overlaps, frames.scores, frames.absent) == 1
