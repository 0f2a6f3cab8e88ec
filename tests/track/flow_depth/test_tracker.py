# SPDX-License-Identifier: MIT
"""That the flow and depth tracker follows a walker through an overtaking, detects its occlusion, and gives
its position and its pixels.
"""

import functools
from collections.abc import Callable

import numpy as np
import pytest
from tricue import Box, FlowDepthTracker, Frame, Status, Track
from tricue.scenes import StressScene, WalkScene, stress_scene

CAMERAS = {"pair": {}, "depth camera": {"depth": True}}
LATE, BACK = 4, 8  # frames until an occlusion is detected, and until the target is TRACKED again

WalkRun = tuple[WalkScene, list[Track], list[np.ndarray]]


def run_of(scene: WalkScene | StressScene, frames: tuple[Frame, ...] | list[Frame], **parameters) -> WalkRun:
    """The tracks and masks of a scene's frames."""
    tracker = FlowDepthTracker(**{"rig": scene.rig, **parameters})
    tracks, masks = [tracker.init(frames[0], scene.boxes[0])], [tracker.mask]
    for frame in frames[1:]:
        tracks.append(tracker.update(frame))
        masks.append(tracker.mask)
    return scene, tracks, masks


@pytest.fixture(scope="session")
def ran(overtakings) -> Callable[..., WalkRun]:
    """An overtaking followed with a pair or a depth camera."""

    @functools.cache
    def run(camera: str, cues: tuple[str, ...] = ("flow", "disparity")) -> WalkRun:
        scene = overtakings(0, 55, **CAMERAS[camera])
        return run_of(scene, scene.frames, cues=cues)

    return run


def overlaps(tracks: list[Track], scene: WalkScene) -> np.ndarray:
    """IoU with the true box, frame by frame."""
    return np.array([track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=False)])


def seen(scene: WalkScene, least: float = 0.9) -> np.ndarray:
    """The frames after the first in which so much of the target is visible."""
    return np.flatnonzero(scene.visible >= least)[1:]


@pytest.mark.parametrize("camera", CAMERAS)
def test_follows_the_right_person_through(camera, ran):
    """The box stays on the target and not on who overtakes, before and after it was hidden: it overlaps the
    true one, and the other one less, in all frames in which it is TRACKED and half of it is visible.
    """
    scene, tracks, _ = ran(camera)
    found = overlaps(tracks, scene)
    chosen = [i for i in seen(scene, 0.5) if tracks[i].status is Status.TRACKED]
    assert max(chosen) > scene.events.back > min(chosen)
    assert found[chosen].min() > 0.35
    assert np.median(found[chosen]) > 0.5
    for i in chosen:
        assert tracks[i].box.iou(scene.others[i][0].box) < found[i]


@pytest.mark.parametrize("camera", CAMERAS)
def test_detects_the_occlusion(camera, ran):
    """The target is TRACKED until 60 % of it are visible at most, not TRACKED from a few frames after
    10 % until it comes back, and OCCLUDED for most of that.
    """
    scene, tracks, _ = ran(camera)
    hiding, hidden, back = scene.events.hiding, scene.events.hidden, scene.events.back
    assert {track.status for track in tracks[:hiding]} == {Status.TRACKED}
    gone = [track.status for track in tracks[hidden + LATE : back - LATE]]
    assert Status.TRACKED not in gone
    assert np.mean([status is Status.OCCLUDED for status in gone]) > 0.8


@pytest.mark.parametrize("camera", CAMERAS)
def test_redetects_the_target(camera, ran):
    """Within eight frames after a fifth of it is visible again the target is TRACKED, and stays so."""
    scene, tracks, _ = ran(camera)
    assert {track.status for track in tracks[scene.events.back + BACK :]} <= {Status.TRACKED}
    assert tracks[-1].status is Status.TRACKED
    assert len(tracks) >= scene.events.back + BACK


@pytest.mark.parametrize("camera", CAMERAS)
def test_positions_are_right(camera, ran):
    """While it is seen the median error of the position is at most 2 % of the distance, the largest 5 %."""
    scene, tracks, _ = ran(camera)
    errors = [
        np.linalg.norm(tracks[i].position - scene.positions[i]) / np.linalg.norm(scene.positions[i])
        for i in seen(scene)
    ]
    assert np.median(errors) <= 0.02
    assert max(errors) <= 0.05


@pytest.mark.parametrize(("camera", "right", "whole"), [("pair", 0.6, 0.25), ("depth camera", 0.8, 0.4)])
def test_the_mask_is_on_the_target(camera, right, whole, ran):
    """While it is seen most of the mask's pixels are the target's, and they are a good part of it; the first
    mask is empty, and each is of the picture's size, 0 or 255.
    """
    scene, _, masks = ran(camera)
    assert not masks[0].any()
    for mask in masks:
        assert (mask.shape, mask.dtype) == (scene.masks[0].shape, np.uint8)
        assert np.isin(mask, (0, 255)).all()
    frames = seen(scene)
    hits = np.array([np.count_nonzero((masks[i] > 0) & scene.masks[i]) for i in frames])
    assert np.median(hits / [max(np.count_nonzero(masks[i]), 1) for i in frames]) > right
    assert np.median(hits / [scene.masks[i].sum() for i in frames]) > whole


