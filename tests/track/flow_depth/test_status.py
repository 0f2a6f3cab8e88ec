# SPDX-License-Identifier: MIT
"""That the status is TRACKED, OCCLUDED behind something nearer, and LOST in the end."""

import dataclasses

import numpy as np
import pytest
from tricue import FlowDepthTracker, Frame, Status, Track
from tricue.scenes import WalkScene

T, O, L = Status.TRACKED, Status.OCCLUDED, Status.LOST  # noqa: E741
SEEN = 14  # frames in which the target is seen


def without_anything(scene: WalkScene, step: float, **parameters) -> list[Track]:
    """The tracks of 40 black frames after the first ones, every so many seconds."""
    tracker = FlowDepthTracker(rig=scene.rig, **parameters)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:SEEN]:
        tracker.update(frame)
    black = np.zeros_like(frame.color)
    seconds = (frame.timestamp + step * (i + 1) for i in range(40))
    return [tracker.update(Frame(black, right=black, timestamp=each)) for each in seconds]


@pytest.mark.parametrize(("unoccluded_lost_after", "step"), [(0.4, 1 / 15), (0.4, 1 / 30), (1.0, 1 / 15)])
def test_what_nothing_hides_is_lost_soon(unoccluded_lost_after, step, overtaken: WalkScene):
    """A target that isn't seen, though nothing hides it, coasts as TRACKED at score 0 for
    ``unoccluded_lost_after`` seconds by the timestamps, and is LOST then.
    """
    tracks = without_anything(overtaken, step, unoccluded_lost_after=unoccluded_lost_after)
    lost = next(i for i, track in enumerate(tracks) if track.status is L)
    assert (lost + 1) * step == pytest.approx(unoccluded_lost_after, abs=1.01 * step)
    assert [track.status for track in tracks] == lost * [T] + (40 - lost) * [L]
    assert {track.score for track in tracks} == {0}


@pytest.mark.parametrize("lost_after", [1.0, 3.0])
def test_what_something_hides_is_lost_late(lost_after, overtakings):
    """A target behind something nearer, that fills the picture, is OCCLUDED at once, for ``lost_after``
    seconds, and LOST then.
    """
    scene = overtakings(0, 55, depth=True)
    tracker = FlowDepthTracker(rig=scene.rig, lost_after=lost_after)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:SEEN]:
        tracker.update(frame)
    near = np.full_like(frame.depth, 2.0)
    seconds = (frame.timestamp + (i + 1) / 15 for i in range(60))
    tracks = [tracker.update(Frame(frame.color, depth=near, timestamp=each)) for each in seconds]
    statuses = [track.status for track in tracks]
    lost = statuses.index(L)
    assert (lost + 1) / 15 == pytest.approx(lost_after, abs=1.01 / 15)
    assert statuses == lost * [O] + (60 - lost) * [L]
    assert {track.score for track in tracks} == {0}


def blind(frame: Frame, seconds: float) -> Frame:
    """A black frame of the same channels, so many seconds later, in which nothing is at any depth."""
    beside = {"right": frame.right * 0} if frame.depth is None else {"depth": frame.depth * np.nan}
    return Frame(frame.color * 0, timestamp=frame.timestamp + seconds, **beside)


@pytest.mark.parametrize("params", [FlowDepthTracker.Params(), FlowDepthTracker.Params.paper()], ids=str)
@pytest.mark.parametrize("lost_after", [3.0, 1e9])
@pytest.mark.parametrize("depth", [False, True], ids=["pair", "depth camera"])
def test_a_missed_target_stays_in_view(depth, lost_after, params, overtakings):
    """Over 200 black frames the box's center is in the image, and the position in the camera's view, also
    where the target never becomes LOST; after ``lost_after`` it rests where it was last found.
    """
    scene = overtakings(0, 55, depth=depth)
    params = dataclasses.replace(params, lost_after=lost_after, unoccluded_lost_after=min(lost_after, 1e8))
    tracker = FlowDepthTracker(params, rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:SEEN]:
        tracker.update(frame)
    last = tracker.update(blind(frame, 1 / 15)).box
    tracks = [tracker.update(blind(frame, (i + 2) / 15)) for i in range(199)]
    height, width = frame.color.shape[:2]
    for track in tracks:
        x, y = track.box.center
        assert -1e-9 <= x <= width + 1e-9
        assert -1e-9 <= y <= height + 1e-9
        np.testing.assert_allclose(
            scene.rig.intrinsics.project(track.position) + 0.5, (x, y), rtol=0, atol=1e-9
        )
    rests = [track.box == pytest.approx(last, abs=1e-6) for track in tracks[round(15 * 3.0) + 1 :]]
    assert all(rests) if lost_after < 100 else not any(rests)


@pytest.mark.parametrize("gap", [60, 200])
@pytest.mark.parametrize("depth", [False, True], ids=["pair", "depth camera"])
def test_a_lost_target_is_taken_up_where_it_was(depth, gap, overtakings):
    """A target that walks on where it was last found is TRACKED again within six frames, however long it was
    away.
    """
    scene = overtakings(2, 55, depth=depth)
    tracker = FlowDepthTracker(rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:9]:
        tracker.update(frame)
    tracks = [tracker.update(blind(frame, (i + 1) / 15)) for i in range(gap)]
    assert tracks[-1].status is L
    for i, again in enumerate(scene.frames[9:15]):
        beside = {"right": again.right, "depth": again.depth}
        seconds = frame.timestamp + (gap + 1 + i) / 15
        track = tracker.update(Frame(again.color, timestamp=seconds, **beside))
    assert track.status is T
    assert track.score > 0
    assert track.box.iou(scene.boxes[14]) > 0.5


def test_without_timestamps_the_rate_counts(overtaken: WalkScene):
    """Without timestamps a frame takes 1 / rate seconds."""
    for rate in (5.0, 15.0):
        tracker = FlowDepthTracker(rig=overtaken.rig, rate=rate)
        bare = [Frame(frame.color, right=frame.right) for frame in overtaken.frames[:SEEN]]
        tracker.init(bare[0], overtaken.boxes[0])
        for frame in bare[1:]:
            tracker.update(frame)
        black = np.zeros_like(bare[0].color)
        statuses = [tracker.update(Frame(black, right=black)).status for _ in range(12)]
        assert (statuses.index(L) + 1) / rate == pytest.approx(0.4, abs=1.01 / rate)


def test_scores_follow_visibility(walk_on):
    """The score is in [0, 1], above 0.5 while all of the target is seen, and 0 while it isn't TRACKED."""
    tracks = walk_on()
    assert all(0 <= track.score <= 1 for track in tracks)
    assert all(track.score == 0 for track in tracks if track.status is not T)
    assert np.median([track.score for track in tracks[5:SEEN]]) > 0.5
