# SPDX-License-Identifier: MIT
"""That complete occlusion begins and ends as section 4.5 prints it."""

import numpy as np
import pytest
from tricue import FlowDepthTracker, Frame, Status, Track
from tricue.scenes import WalkScene

T, O = Status.TRACKED, Status.OCCLUDED  # noqa: E741
PAPER = FlowDepthTracker.Params.paper()
SEEN = 6  # frames in which the target is seen, before anybody comes near
NEAR = 2.5  # meters, of a board that hides everything


@pytest.fixture(scope="module")
def scene(overtakings) -> WalkScene:
    """A walker before a depth camera, whose jumps of disparity are measured however large."""
    return overtakings(3, 55, depth=True)


def tracker_on(scene: WalkScene) -> FlowDepthTracker:
    """The tracker as printed, after the frames in which the target is seen."""
    tracker = FlowDepthTracker(PAPER, rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    tracks = [tracker.update(frame) for frame in scene.frames[1:SEEN]]
    assert {track.status for track in tracks} == {T}
    return tracker


def behind_a_board(tracker: FlowDepthTracker, scene: WalkScene, frames: int) -> list[Track]:
    """The tracks of so many frames in whose depth a board hides everything."""
    board = np.full_like(scene.frames[SEEN].depth, NEAR)
    hidden = scene.frames[SEEN : SEEN + frames]
    return [tracker.update(Frame(frame.color, depth=board)) for frame in hidden]


def test_a_jump_of_the_disparity_hides_the_target(scene: WalkScene):
    """Once the disparity in the window is much larger, the target is OCCLUDED, from that frame on and as long
    as it stays so. It moves on at its last velocity, and its depth and the box's size stay those of before;
    no pixel is the target's.
    """
    tracker = tracker_on(scene)
    assert tracker.mask.any()
    first, *tracks = behind_a_board(tracker, scene, 8)
    assert not tracker.mask.any()
    assert {track.status for track in (first, *tracks)} == {O}
    steps = np.diff([track.box for track in (first, *tracks)], axis=0)
    np.testing.assert_allclose(steps, np.tile(steps[0], (7, 1)), atol=1e-9)
    assert np.abs(steps[0, :2]).max() > 0.1
    np.testing.assert_allclose(steps[:, 2:], 0, atol=1e-9)
    assert tracks[-1].depth == pytest.approx(first.depth)
    assert first.depth == pytest.approx(scene.positions[SEEN, 2], rel=0.1)


def test_a_frame_that_hides_the_target_has_its_votes(scene: WalkScene):
    """Blocks change their states, section 4.4, before it is decided on the whole target, section 4.5: those
    behind a board are occluded blocks from the frame on in which they and too few pixels hide the target.
    """
    tracker = tracker_on(scene)
    frame = scene.frames[SEEN]
    x0, _, x1, _ = scene.boxes[SEEN].xyxy
    edge = round(0.6 * x0 + 0.4 * x1)
    depth = np.array(frame.depth)
    depth[:, :edge] = NEAR
    assert any(box.x < edge for box in tracker.blocks[0])
    track = tracker.update(Frame(np.zeros_like(frame.color), depth=depth))  # black: no flow, so no pixels
    assert track.status is O
    targets, occluded = tracker.blocks
    assert any(box.x < edge for box in occluded)
    assert not any(box.x < edge for box in targets)


def test_the_jump_back_shows_it_again(scene: WalkScene):
    """Once the disparity in the window is much smaller than in the frame before, the target is TRACKED again,
    in that frame.
    """
    tracker = tracker_on(scene)
    hidden = behind_a_board(tracker, scene, 3)
    assert {track.status for track in hidden} == {O}
    track = tracker.update(scene.frames[SEEN + 3])
    assert track.status is T
    assert track.box.iou(scene.boxes[SEEN + 3]) > 0.5
    assert track.depth == pytest.approx(scene.positions[SEEN + 3, 2], rel=0.1)


def test_a_slow_change_is_no_jump(scene: WalkScene):
    """A board that goes away slowly, by less than the margin a frame, brings nothing back."""
    tracker = tracker_on(scene)
    behind_a_board(tracker, scene, 2)
    frame = scene.frames[SEEN]
    depths = np.linspace(NEAR, 6.0, 120)
    boards = (np.full_like(frame.depth, depth) for depth in depths)
    statuses = {tracker.update(Frame(frame.color, depth=board)).status for board in boards}
    assert T not in statuses


def test_by_flow_alone_nothing_is_occluded(scene: WalkScene):
    """Without disparity there is no jump: a target that isn't seen is missed, and never OCCLUDED."""
    tracker = FlowDepthTracker(PAPER.__class__(cues=("flow",), complete_occlusion="disparity"))
    tracker.init(scene.frames[0], scene.boxes[0])
    black = np.zeros_like(scene.frames[0].color)
    statuses = [tracker.update(Frame(black)).status for _ in range(12)]
    assert O not in statuses
    assert statuses[-1] is Status.LOST
