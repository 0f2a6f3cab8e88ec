# SPDX-License-Identifier: MIT
from functools import lru_cache

import cv2
import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue.scenes.rooms.scene import ROOM_KINDS, room_scene
from tricue.scenes.sensor.depth_camera import DepthFaults
from tricue.scenes.sensor.holes import HoleShares
from tricue.scenes.sensor.stereo_faults import StereoFaults
from tricue.scenes.sensor.surfaces import SurfaceFaults

SIZE = 96, 80  # nothing here depends on it
CLEAN = DepthFaults(
    near=0.1,
    far=20.0,
    step=1e-6,
    noise=0.0,
    grain=0.6,
    baseline=1e-9,
    surfaces=SurfaceFaults(1, 0.0, 0.0, 0.0),
    holes=HoleShares(0.0, 0.0, 0.0, 0.0, 0.0, 0, 2.0),
    shift=(0.0, 0.0),
    margin=0.0,
    delay=0,
)
EQUAL = StereoFaults(1.0, 0.0)


@lru_cache(maxsize=8)
def scene(kind, seed=0, frames=None, faults=CLEAN):
    """A room's depth without noise."""
    return room_scene(kind, seed, SIZE, "depth", frames=frames, noise=0.0, depth_faults=faults)


@pytest.mark.parametrize("kind", ["table", "returning"])
def test_seed_decides_everything(kind):
    """One seed gives one scene bit for bit, another seed another one."""
    first, again, other = (room_scene(kind, seed, SIZE, "rgbd", frames=3) for seed in (1, 1, 2))
    assert np.array_equal(first.boxes, again.boxes, equal_nan=True)
    for a, b in zip(first.frames, again.frames, strict=True):
        assert np.array_equal(a.color, b.color)
        assert np.array_equal(a.depth, b.depth, equal_nan=True)
    assert not np.array_equal(first.frames[0].color, other.frames[0].color)
    assert first.depth_faults != other.depth_faults


@pytest.mark.parametrize(("kind", "frames"), [("returning", None), ("walker", 4)])
def test_boxes_fit_the_pixels(kind, frames):
    """While the target is seen whole, its box is that of its pixels to within one."""
    made = scene(kind, 0, frames)
    whole = np.flatnonzero(made.visible == 1)
    assert len(whole) > 2
    for index in whole[:: max(len(whole) // 5, 1)]:
        rows, columns = np.nonzero(made.masks[index])
        found = np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1])
        x, y, width, height = made.boxes[index]
        assert np.abs(found - [x, y, x + width, y + height]).max() < 1.2


def test_positions_are_on_the_measured_surface():
    """The mean of the depth at the target's pixels is its position's, while it is seen whole; some of what is
    seen aslant has no depth.
    """
    made = scene("returning", 0, 3)
    for index in np.flatnonzero(made.visible == 1):
        seen = made.frames[index].depth[made.masks[index]]
        assert np.isfinite(seen).mean() > 0.8
        assert np.nanmean(seen) == pytest.approx(made.positions[index, 2], abs=5e-3)


def test_what_the_target_stands_on_is_as_far_away():
    """Just below a target on a table there is the table, at the depth of the target's foot."""
    made = scene("returning", 3, 1)
    index = 0
    rows, columns = np.nonzero(made.masks[index])
    foot = rows.max()
    column = int(np.median(columns[rows == foot]))
    below, above = made.frames[index].depth[foot + 2, column], made.frames[index].depth[foot - 1, column]
    assert below == pytest.approx(above, rel=0.06)
    assert made.masks[index][foot - 1, column]


