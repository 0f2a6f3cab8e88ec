# SPDX-License-Identifier: MIT
"""That the fused tracker goes on following when a frame's channels are others than the last one's."""

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import permutations

import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue import Box, Frame, FusedTracker, Status, Track
from tricue.scenes.everything import Scene, everything

CHANNELS = {
    "color": ("color",),
    "rgbd": ("color", "depth"),
    "pair": ("color", "right"),
    "depth": ("depth",),
}
WHITE = pytest.mark.xfail(
    strict=True,
    reason="after color alone a picture of depth is white: it is drawn round 0 m, as no depth was measured",
)
PAIRS = [
    pytest.param(*pair, id=" then ".join(pair), marks=WHITE if pair == ("color", "depth") else ())
    for pair in permutations(CHANNELS, 2)
]
KINDS = ("plain", "camera")
CHANGE, END = 20, 50  # frames
BOUND = 0.2  # metres, a tenth of the target's distance

Shoot = Callable[[str, Sequence[str]], list[Frame]]


@cache
def scene(kind: str, channels: str) -> Scene:
    """A scene with seed 0: what is drawn for one set of channels agrees with what is drawn for another."""
    return everything(kind, 0, channels=channels)


@pytest.fixture(scope="module")
def shoot() -> Shoot:
    """Frames of a kind of scene, from the first on, each with the channels of that name."""

    def frames(kind: str, names: Sequence[str]) -> list[Frame]:
        pairs, depths = scene(kind, "stereo").frames, scene(kind, "rgbd").frames
        made = []
        for name, pair, depth in zip(names, pairs, depths, strict=False):
            images = {"color": pair.color, "right": pair.right, "depth": depth.depth}
            made.append(Frame(**{each: images[each] for each in CHANNELS[name]}, timestamp=pair.timestamp))
        return made

    return frames


def follow(kind: str, frames: Iterable[Frame]) -> list[Track]:
    """The tracks of a tracker that knows the rig."""
    first, *others = frames
    made = scene(kind, "stereo")
    tracker = FusedTracker(rig=made.rig)
    return [tracker.init(first, made.boxes[0]), *map(tracker.update, others)]


def assert_follows(kind: str, tracks: Sequence[Track]) -> None:
    """It is TRACKED in the last frame, where the target is."""
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(*scene(kind, "stereo").boxes[len(tracks) - 1])) > 0.5


def errors(kind: str, tracks: Sequence[Track]) -> np.ndarray:
    """Metres from the truth, NaN without a position."""
    true = scene(kind, "stereo").positions
    return np.array(
        [np.nan if t.position is None else np.linalg.norm(t.position - true[i]) for i, t in enumerate(tracks)]
    )


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("before", "after"), PAIRS)
def test_it_follows_over_a_change(before, after, kind, shoot: Shoot):
    """With 20 frames of one set of channels and 30 of another the box is still on the target."""
    tracks = follow(kind, shoot(kind, CHANGE * [before] + (END - CHANGE) * [after]))
    assert_follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("before", "after"), PAIRS)
def test_positions_come_with_depth_and_stay(before, after, kind, shoot: Shoot):
    """There is no position before depth was measured, one in every frame from then on, and covariances with
    them; in the last frame with depth it is right to a tenth of the distance.
    """
    tracks = follow(kind, shoot(kind, CHANGE * [before] + (END - CHANGE) * [after]))
    there = np.array([track.position is not None for track in tracks])
    assert there.tolist() == [track.covariance is not None for track in tracks]
    first = CHANGE if before == "color" else 0
    assert not there[:first].any()
    assert there[first:].all()
    last = CHANGE - 1 if after == "color" else END - 1
    assert errors(kind, tracks)[last] < BOUND


@pytest.mark.parametrize("kind", KINDS)
def test_channels_change_in_every_frame(kind, shoot: Shoot):
    """Color, color with depth, a pair and depth by turns, a frame each, are followed for 80 frames."""
    tracks = follow(kind, shoot(kind, 20 * ["color", "rgbd", "pair", "depth"]))
    assert_follows(kind, tracks)
    assert errors(kind, tracks)[-1] < BOUND


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("depth", ["rgbd", "pair"])
def test_depth_that_comes_late(depth, kind, shoot: Shoot):
    """Depth from the fortieth frame on gives a position in that frame, and a right one to the end; until then
    the tracks are those of a tracker that never gets depth.
    """
    tracks = follow(kind, shoot(kind, 40 * ["color"] + 20 * [depth]))
    assert tracks[:40] == follow(kind, shoot(kind, 40 * ["color"]))
    assert np.isnan(errors(kind, tracks)[:40]).all()
    assert (errors(kind, tracks)[40:] < BOUND).all()
    assert_follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("without", ["color", "blank"])
@pytest.mark.parametrize("depth", ["rgbd", "pair"])
def test_depth_that_is_lost_for_a_while(depth, without, kind, shoot: Shoot):
    """In 20 frames without depth, or with a channel that measures nothing, it follows by color and gets less
    sure of the position from frame to frame; five frames after depth is back the position is right, and as
    sure as before to a half.
    """
    frames = shoot(kind, 20 * [depth] + 20 * ["color"] + 20 * [depth])
    if without == "blank":
        empty = np.full(frames[0].color.shape[:2], np.nan, np.float32)
        frames[20:40] = [Frame(f.color, depth=empty, timestamp=f.timestamp) for f in frames[20:40]]
    tracks = follow(kind, frames)
    spread = np.array([np.trace(track.covariance) for track in tracks])
    assert (np.diff(spread[19:40]) > 0).all()
    assert spread[45] < 1.5 * spread[19]
    assert (errors(kind, tracks)[45:] < BOUND).all()
    assert tracks[39].status is Status.TRACKED
    assert_follows(kind, tracks)


@pytest.mark.parametrize("kind", KINDS)
def test_color_that_is_lost_for_a_while(kind, shoot: Shoot):
    """In 20 frames of depth alone it follows by that, with a position, and goes on with color after it."""
    tracks = follow(kind, shoot(kind, 20 * ["rgbd"] + 20 * ["depth"] + 20 * ["rgbd"]))
    assert tracks[39].status is Status.TRACKED
    assert (errors(kind, tracks)[20:] < BOUND).all()
    assert_follows(kind, tracks)


def test_what_is_not_asked_is_not_seen(shoot: Shoot):
    """Without the cue depth it gives the tracks of color alone, bit for bit, whatever else frames have."""
    made = scene("plain", "stereo")
    runs = []
    for name in ("color", "rgbd", "pair"):
        first, *others = shoot("plain", 25 * [name])
        tracker = FusedTracker(rig=made.rig, cues=("filter", "color", "ranks", "edges", "flow"))
        runs.append([tracker.init(first, made.boxes[0]), *map(tracker.update, others)])
    assert runs[0] == runs[1] == runs[2]
    assert all(track.position is None for track in runs[0])


def test_depth_comes_before_a_pair(shoot: Shoot):
    """A frame with color, depth and right is measured by its depth."""
    full = [
        Frame(pair.color, depth.depth, pair.right, timestamp=pair.timestamp)
        for pair, depth in zip(shoot("plain", 20 * ["pair"]), shoot("plain", 20 * ["rgbd"]), strict=True)
    ]
    assert follow("plain", full) == follow("plain", shoot("plain", 20 * ["rgbd"]))
