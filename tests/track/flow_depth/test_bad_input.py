# SPDX-License-Identifier: MIT
"""Input that the flow and depth tracker refuses: errors name it and leave the state."""

import copy
from typing import Any

import bad_input_cases as cases
import numpy as np
import pytest
from bad_input_cases import RIG
from tricue import Box, FlowDepthTracker, Frame, Intrinsics, Status
from tricue.errors import NoDepthInBoxError

from tests.track.flow_depth.drawn_target import (
    BOX,
    DEPTH,
    DISPARITY,
    FLOW,
    LEFT,
    NEXT,
    OURS,
    RIGHT,
    assert_mask,
    framed,
    odd,
    seen_by,
    started,
)

BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.BARE_DEPTHS,
    **cases.NO_PAIRS,
    **cases.ONE_IMAGE,
    **cases.NO_DEPTHS,
    **cases.UNREGISTERED,
}
LACKING = [
    (FLOW, Frame(depth=DEPTH), "color"),
    (DISPARITY, Frame(LEFT), "right or depth"),
    ({}, Frame(LEFT), "right or depth"),
    ({}, Frame(depth=DEPTH), "color"),
]
BAD_BOXES = {**cases.BAD_BOXES, "none": (None, ValueError, "expected .*needs an initial box")}
EXPECTED = started().update(NEXT)


def test_all_is_well():
    """The pair that the cases below spoil is followed: the target is where it was drawn, at its distance."""
    assert EXPECTED.status is Status.TRACKED
    assert EXPECTED.box.iou(Box(BOX[0] + 5, *BOX[1:])) > 0.8
    assert EXPECTED.position[2] == pytest.approx(RIG.depth(OURS), rel=0.03)


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_bad_frames_are_named(name):
    """What is no frame for both cues gets an error that says so, at init and update, and nothing changes."""
    frame, error, message = BAD_FRAMES[name]
    tracker = started()
    with pytest.raises(error, match=message):
        tracker.update(frame())
    with pytest.raises(error, match=message):
        tracker.init(frame(), BOX)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize(("cues", "frame", "channel"), LACKING, ids=str)
def test_missing_channels_are_named(cues, frame, channel):
    """Each choice of cues names the channel that it lacks, at init and at update."""
    tracker = FlowDepthTracker(**cues)
    message = f"^frame: expected the channel {channel}, "
    with pytest.raises(ValueError, match=message):
        tracker.init(frame, BOX)
    tracker.init(framed(), BOX)
    with pytest.raises(ValueError, match=message):
        tracker.update(frame)
    cases.assert_sane(tracker.update(NEXT))


@pytest.mark.parametrize(
    ("cues", "camera"),
    [
        ({}, "pair"),
        ({}, "rgbd"),
        (FLOW, "pair"),
        (FLOW, "rgbd"),
        (FLOW, "color"),
        (DISPARITY, "pair"),
        (DISPARITY, "rgbd"),
        (DISPARITY, "depth"),
    ],
    ids=str,
)
def test_enough_channels_are_enough(cues, camera):
    """Each choice of cues follows with the channels that it needs, and with more of them."""
    tracker = FlowDepthTracker(**cues)
    tracker.init(seen_by(camera, 0), BOX)
    for shift in range(1, 9):
        track = tracker.update(seen_by(camera, shift))
        cases.assert_sane(track)
    assert_mask(tracker)
    assert track.status is Status.TRACKED
    assert track.box.iou(Box(BOX[0] + 8, *BOX[1:])) > 0.7


