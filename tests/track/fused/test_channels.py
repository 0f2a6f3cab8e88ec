# SPDX-License-Identifier: MIT
"""That the fused tracker goes on following when a frame's channels are others than the last one's."""

from collections.abc import Callable, Sequence
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, FusedTracker, Status, Track

PAIRS = [
    pytest.param(*pair, id=" then ".join(pair))
    for pair in permutations(("color", "rgbd", "pair", "depth"), 2)
]
KINDS = ("plain", "camera")
CHANGE, END = 20, 50  # frames
BOUND = 0.2  # meters, a tenth of the target's distance


@pytest.fixture(scope="module")
def run(drawn, shoot) -> Callable[..., list[Track]]:
    """The tracks of a kind of scene, each frame with the channels of that name, or of given frames of it, by
    a tracker that knows the rig.
    """

    def follow(
        kind: str, names: Sequence[str] = (), frames: Sequence[Frame] = (), **values: Any
    ) -> list[Track]:
        made = drawn(kind)
        tracker = FusedTracker(rig=made.rig, **values)
        first, *others = frames or shoot(kind, names)
        return [tracker.init(first, made.boxes[0]), *map(tracker.update, others)]

    return follow


@pytest.fixture(scope="module")
def errors(drawn) -> Callable[[str, Sequence[Track]], NDArray[np.float64]]:
    """Errors in meters (N,), NaN without a position."""

    def off(kind: str, tracks: Sequence[Track]) -> NDArray[np.float64]:
        true = zip(tracks, drawn(kind).positions, strict=False)
        return np.array([np.nan if t.position is None else np.linalg.norm(t.position - p) for t, p in true])

    return off


@pytest.fixture(scope="module")
def follows(drawn) -> Callable[[str, Sequence[Track]], bool]:
    """Whether it is TRACKED in the last frame, where the target is."""

    def on_target(kind: str, tracks: Sequence[Track]) -> bool:
        true = Box(*drawn(kind).boxes[len(tracks) - 1])
        return tracks[-1].status is Status.TRACKED and tracks[-1].box.iou(true) > 0.5

    return on_target


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("before", "after"), PAIRS)
def test_it_follows_over_a_change(before, after, kind, run, follows):
    """With 20 frames of one set of channels and 30 of another the box is still on the target."""
    tracks = run(kind, CHANGE * [before] + (END - CHANGE) * [after])
    assert follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("before", "after"), PAIRS)
def test_positions_come_with_depth_and_stay(before, after, kind, run, errors):
    """There is no position before depth was measured, one in every frame from then on, and covariances with
    them; in the last frame with depth it is right to a tenth of the distance.
    """
    tracks = run(kind, CHANGE * [before] + (END - CHANGE) * [after])
    there = np.array([track.position is not None for track in tracks])
    assert there.tolist() == [track.covariance is not None for track in tracks]
    first = CHANGE if before == "color" else 0
    assert not there[:first].any()
    assert there[first:].all()
    last = CHANGE - 1 if after == "color" else END - 1
    assert errors(kind, tracks)[last] < BOUND


@pytest.mark.parametrize("kind", KINDS)
def test_channels_change_in_every_frame(kind, run, follows, errors):
    """It follows for 80 frames whose channels are, in turn, color, color and depth, a stereo pair, depth."""
    tracks = run(kind, 20 * ["color", "rgbd", "pair", "depth"])
    assert follows(kind, tracks)
    assert errors(kind, tracks)[-1] < BOUND


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("depth", ["rgbd", "pair"])
def test_depth_that_comes_late(depth, kind, run, follows, errors):
    """Depth from the fortieth frame on gives a position in that frame, and a right one to the end; until then
    the tracks are those of a tracker that never gets depth.
    """
    tracks = run(kind, 40 * ["color"] + 20 * [depth])
    assert tracks[:40] == run(kind, 40 * ["color"])
    assert np.isnan(errors(kind, tracks)[:40]).all()
    assert (errors(kind, tracks)[40:] < BOUND).all()
    assert follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
def test_a_target_without_depth_is_where_the_picture_shows_it(kind, drawn, run):
    """In a second of color alone the direction of the position is that of the target, to a degree."""
    positions = np.array([track.position for track in run(kind, 20 * ["rgbd"] + 30 * ["color"])])
    true = drawn(kind).positions[:50]
    found, wanted = (each[20:, :2] / each[20:, 2:] for each in (positions, true))
    assert np.abs(found - wanted).max() < np.radians(1)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("without", ["color", "blank"])
@pytest.mark.parametrize("depth", ["rgbd", "pair"])
def test_depth_that_is_lost_for_a_while(depth, without, kind, shoot, run, follows, errors):
    """In 20 frames without depth, or with a channel that measures nothing, it follows by color and the
    covariance of the position grows from frame to frame. Five frames after depth is back the position is
    right, and its covariance that from before to a half.
    """
    frames = shoot(kind, 20 * [depth] + 20 * ["color"] + 20 * [depth])
    if without == "blank":
        empty = np.full(frames[0].color.shape[:2], np.nan, np.float32)
        frames[20:40] = [Frame(f.color, depth=empty, timestamp=f.timestamp) for f in frames[20:40]]
    tracks = run(kind, frames=frames)
    spread = np.array([np.trace(track.covariance) for track in tracks])
    assert (np.diff(spread[19:40]) > 0).all()
    assert spread[45] < 1.5 * spread[19]
    assert (errors(kind, tracks)[45:] < BOUND).all()
    assert tracks[39].status is Status.TRACKED
    assert follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
def test_color_that_is_lost_for_a_while(kind, run, follows, errors):
    """In 20 frames of depth alone it follows by that, with a position, and goes on with color after it."""
    tracks = run(kind, 20 * ["rgbd"] + 20 * ["depth"] + 20 * ["rgbd"])
    assert tracks[39].status is Status.TRACKED
    assert (errors(kind, tracks)[20:] < BOUND).all()
    assert follows(kind, tracks)


def test_without_the_cue_depth_is_not_read(run):
    """Without the cue depth it gives the tracks of color alone, bit for bit, whatever else frames have."""
    cues = ("filter", "color", "size")
    color, *others = (run("plain", 25 * [name], cues=cues) for name in ("color", "rgbd", "pair", "all"))
    assert all(tracks == color for tracks in others)
    assert all(track.position is None for track in color)


def test_depth_comes_before_a_stereo_pair(run):
    """A frame with color, depth and right is measured by its depth."""
    assert run("plain", 20 * ["all"]) == run("plain", 20 * ["rgbd"]) != run("plain", 20 * ["pair"])


def test_without_the_cue_depth_may_have_another_size(shoot, run):
    """Depth that isn't read needn't be registered to color."""
    frames = shoot("plain", 5 * ["rgbd"])
    coarse = [Frame(f.color, depth=f.depth[::2, ::2], timestamp=f.timestamp) for f in frames]
    cues = ("filter", "color", "size")
    assert run("plain", frames=coarse, cues=cues) == run("plain", 5 * ["color"], cues=cues)
