# SPDX-License-Identifier: MIT
"""Frames without the target, or with something before it, as the flow and depth tracker sees them."""

import bad_input_cases as cases
import numpy as np
import pytest
from bad_input_cases import RIG, WIDTH
from tricue import Box, FlowDepthTracker, Frame, Status

from tests.track.flow_depth.drawn_target import BOX, DEPTHS, assert_mask, framed, odd, pair, seen_by, started


@pytest.mark.parametrize("name", ["black", "white", "gray", "right black", "noise", "another scene"])
def test_a_frame_without_the_target_is_not_seen(name):
    """A frame without texture, or from another scene, is no error: the score is 0, the mask nearly empty, and
    the target is followed on in the next frames.
    """
    tracker = started(8)
    gone = tracker.update(odd(name))
    cases.assert_sane(gone)
    assert gone.score == 0
    assert np.mean(tracker.mask > 0) < 0.02
    tracks = [tracker.update(framed(shift)) for shift in range(10, 16)]
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].score > 0.5
    assert tracks[-1].box.iou(Box(BOX[0] + 15, *BOX[1:])) > 0.6


@pytest.mark.parametrize("name", ["black", "white", "gray"])
def test_the_second_frame_without_texture_is_not_seen(name):
    """Nor by flow alone, right after the first frame, when nobody knows how many pixels the target has."""
    tracker = FlowDepthTracker(cues=("flow",))
    tracker.init(framed(), BOX)
    assert tracker.update(odd(name)).score == 0
    assert not tracker.mask.any()


@pytest.mark.parametrize("name", ["black", "gray", "another scene", "another scene, nearer"])
def test_a_cut_is_lost(name):
    """After a cut to another scene, or to nothing, the target is LOST in the end, and nothing runs away."""
    tracker = started(8)
    tracks = [tracker.update(odd(name)) for _ in range(60)]
    for track in tracks:
        cases.assert_sane(track)
    assert tracks[-1].status is Status.LOST
    assert tracks[-1].score == 0


def test_two_times_the_same_frame():
    """A frame that comes twice, as of a camera too slow, loses nothing: the target is followed through."""
    tracker = started(8)
    for shift in range(9, 20):
        for _ in range(2):
            track = tracker.update(framed(shift))
            cases.assert_sane(track)
            assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 19, *BOX[1:])) > 0.6


def test_a_standing_target_is_followed():
    """Frames that are all the same keep the box where it is, to a tenth of its size."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for _ in range(25):
        track = tracker.update(framed())
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(*BOX)) > 0.8


def test_dropped_frames_are_made_up_for():
    """Where every third frame is missing the target, two pixels on, is followed all the same."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for shift in (shift for shift in range(1, 26) if shift % 3):
        track = tracker.update(framed(shift, timestamp=None))
        cases.assert_sane(track)
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 25, *BOX[1:])) > 0.6


def test_a_screen_is_an_occlusion():
    """Behind a nearer screen the target is OCCLUDED, and beyond it TRACKED again at its place."""
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    tracks = []
    for shift in range(1, 45):
        screen = 140 - 4 * shift  # comes from the right, and goes on to the left
        tracks.append(tracker.update(framed(shift, screen)))
        cases.assert_sane(tracks[-1])
    assert Status.OCCLUDED in {track.status for track in tracks}
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(BOX[0] + 44, *BOX[1:])) > 0.5


def test_leaving_the_picture_is_lost():
    """A target that walks out of the picture is LOST there, beside the picture, with finite boxes and an
    empty mask however long it stays away.
    """
    tracker = FlowDepthTracker(rig=RIG)
    tracker.init(framed(), BOX)
    for shift in range(1, 90):
        cases.assert_sane(tracker.update(framed(shift)))
    for _ in range(60):
        track = tracker.update(framed(90))
        cases.assert_sane(track)
    assert track.status is Status.LOST
    assert track.box.x > 0.7 * WIDTH
    assert_mask(tracker)
    assert not tracker.mask.any()


def test_without_depth_the_target_is_not_seen():
    """Where the depth is NaN the target isn't seen, rather than followed by flow alone, and then LOST; with
    the depth it comes back.
    """
    tracker = FlowDepthTracker(intrinsics=RIG.intrinsics)
    tracker.init(seen_by("rgbd", 0), BOX)
    for shift in range(1, 8):
        tracker.update(seen_by("rgbd", shift))
    tracks = [tracker.update(Frame(pair(shift)[0], depth=DEPTHS["NaN"])) for shift in range(8, 18)]
    assert {track.score for track in tracks} == {0}
    assert tracks[-1].status is Status.LOST
    again = [tracker.update(seen_by("rgbd", shift)) for shift in range(18, 24)]
    assert again[-1].status is Status.TRACKED
    assert again[-1].box.iou(Box(BOX[0] + 23, *BOX[1:])) > 0.6