def test_the_target_leaves_and_comes_back_elsewhere():
    """Nothing of it is seen for half a second or more; then it stands at another place."""
    for seed in (0, 1):
        made = scene("returning", seed)
        gone = np.flatnonzero(made.visible == 0)
        assert len(gone) > 0.5 * made.rate
        assert (np.diff(gone) == 1).all()
        assert np.isnan(made.boxes[gone[len(gone) // 2]]).all()
        first, last = (made.boxes[index, :2] + made.boxes[index, 2:] / 2 for index in (0, -1))
        assert np.hypot(*(first - last)) > 0.3 * made.boxes[0, 2]
        assert made.visible[-1] > 0.5
        assert gone[0] in made.spans["leaving"]


def test_a_thing_as_far_away_passes_before():
    """It covers a part of the target, and is nearer by less than the target is far."""
    made = scene("passing", 1)
    least = int(np.argmin(made.visible))
    assert made.visible[least] < 0.95
    assert made.visible[0] > 0.99
    x, y, width, height = made.boxes[least].astype(int)
    box = np.s_[max(y, 0) : y + height, max(x, 0) : x + width]
    covered = made.masks[0][box] & ~made.masks[least][box]
    now, before = (made.frames[index].depth[box][covered] for index in (least, 0))
    assert (now < before).mean() > 0.95
    assert np.median(before - now) < 0.3


def test_a_hand_is_on_what_it_holds():
    """A part of the target is hidden in every frame, though it moves."""
    made = scene("held", 1, 12)
    assert made.visible.max() < 1
    assert made.visible.mean() > 0.6
    assert np.ptp(made.positions, axis=0).max() > 0.02


def test_walkers_come_at_few_frames_per_second():
    """Four or fifteen; at four a person moves by tenths of a meter per frame."""
    made, faster = scene("walker", 0, 4), scene("walker", 1, 1)
    assert (made.rate, faster.rate) == (4, 15)
    steps = np.linalg.norm(np.diff(made.positions, axis=0), axis=1)
    assert 0.07 < np.nanmedian(steps) < 0.5
    assert [frame.timestamp for frame in made.frames[:3]] == [0, 0.25, 0.5]


def test_late_depth_shows_the_frame_before():
    """With a delay of one frame, depth is that of the last frame; with -1, of the next."""
    on_time, late, early = (
        np.stack([frame.depth for frame in scene("held", 0, 5, CLEAN._replace(delay=delay)).frames])
        for delay in (0, 1, -1)
    )
    assert np.nanmax(np.abs(late[1:] - on_time[:-1])) == 0
    assert np.nanmax(np.abs(early[:-1] - on_time[1:])) == 0
    assert np.nanmax(np.abs(on_time[1:] - on_time[:-1])) > 0.01


def test_channels_share_color_and_truth():
    """Whatever is asked for, the color images, the depths and the truth of a seed are the same."""
    color, rgbd, stereo, depth = (
        room_scene("table", 1, SIZE, channels, frames=2) for channels in ("color", "rgbd", "stereo", "depth")
    )
    for made, channels in ((rgbd, ("color", "depth")), (stereo, ("color", "right")), (depth, ("depth",))):
        assert {frame.channels for frame in made.frames} == {channels}
        assert np.array_equal(made.boxes, color.boxes, equal_nan=True)
    for a, b, c in zip(color.frames, rgbd.frames, stereo.frames, strict=True):
        assert np.array_equal(a.color, b.color)
        assert np.array_equal(a.color, c.color)
    pairs = zip(rgbd.frames, depth.frames, strict=True)
    assert all(np.array_equal(a.depth, b.depth, equal_nan=True) for a, b in pairs)
    assert (color.rig, rgbd.rig) == (None, None)


def test_disparity_is_focal_length_times_baseline_over_distance():
    """A patch of the target is found in the right image at f b / z, in the same rows."""
    made = room_scene("table", 0, (160, 120), "stereo", frames=1, noise=0.0, stereo_faults=EQUAL)
    width, height = made.boxes[0, 2:]
    u, v = made.intrinsics.project(made.positions[0]).round().astype(int)
    half = int(min(width, height) / 4)
    true = made.rig.intrinsics.fx * made.rig.baseline / made.positions[0, 2]
    left, right = made.frames[0].color, made.frames[0].right
    strip = right[v - half - 2 : v + half + 3]
    scores = cv2.matchTemplate(
        strip, left[v - half : v + half + 1, u - half : u + half + 1], cv2.TM_CCOEFF_NORMED
    )
    row, column = np.unravel_index(scores.argmax(), scores.shape)
    assert scores.max() > 0.9
    assert u - half - column == pytest.approx(true, abs=1.5 + 0.1 * true)  # the target isn't flat
    assert abs(row - 2) <= 1


@pytest.mark.parametrize("kind", ROOM_KINDS)
def test_the_target_begins_in_sight(kind):
    """In the first frame of every kind nine tenths of the target are seen, or as much as a hand leaves."""
    made = scene(kind, 2, 1)
    assert made.visible[0] > 0.5
    assert (made.boxes[0, 2:] > 4).all()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"kind": "rain"}, "kind: expected one of table, leaning, .* got 'rain'"),
        ({"channels": "rgb"}, "channels: expected one of color, rgbd, stereo, depth, got 'rgb'"),
        ({"seed": -1}, "seed: expected a whole number from 0, got -1"),
        ({"size": (320, 40)}, "size: expected width and height of 80 pixels or more"),
        ({"noise": -1.0}, "noise: expected levels of 255, 0 or more, got -1.0"),
    ],
)
def test_bad_arguments_are_named(arguments, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(ValueError, match=words):
        room_scene(**arguments)
