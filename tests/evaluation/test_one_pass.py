# SPDX-License-Identifier: MIT
import time

import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.evaluation.one_pass import run
from tricue.track.base.track import Status, Track


class Scripted:
    """Says a new box each frame, slowly, and remembers what it was given."""

    def init(self, frame, box):
        self.seen, self.threads = [frame], cv2.getNumThreads()
        return Track(box, 1.0, Status.TRACKED)

    def update(self, frame):
        self.seen.append(frame)
        time.sleep(0.002)
        count = len(self.seen)
        status = Status.LOST if count == 3 else Status.TRACKED
        place = None if count == 3 else np.array([0.0, 0.5, count])
        return Track(Box(float(count), 0.0, 1.0, 1.0), 1 / count, status, place)


def test_run_records_every_frame_in_order(patrol):
    """The tracker gets each frame once in order; boxes, statuses, positions, times are its answers'."""
    frames, boxes = patrol
    tracker = Scripted()
    result = run(tracker, frames[:4], boxes[0])
    assert all(a is b for a, b in zip(tracker.seen, frames[:4], strict=True))
    np.testing.assert_array_equal(result.boxes[:, 0], [boxes[0].x, 2, 3, 4])
    np.testing.assert_array_equal(result.scores, [1, 1 / 2, 1 / 3, 1 / 4])
    assert result.statuses == (Status.TRACKED, Status.TRACKED, Status.LOST, Status.TRACKED)
    assert result.lost == 0.25
    unknown = [np.nan] * 3
    np.testing.assert_array_equal(result.positions, [unknown, [0, 0.5, 2], unknown, [0, 0.5, 4]])
    assert result.seconds.shape == (3,)
    assert result.seconds.min() >= 0.002
    assert result.frames_per_second == pytest.approx(3 / result.seconds.sum())


def test_opencv_has_one_thread_inside_and_its_own_number_after(patrol):
    """OpenCV is held to one thread while a tracker runs, and gets its threads back, after an error too."""
    frames, boxes = patrol
    before = cv2.getNumThreads()
    tracker = Scripted()
    run(tracker, frames[:2], boxes[0])
    assert tracker.threads == 1
    assert cv2.getNumThreads() == before
    with pytest.raises(AttributeError):
        run(object(), frames, boxes[0])
    assert cv2.getNumThreads() == before


def test_too_few_frames_are_named(patrol):
    """Less than one frame after the start is refused by name."""
    with pytest.raises(ValueError, match="frames: expected 2 or more, got 1"):
        run(Scripted(), patrol[0][:1], patrol[1][0])


def test_frames_before_the_start_have_no_box(patrol):
    """The tracker sees nothing of them, and starts on the box in the start's frame."""
    frames, boxes = patrol
    tracker = Scripted()
    result = run(tracker, iter(frames[:5]), boxes[2], start=2)
    assert tracker.seen[0] is frames[2]
    np.testing.assert_array_equal(result.boxes[:3, 0], [np.nan, np.nan, boxes[2].x])
    assert result.statuses[:2] == (Status.LOST, Status.LOST)
    assert result.seconds.shape == (2,)
    with pytest.raises(ValueError, match="frames: expected 7 or more, got 5"):
        run(tracker, frames[:5], boxes[0], start=5)
