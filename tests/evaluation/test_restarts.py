# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics, restarts
from tricue.track.base.track import Status, Track

FRAME = Frame(color=np.zeros((50, 50, 3), np.uint8))


class Patient:
    """Stays on its box for some updates, then is far away."""

    def __init__(self, lasts: int) -> None:
        self.lasts = lasts

    def init(self, frame, box):
        self.box = box
        return Track(box, 1.0, Status.TRACKED)

    def update(self, frame):
        self.lasts -= 1
        box = self.box if self.lasts >= 0 else Box(1000, 1000, 5, 5)
        return Track(box, 1.0, Status.TRACKED)


def still(count):
    """True boxes of a target that doesn't move."""
    return np.tile([10.0, 10, 20, 20], (count, 1))


def compute_robustness(record, truth):
    """The run's robustness."""
    return restarts.robustness(record, metrics.overlaps(record.run.boxes, truth))


def test_a_lost_tracker_starts_again_some_frames_later():
    """A failure in the third frame of each start, the next start five frames after it."""
    made = []

    def make():
        made.append(Patient(2))
        return made[-1]

    record = restarts.run(make, [FRAME] * 20, still(20))
    assert record.starts == (0, 8, 16)
    assert len(made) == 3
    idle = np.isnan(record.run.boxes).all(axis=1)
    np.testing.assert_array_equal(np.flatnonzero(idle), [4, 5, 6, 7, 12, 13, 14, 15])
    assert compute_robustness(record, still(20))[:2] == (3, 9)


def test_frames_without_truth_neither_fail_nor_start():
    """Nobody knows whether the target is lost there; the next start waits for a true box."""
    truth = still(20)
    truth[3:12] = np.nan
    record = restarts.run(lambda: Patient(2), [FRAME] * 20, truth)
    assert record.starts == (0, 17)
    assert compute_robustness(record, truth).failures == 1


def test_truth_may_end_before_the_frames():
    """The frames beyond it are tracked, and judge nothing."""
    record = restarts.run(lambda: Patient(30), [FRAME] * 20, still(5))
    assert len(record.run.boxes) == 20
    truth = np.concatenate([still(5), np.full((15, 4), np.nan)])
    assert compute_robustness(record, truth) == (0, 4, pytest.approx(np.nan, nan_ok=True))


def test_accuracy_leaves_out_the_frames_after_a_start():
    """Ten frames after a start the box counts; before, it is the start's own."""
    truth = still(30)
    truth[:10, 2:] = 1000
    record = restarts.run(lambda: Patient(99), [FRAME] * 30, still(30))
    assert compute_robustness(record, truth).accuracy == 1.0
    assert compute_robustness(record, truth).failures == 0


def test_a_tracker_that_holds_is_never_restarted():
    """One start, no failure, all frames but the first counted."""
    record = restarts.run(lambda: Patient(99), [FRAME] * 12, still(12))
    assert record.starts == (0,)
    assert compute_robustness(record, still(12)) == (0, 11, 1.0)