@pytest.mark.parametrize("name", BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the old target is followed on."""
    box, error, message = BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(framed(), box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", ["black", "white", "gray", "right black", "noise"])
@pytest.mark.parametrize("cues", [{}, DISPARITY], ids=str)
def test_a_start_on_nothing_is_named(name, cues):
    """A pair in which nothing in the box has a disparity in common is an error that shows the box, and the
    old target is followed on.
    """
    tracker = started(**cues)
    expected = copy.deepcopy(tracker).update(NEXT)
    with pytest.raises(ValueError, match=r"^box: expected a target with a disparity, got hardly any in \(48"):
        tracker.init(odd(name), BOX)
    assert tracker.update(NEXT) == expected


def test_a_box_of_too_few_cells_is_named():
    """A depth image without gaps isn't blamed for a box that is too small to share a disparity in."""
    frame = Frame(np.zeros((480, 640, 3), np.uint8), depth=np.full((480, 640), 2.0, np.float32))
    with pytest.raises(NoDepthInBoxError, match="in 12 cells of 2x2 pixels or more, got 9 in the"):
        FlowDepthTracker().init(frame, (100, 100, 6, 6))


@pytest.mark.parametrize("shape", cases.OTHER_SHAPES, ids=str)
def test_another_size_is_named(shape):
    """A pair of another size than the first is an error that says both, and nothing changes by it."""
    tracker = started()
    other = np.zeros((*shape, 3), np.uint8)
    expected = (
        rf"^frame.color: expected the first frame's shape \(96, 128, 3\), got \({shape[0]}, {shape[1]}, 3\)"
    )
    with pytest.raises(ValueError, match=expected):
        tracker.update(Frame(other, right=other))
    assert tracker.update(NEXT) == EXPECTED


def test_disparity_alone_does_without_color_in_some_frames():
    """Where only depth is measured, frames with color and without it give the same tracks, in any order."""
    with_color, without = Frame(LEFT, depth=DEPTH), Frame(depth=DEPTH)
    orders = [(without, without, without), (with_color, without, with_color), (without, with_color, without)]
    tracks = []
    for first, *others in orders:
        tracker = FlowDepthTracker(cues=("disparity",), intrinsics=cases.CAMERA)
        tracks.append([tracker.init(first, BOX), *map(tracker.update, others)])
    assert tracks[1] == tracks[2] == tracks[0]


def test_a_calibration_of_another_size_is_named():
    """A first frame of another size than the rig's or the camera's is an error that says both."""
    small = Frame(LEFT[::2, ::2], right=RIGHT[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.color: expected the rig's size, 128x96, got 64x48"):
        FlowDepthTracker(rig=RIG).init(small, (24, 15, 16, 19))
    small = Frame(LEFT[::2, ::2], depth=DEPTH[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.depth: expected the camera's size, 128x96, got 64x48"):
        FlowDepthTracker(intrinsics=RIG.intrinsics).init(small, (24, 15, 16, 19))
    with pytest.raises(ValueError, match=r"^frame.color: expected the camera's size, .*of the color image"):
        FlowDepthTracker(**FLOW, intrinsics=RIG.intrinsics).init(small, (24, 15, 16, 19))
    small = Frame(depth=DEPTH[::2, ::2])
    with pytest.raises(ValueError, match=r"^frame.depth: expected the rig's size, 128x96, got 64x48"):
        FlowDepthTracker(cues=("disparity",), rig=RIG).init(small, (24, 15, 16, 19))


@pytest.mark.parametrize("rig", cases.NO_RIGS, ids=lambda each: type(each).__name__)
def test_what_is_no_calibration_is_named(rig):
    """A rig or camera of another type is a TypeError that names it, and so are both at once."""
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got "):
        FlowDepthTracker(rig=rig)
    if not isinstance(rig, Intrinsics):
        with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got "):
            FlowDepthTracker(intrinsics=rig)
    with pytest.raises(TypeError, match=r"^intrinsics: expected without rig"):
        FlowDepthTracker(rig=RIG, intrinsics=RIG.intrinsics)


def test_update_before_init_is_named():
    """Update before init, and after an init that failed, is a RuntimeError that says what to do; there are
    neither mask nor blocks.
    """
    tracker = FlowDepthTracker()
    for _ in range(2):
        with pytest.raises(RuntimeError, match=r"^update: expected init first"):
            tracker.update(framed())
        assert tracker.mask is None
        assert tracker.blocks == ((), ())
        with pytest.raises(ValueError, match=r"^box: "):
            tracker.init(framed(), (0, 0, 0, 0))


@pytest.mark.parametrize(
    "kernel",
    [
        "pyramid_flow",
        "gradient_disparity",
        "target_model",
        "observe_target",
        "block_votes",
        "target_outline",
        "back_project",
    ],
)
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was."""
    tracker = started(kernels="reference")
    before = tracker.mask

    def fail(*_: Any, **__: Any) -> None:
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(tracker._k, kernel, fail)
        with pytest.raises(MemoryError):
            tracker.update(NEXT)
    np.testing.assert_array_equal(tracker.mask, before)
    cases.assert_errors_leave_the_state(tracker, kernel, NEXT, monkeypatch)
