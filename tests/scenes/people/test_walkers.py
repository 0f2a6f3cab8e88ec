# SPDX-License-Identifier: MIT
import subprocess
import sys

import numpy as np
import pytest
from tricue import scenes
from tricue.scenes.people import walkers as people

RATE = {"tof": 15, "rgbd": 30}
SHORT = {"tof": 30, "rgbd": 60}  # two seconds


@pytest.fixture(scope="module")
def crossings():
    """Two seconds of 12 crossings before the time-of-flight camera."""
    return [scenes.crossing(seed, frames=30) for seed in range(12)]


@pytest.fixture(scope="module")
def walkers(rendered):
    """Six seconds of 6 walkers before the time-of-flight camera, one second of 1 before the RGB-D one."""
    return [rendered(scenes.walker, seed) for seed in range(6)] + [scenes.walker(0, 30, "rgbd")]


def assert_same_bits(first, second):
    """Frames and truth are equal, bit for bit."""
    assert first.boxes == second.boxes
    assert first.visible_boxes == second.visible_boxes
    for name in ("positions", "visible"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    for one, other in zip(first.frames, second.frames, strict=True):
        np.testing.assert_array_equal(one.depth, other.depth)
        assert one.timestamp == other.timestamp


@pytest.mark.parametrize("make", [scenes.walker, scenes.crossing])
@pytest.mark.parametrize("camera", ["tof", "rgbd"])
def test_seed_decides_everything(make, camera):
    """One seed gives one scene bit for bit; another seed gives another path and other pixels."""
    first, again, other = (make(seed, frames=4, camera=camera) for seed in (3, 3, 4))
    assert_same_bits(first, again)
    assert first.boxes != other.boxes
    assert not np.array_equal(first.frames[0].depth, other.frames[0].depth, equal_nan=True)


@pytest.mark.parametrize("make", [scenes.walker, scenes.crossing])
@pytest.mark.parametrize(("camera", "shape"), [("tof", (144, 176)), ("rgbd", (480, 640))])
def test_scene_is_whole(make, camera, shape):
    """Depth of the camera's size alone, its rate's timestamps, and a truth for each frame."""
    scene = make(1, frames=5, camera=camera)
    assert scene.name == f"{make.__name__}, {camera}, seed 1"
    assert [frame.channels for frame in scene.frames] == [("depth",)] * 5
    assert {frame.depth.shape for frame in scene.frames} == {shape}
    assert [frame.timestamp for frame in scene.frames] == pytest.approx(np.arange(5) / RATE[camera])
    assert (scene.intrinsics.height, scene.intrinsics.width) == shape
    assert len(scene.boxes) == len(scene.visible_boxes) == len(scene.others) == 5
    assert scene.positions.shape == (5, 3)
    assert scene.visible.shape == (5,)


def test_walker_is_seen_whole_in_range_and_in_the_image(walkers):
    """Nothing hides a walker, who is within the range and for two thirds or more inside the image."""
    for scene in walkers:
        np.testing.assert_array_equal(scene.visible, 1)
        assert scene.positions[:, 2].min() > 1.8
        assert scene.positions[:, 2].max() < 6.5
        camera = scene.intrinsics
        inside = [box.clip(camera.width, camera.height).area / box.area for box in scene.boxes]
        assert min(inside) > 0.6
        assert np.median(inside) > 0.95


def test_walker_changes_scale_and_pose(walkers):
    """In six seconds each walker comes nearer, and the box changes its shape as arms and knees bend."""
    for scene in walkers[:6]:
        assert np.ptp(scene.positions[:, 2]) > 1.2
        ratio = np.array([box.height / box.width for box in scene.boxes])
        assert ratio.max() > 1.5 * ratio.min()


def test_nobody_runs(walkers, crossings):
    """Over half a second nobody's position moves, over the floor, faster than 1.6 m/s and a gesture's bit."""
    for scene in [*walkers, *crossings]:
        half_second = round(0.5 / scene.frames[1].timestamp)
        everybody = [scene.positions]
        everybody += [
            np.array([other.position for other in same]) for same in zip(*scene.others, strict=True)
        ]
        for positions in everybody:
            way = positions[half_second:, [0, 2]] - positions[:-half_second, [0, 2]]
            assert np.hypot(*way.T).max() < 0.8 + 0.25


def test_positions_project_into_the_boxes(walkers, crossings):
    """The true position of the target and of everybody else lies, projected, in the true box."""
    for scene in [*walkers, *crossings]:
        truths = list(zip(scene.boxes, scene.positions, strict=True))
        truths += [other for others in scene.others for other in others]
        for box, position in truths:
            u, v = scene.intrinsics.project(position)
            assert box.contains(u + 0.5, v + 0.5)


def test_exact_depths_at_the_target_are_the_truths():
    """Without noise and gaps, the true box is filled with depths about the true one: the body's surface."""
    for seed in range(3):
        scene = scenes.walker(seed, frames=5, missing=0, noise=0)
        for frame, box, position in zip(scene.frames, scene.visible_boxes, scene.positions, strict=True):
            x, y, width, height = box.as_int()
            part = frame.depth[y : y + height, x : x + width]
            body = part[np.abs(part - position[2]) < 0.6]
            assert len(body) > 0.2 * part.size
            assert np.median(body) == pytest.approx(position[2], abs=0.15)


def test_only_the_visible_box_differs_from_the_empty_room():
    """Without noise and gaps, the pixels nearer than they ever were fill the visible box to its sides."""
    scene = scenes.walker(1, missing=0, noise=0)
    depths = np.stack([np.nan_to_num(frame.depth, nan=99) for frame in scene.frames])
    empty = depths.max(axis=0)  # the walker leaves every place
    for index in (0, 45, 89):
        rows, columns = np.nonzero(depths[index] < empty)
        left, top, right, bottom = scene.visible_boxes[index].xyxy
        assert (columns.min(), columns.max() + 1) == (left, right)
        assert (rows.min(), rows.max() + 1) == (top, bottom)


def test_target_is_hidden_and_comes_free(crossings):
    """In each of 12 seeds the target is seen at first, hidden for four frames or more, and then free."""
    for scene in crossings:
        hidden = np.flatnonzero(scene.visible < 0.15)
        assert len(hidden) >= 4
        assert scene.visible[: hidden[0]].max() > 0.9
        assert scene.visible[hidden[-1] :].max() > 0.9
        assert 10 <= hidden.mean() <= 19  # half way


def test_who_hides_is_nearer_and_who_passes_behind_is_farther(crossings):
    """Somebody is nearer by half a meter or more while the target is hidden; the third person never is."""
    thirds = 0
    for scene in crossings:
        target = scene.positions[:, 2]
        hidden = scene.visible < 0.15
        nearer = np.array([others[0].position[2] for others in scene.others])
        assert (target - nearer)[hidden].min() > 0.5
        for others, z in zip(scene.others, target, strict=True):
            assert all(other.position[2] > z for other in others[1:])
        thirds += len(scene.others[0]) - 1
    assert 2 <= thirds <= 10


def test_visible_box_is_the_part_that_is_seen(crossings):
    """The visible box lies in the whole body's, fills it where all is seen, is None where nothing is."""
    for scene in crossings:
        for box, seen, share in zip(scene.boxes, scene.visible_boxes, scene.visible, strict=True):
            assert (seen is None) == (share == 0)
            if seen is None:
                continue
            left, top, right, bottom = box.xyxy
            assert left - 0.5 <= seen.x
            assert top - 0.5 <= seen.y
            assert seen.x + seen.width <= right + 0.5
            assert seen.y + seen.height <= bottom + 0.5
            if share == 1 and box.clip(176, 144) == box:
                assert seen.iou(box) > 0.9


@pytest.mark.parametrize("camera", ["tof", "rgbd"])
@pytest.mark.parametrize("change", [0.8, -0.8])
def test_depth_changes_while_hidden(camera, change):
    """The target comes out of hiding as much farther or nearer as asked, and moved while it was hidden."""
    for seed in range(4 if camera == "tof" else 1):
        scene = scenes.crossing(seed, SHORT[camera], camera, depth_change=change)
        z = scene.positions[:, 2]
        assert z[-1] - z[0] == pytest.approx(change, abs=0.4)  # 0.15 m/s beside it, and the body's turn
        hidden = np.flatnonzero(scene.visible < 0.3)
        moved = (z[hidden[-1]] - z[hidden[0]]) / change
        assert moved > 0.6
        assert scene.visible[hidden[-1] :].max() > 0.8


def test_long_crossings_cross_again():
    """After six seconds they turn round, and the target is hidden a second time."""
    visible = scenes.crossing(0, frames=160).visible
    assert visible[30:60].min() < 0.15
    assert visible[75:105].min() > 0.9
    assert visible[120:150].min() < 0.15


@pytest.mark.parametrize("camera", ["tof", "rgbd"])
def test_missing_pixels_do_not_change_the_truth(camera):
    """With 30 % of the pixels missing the frames have that many fewer, and boxes and positions stay."""
    full = scenes.walker(2, frames=4, camera=camera, missing=0)
    holey = scenes.walker(2, frames=4, camera=camera, missing=0.3)
    assert full.boxes == holey.boxes
    np.testing.assert_array_equal(full.positions, holey.positions)
    known, left = (np.isfinite([frame.depth for frame in scene.frames]).sum() for scene in (full, holey))
    assert left / known == pytest.approx(0.7, abs=1e-3)


def test_noise_multiplies_what_differs_from_the_exact_depths():
    """Twice the noise is, in the median, twice as far from the depths without."""
    exact, noisy, noisier = (
        np.stack([frame.depth for frame in scenes.walker(2, frames=3, missing=0, noise=noise).frames])
        for noise in (0.0, 1.0, 2.0)
    )
    ratio = np.nanmedian(np.abs(noisier - exact)) / np.nanmedian(np.abs(noisy - exact))
    assert ratio == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("make", [scenes.walker, scenes.crossing])
@pytest.mark.parametrize("frames", [1, 2])
def test_short_scenes_are_scenes(make, frames):
    """A scene of one or two frames has as many truths, all of them finite."""
    scene = make(5, frames=frames)
    assert len(scene.frames) == len(scene.boxes) == frames
    assert np.isfinite(scene.positions).all()


@pytest.mark.parametrize("make", [scenes.walker, scenes.crossing])
@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"frames": 0}, ValueError, "frames: expected a count above 0, got 0"),
        ({"frames": 2.5}, TypeError, "frames: expected a whole number"),
        ({"camera": "lidar"}, ValueError, "camera: expected one of tof, rgbd, got 'lidar'"),
        ({"missing": -0.1}, ValueError, "missing: expected a share of the pixels from 0 to 1"),
        ({"missing": 1.1}, ValueError, "missing: expected a share of the pixels from 0 to 1"),
        ({"noise": -1}, ValueError, "noise: expected a factor of 0 or more, got -1"),
        ({"noise": np.nan}, ValueError, "noise: expected a finite number"),
    ],
)
def test_bad_arguments_are_named(make, arguments, error, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(error, match=words):
        make(**arguments)


@pytest.mark.parametrize(("frames", "change"), [(90, 1.5), (90, -1.5), (10, 0.5), (90, np.nan)])
def test_depth_changes_too_fast_to_walk_are_refused(frames, change):
    """What can't be walked while hidden is refused, with what can."""
    with pytest.raises(ValueError, match="depth_change: expected"):
        scenes.crossing(frames=frames, depth_change=change)


def test_people_need_no_scikit_image():
    """A fresh interpreter without scikit-image and matplotlib makes both scenes."""
    code = (
        "import sys; sys.modules['skimage'] = sys.modules['matplotlib'] = None\n"
        "from tricue.scenes import crossing, walker\n"
        "assert len(walker(frames=2).frames) == len(crossing(frames=2).frames) == 2"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_farthest_walk_is_within_both_ranges():
    """The walkers' floor ends within the range of each camera."""
    assert all(camera.far > people.MAX_WALKER_DISTANCE for camera in people.DEPTH_SENSORS.values())
