# SPDX-License-Identifier: MIT
from collections.abc import Callable

import numpy as np
import pytest
import tricue
from tricue.scenes import WalkScene, head
from tricue.track.base.adapter import adapt_class
from tricue.track.base.track import Tracker

BRIGHT = np.full((20, 30, 3), 200, np.uint8)


def test_a_loop_written_for_opencv_runs(drift: Tracker) -> None:
    """It proves that init gives None and update a bool and a tuple of four ints, as cv2's trackers do."""
    tracker = tricue.as_opencv(drift)
    assert tracker.init(BRIGHT, (1, 2, 8, 9)) is None  # type: ignore[func-returns-value]
    ok, box = tracker.update(BRIGHT)
    assert ok is True
    assert box == (4, 2, 8, 9)  # 1 + 2.5 rounds to the even 4
    assert all(type(number) is int for number in box)
    assert tracker.getTrackingScore() == pytest.approx(200 / 255)


@pytest.mark.parametrize(("value", "ok"), [(200, True), (20, True), (0, False)])
def test_only_lost_is_not_ok(drift: Tracker, value: int, ok: bool) -> None:
    """It proves that tracked and occluded targets are ok, a lost one isn't."""
    tracker = tricue.as_opencv(drift)
    tracker.init(BRIGHT, (1, 2, 8, 9))
    assert tracker.update(np.full_like(BRIGHT, value))[0] is ok


def test_a_box_that_is_unknown_is_the_last_one() -> None:
    """A third party's tracker may not know where a lost target is; whole numbers are wanted all the same."""

    class Unsure:
        def init(self, image: object, box: object) -> None: ...

        def update(self, image: object) -> tricue.Track:
            return tricue.Track(tricue.Box(float("nan"), 0, 1, 1), 0.0, tricue.Status.LOST)

    tracker = tricue.as_opencv(adapt_class(Unsure)())
    tracker.init(BRIGHT, (1, 2, 8, 9))
    assert tracker.update(BRIGHT) == (False, (1, 2, 8, 9))


def test_init_starts_again(drift: Tracker) -> None:
    """It proves that a second init restarts, which cv2's trackers once didn't allow."""
    tracker = tricue.as_opencv(drift)
    for _ in range(2):
        tracker.init(BRIGHT, boundingBox=(1, 2, 8, 9))
        assert tracker.update(BRIGHT)[1] == (4, 2, 8, 9)


def test_misuse_is_named(drift: Tracker) -> None:
    """It proves that what is no tracker is refused, and a score before init too."""
    with pytest.raises(TypeError, match=r"^tracker: expected a tricue tracker, got str"):
        tricue.as_opencv("csrt")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"^tracker: expected a tricue tracker, got the class FusedTracker$"):
        tricue.as_opencv(tricue.FusedTracker)  # type: ignore[arg-type]
    with pytest.raises(RuntimeError, match="expected init first"):
        tricue.as_opencv(drift).getTrackingScore()


def test_stereo_pairs_pass_through() -> None:
    """It proves that a loop written for OpenCV can follow a head, given frames with both images, and is told
    by name when one is missing.
    """
    scene = head(0, 6)
    tracker = tricue.as_opencv(tricue.create("stereo-head", rig=scene.rig))
    plain = tricue.create("stereo-head", rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    plain.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:]:
        assert tracker.update(frame) == (True, plain.update(frame).box.as_int())
    with pytest.raises(ValueError, match="expected the channel right"):
        tracker.update(scene.frames[0].color)  # type: ignore[arg-type]


def test_color_alone_is_enough_for_flow(overtakings: Callable[..., WalkScene]) -> None:
    """It proves that a loop written for OpenCV can follow a walker by flow alone from bare images, and by
    both cues from frames.
    """
    scene = overtakings(0, 55)
    for cues in (("flow",), ("flow", "disparity")):
        frames = [frame.color if len(cues) == 1 else frame for frame in scene.frames[:9]]
        tracker = tricue.as_opencv(tricue.create("flow-depth", cues=cues))
        plain = tricue.create("flow-depth", cues=cues)
        tracker.init(frames[0], scene.boxes[0])  # type: ignore[arg-type]
        plain.init(frames[0], scene.boxes[0])  # type: ignore[arg-type]
        for frame in frames[1:]:
            assert tracker.update(frame) == (True, plain.update(frame).box.as_int())  # type: ignore[arg-type]