@pytest.mark.parametrize("first", [0, 1])
def test_pairs_and_depth_images_may_take_turns(first, rendered):
    """A target in changing light is followed to the end by stereo pairs and depth images in turn."""
    pairs, depth = (
        rendered(stress_scene, "light", 2, (160, 120), channels=channels) for channels in ("stereo", "rgbd")
    )
    frames = [(pairs, depth)[(i + first) % 2].frames[i] for i in range(len(pairs.frames))]
    _, tracks, _ = run_of(pairs, frames)
    assert {track.status for track in tracks} == {Status.TRACKED}
    assert min(track.box.iou(Box(*box)) for track, box in zip(tracks, pairs.boxes, strict=True)) > 0.5


def test_blocks_are_hidden_as_the_target_is(overtaken: WalkScene):
    """All blocks of the window are the target's at first; the more of it is hidden the more are occluded."""
    tracker = FlowDepthTracker(rig=overtaken.rig)
    first = tracker.init(overtaken.frames[0], overtaken.boxes[0])
    target, occluded = tracker.blocks
    assert sum(box.area for box in target) == pytest.approx(first.box.area)
    assert occluded == ()
    shares = []
    for frame in overtaken.frames[1 : overtaken.events.hidden + 2]:
        tracker.update(frame)
        target, occluded = tracker.blocks
        shares.append(len(occluded) / (len(occluded) + len(target)))
    assert max(shares[:6]) < 0.2
    assert max(shares) > 0.5


@pytest.mark.parametrize("cues", [("flow",), ("disparity",)])
def test_each_cue_alone_follows_at_first(cues, ran):
    """By flow alone, and by disparity alone, the target is followed until somebody hides it."""
    scene, tracks, _ = ran("pair", cues)
    before = slice(1, scene.events.hiding - 2)
    assert np.mean(overlaps(tracks, scene)[before] > 0.5) > 0.7
    assert {track.status for track in tracks[before]} == {Status.TRACKED}


def test_flow_alone_needs_color_alone(ran, overtaken: WalkScene):
    """By flow alone the right image changes nothing: frames without it give the same track, bit for bit."""
    bare = [Frame(frame.color, timestamp=frame.timestamp) for frame in overtaken.frames]
    assert run_of(overtaken, bare, cues=("flow",))[1] == ran("pair", ("flow",))[1]


def test_depth_alone_needs_no_color(ran):
    """By disparity alone the color beside a depth image changes nothing, bit for bit."""
    scene, tracks, _ = ran("depth camera", ("disparity",))
    bare = [Frame(depth=frame.depth, timestamp=frame.timestamp) for frame in scene.frames]
    assert run_of(scene, bare, cues=("disparity",))[1] == tracks


def test_gray_pictures_are_as_good(overtaken: WalkScene):
    """Gray pictures, of one of the channels, are followed as color ones are."""
    gray = [
        Frame(frame.color[..., 1].copy(), right=frame.right[..., 1].copy(), timestamp=frame.timestamp)
        for frame in overtaken.frames[: overtaken.events.hiding]
    ]
    scene, tracks, masks = run_of(overtaken, gray)
    assert {track.status for track in tracks} == {Status.TRACKED}
    assert np.median(overlaps(tracks, scene)) > 0.5
    assert masks[-1].shape == overtaken.masks[0].shape


def test_larger_pictures_are_followed(overtakings):
    """In 640x480, measured at half the width, the target is followed, its position right and its mask on
    it.
    """
    scene = overtakings(0, 12, "640x480")
    _, tracks, masks = run_of(scene, scene.frames)
    assert overlaps(tracks, scene).min() > 0.45
    assert masks[-1].shape == (480, 640)
    assert scene.masks[-1][masks[-1] > 0].mean() > 0.6
    errors = [
        np.linalg.norm(t.position - p) / np.linalg.norm(p)
        for t, p in zip(tracks, scene.positions, strict=True)
    ]
    assert max(errors) < 0.05


def test_boxes_may_have_fractions(overtaken: WalkScene):
    """The first track's box is the given one, fractions and all, and a box that is half a pixel off leads to
    nearly the same.
    """
    x, y, width, height = overtaken.boxes[0]
    tracks = []
    for box in (Box(x, y, width, height), Box(x + 0.43, y - 0.31, width + 0.1, height + 0.27)):
        tracker = FlowDepthTracker(rig=overtaken.rig)
        assert tracker.init(overtaken.frames[0], box).box == pytest.approx(box)
        tracks.append([tracker.update(frame) for frame in overtaken.frames[1:10]][-1])
    assert tracks[0].box.iou(tracks[1].box) > 0.85


def test_another_target_is_followed_too(overtaken: WalkScene):
    """Not only the target of the scene is followed: who overtakes is as well, from a box on them."""
    tracker = FlowDepthTracker(rig=overtaken.rig)
    boxes = [each[0].box.clip(160, 120) for each in overtaken.others]
    start = next(i for i, box in enumerate(boxes) if box.x > 0 and box.x + box.width < 159)
    tracker.init(overtaken.frames[start], boxes[start])
    for i in range(start + 1, start + 12):
        track = tracker.update(overtaken.frames[i])
    other = overtaken.others[start + 11][0]
    assert track.status is Status.TRACKED
    assert track.box.clip(160, 120).iou(boxes[start + 11]) > 0.5
    assert track.position[2] == pytest.approx(other.position[2], rel=0.05)
