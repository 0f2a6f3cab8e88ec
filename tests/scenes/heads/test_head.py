# SPDX-License-Identifier: MIT
import subprocess
import sys

import cv2
import numpy as np
import pytest
from tricue import scenes
from tricue.scenes.heads import head as heads
from tricue.scenes.heads import moves as head_moves

SEEDS = range(2)


@pytest.fixture(scope="module")
def all_kinds(rendered):
    """100 frames of every kind, 160x120, of 2 seeds each."""
    return {kind: [rendered(scenes.head, seed, kind=kind) for seed in SEEDS] for kind in scenes.HEAD_KINDS}


@pytest.fixture(scope="module")
def everything(all_kinds):
    """The same in one list."""
    return [scene for same in all_kinds.values() for scene in same]


def ellipse(scene, index, share=1.0):
    """The pixels (H, W) within ``share`` of the true ellipse's axes."""
    box = scene.boxes[index]
    (x, y), half = box.center, np.array([box.width, box.height]) / 2 * share
    rows, columns = np.indices(scene.frames[index].color.shape[:2]) + 0.5
    return ((columns - x) / half[0]) ** 2 + ((rows - y) / half[1]) ** 2 < 1


@pytest.mark.parametrize("kind", scenes.HEAD_KINDS)
def test_seed_decides_everything(kind):
    """One seed gives one scene bit for bit; another seed gives another path and other pixels."""
    first, again, other = (scenes.head(seed, 3, kind=kind) for seed in (3, 3, 4))
    assert first.boxes == again.boxes
    assert first.rig == again.rig
    for name in ("positions", "visible", "facing", "light"):
        np.testing.assert_array_equal(getattr(first, name), getattr(again, name))
    for one, same in zip(first.frames, again.frames, strict=True):
        np.testing.assert_array_equal(one.color, same.color)
        np.testing.assert_array_equal(one.right, same.right)
    assert first.boxes != other.boxes
    assert not np.array_equal(first.frames[0].color, other.frames[0].color)


@pytest.mark.parametrize(("camera", "shape"), [("160x120", (120, 160, 3)), ("640x480", (480, 640, 3))])
def test_scene_is_whole(camera, shape):
    """Both images have the camera's size, the rate's timestamps, a rig that fits, and a truth a frame."""
    scene = scenes.head(1, 3, camera)
    assert scene.name == f"head, normal, {camera}, seed 1"
    assert [frame.channels for frame in scene.frames] == [("color", "right")] * 3
    assert {frame.color.shape for frame in scene.frames} == {shape}
    assert [frame.timestamp for frame in scene.frames] == pytest.approx(np.arange(3) / 30)
    assert (scene.rig.intrinsics.height, scene.rig.intrinsics.width) == shape[:2]
    assert 0.10 <= scene.rig.baseline <= 0.12
    assert len(scene.boxes) == len(scene.visible) == len(scene.facing) == len(scene.light) == 3
    assert scene.positions.shape == (3, 3)


def test_head_is_in_range_and_in_both_images(everything):
    """The head is 0.8 to 4 m away, whole in the left image, and its center well within the right one."""
    for scene in everything:
        assert scene.positions[:, 2].min() >= 0.8
        assert scene.positions[:, 2].max() <= 4.0
        disparity = scene.rig.intrinsics.fx * scene.rig.baseline / scene.positions[:, 2]
        for box, shift in zip(scene.boxes, disparity, strict=True):
            assert box.clip(160, 120) == pytest.approx(box)
            assert box.center[0] - shift > box.width / 2 - 1


def test_boxes_have_the_size_of_heads(everything):
    """At its distance a box is 19 to 26 cm high, and 1.0 to 1.45 times as high as wide, 1.2 in the median."""
    ratios = []
    for scene in everything:
        sizes = np.array([box[2:] for box in scene.boxes])
        height = sizes[:, 1] * scene.positions[:, 2] / scene.rig.intrinsics.fy
        assert height.min() > 0.17  # the outline is that of points farther than the mean of the surface
        assert height.max() < 0.26
        ratios += (sizes[:, 1] / sizes[:, 0]).tolist()
    assert min(ratios) > 1.0
    assert max(ratios) < 1.45
    assert np.median(ratios) == pytest.approx(1.2, abs=0.06)


def test_positions_project_to_the_middles_of_the_boxes(everything):
    """The true position lies, projected, within a twelfth of the box's width of the box's center."""
    for scene in everything:
        for box, position in zip(scene.boxes, scene.positions, strict=True):
            u, v = scene.rig.intrinsics.project(position) + 0.5
            assert np.hypot(u - box.center[0], v - box.center[1]) < box.width / 12


def test_the_head_walks(everything):
    """Positions move by up to 1.6 m/s, in most scenes over half a meter in depth and to the sides."""
    for scene in everything:
        speed = np.linalg.norm(np.diff(scene.positions, axis=0), axis=1) * 30
        assert speed.max() < 1.7
    spans = np.array([np.ptp(scene.positions, axis=0) for scene in everything])
    assert np.median(spans[:, 0]) > 0.5
    assert np.median(spans[:, 1]) > 0.12
    assert np.median(spans[:, 2]) > 0.5


@pytest.mark.parametrize("kind", ["normal", "turning"])
def test_stereo_matching_finds_the_true_depth(kind):
    """OpenCV's semi-global matching on the large images gives the true disparity, to 2 % and 0.4 px."""
    matcher = cv2.StereoSGBM_create(0, 96, 7, P1=8 * 147, P2=32 * 147, uniquenessRatio=10)
    for seed in SEEDS:
        scene = scenes.head(seed, 2, "640x480", kind=kind)
        frame = scene.frames[0]
        disparity = matcher.compute(frame.color, frame.right) / 16
        found = disparity[ellipse(scene, 0, 0.85) & (disparity > 0)]
        truth = scene.rig.intrinsics.fx * scene.rig.baseline / scene.positions[0, 2]
        assert len(found) > 0.4 * ellipse(scene, 0, 0.85).sum()
        assert np.median(found) == pytest.approx(truth, rel=0.02, abs=0.4)


def test_images_are_rectified():
    """Corners of the left image are found in the right one's same row, to a quarter pixel in the median."""
    for seed in SEEDS:
        frame = scenes.head(seed, 1, "640x480").frames[0]
        left, right = (cv2.cvtColor(image, cv2.COLOR_BGR2GRAY) for image in (frame.color, frame.right))
        corners = cv2.goodFeaturesToTrack(left, 200, 0.01, 10)
        found, known, _ = cv2.calcOpticalFlowPyrLK(left, right, corners, None, maxLevel=4)
        rise = (found - corners)[known.ravel() == 1, 0, 1]
        assert abs(np.median(rise)) < 0.05
        assert np.median(np.abs(rise)) < 0.25


@pytest.mark.parametrize("kind", ["normal", "distractor", "turning", "hidden"])
def test_light_swings_over_the_whole_range(all_kinds, kind):
    """The light goes from 0.7 to 1.3 and never by more than 6 % a frame; a face's level follows it."""
    for scene in all_kinds[kind]:
        assert scene.light.min() == pytest.approx(0.7)
        assert scene.light.max() == pytest.approx(1.3)
        assert np.abs(np.diff(np.log(scene.light))).max() < 0.06
        assert scene.changes == ()


def test_light_jumps(all_kinds):
    """The light changes at the named frames alone, several times and within 30 %, and the image with it."""
    for scene in all_kinds["jump"]:
        assert len(scene.changes) >= 4
        steps = np.diff(scene.light)
        assert (np.flatnonzero(steps) + 1).tolist() == list(scene.changes)
        assert scene.light.min() >= 0.7
        assert scene.light.max() <= 1.3
        level = np.array([float(np.median(frame.color[:40])) for frame in scene.frames])
        for change in scene.changes:
            before, after = level[change - 1], level[change]
            assert after / before == pytest.approx(scene.light[change] / scene.light[change - 1], rel=0.08)


def test_light_falls_to_half(all_kinds):
    """The ramp goes evenly from 1 to 0.5 within 100 frames, and the image's level with it."""
    for scene in all_kinds["ramp"]:
        np.testing.assert_allclose(scene.light, np.linspace(1, 0.5, 100))
        first, last = (float(scene.frames[index].color[:40].mean()) for index in (0, 99))
        assert last / first == pytest.approx(0.5, abs=0.05)


def test_turning_shows_only_hair(all_kinds):
    """Who turns shows the face at first, then only hair for 5 frames or more; else the face stays."""
    for kind, same in all_kinds.items():
        for scene in same:
            if kind == "turning":
                assert scene.facing[0] < np.radians(60)
                assert (scene.facing > np.radians(150)).sum() >= 5
            else:
                assert scene.facing.max() < np.radians(75)


def test_hair_has_another_color_than_the_face(all_kinds):
    """From face to hair the mean color of the head's middle changes by 15 % or more."""
    changed = 0
    for scene in all_kinds["turning"]:
        face, hair = np.argmin(scene.facing), np.argmax(scene.facing)
        colors = [
            scene.frames[index].color[ellipse(scene, index, 0.7)].mean(axis=0) / scene.light[index]
            for index in (face, hair)
        ]
        changed += np.abs(np.log(colors[0] / colors[1])).max() > 0.15
    assert changed == len(SEEDS)


def test_a_hand_hides_the_head_and_leaves(all_kinds):
    """The head is wholly hidden for 10 to 20 frames in a row, and free for 30 before and 30 after it."""
    for scene in all_kinds["hidden"]:
        hidden = np.flatnonzero(scene.visible == 0)
        assert 10 <= len(hidden) <= 20
        assert np.ptp(hidden) == len(hidden) - 1
        assert (scene.visible[: hidden[0] - head_moves.HAND_SLIDE_FRAMES] == 1).all()
        assert (scene.visible[hidden[-1] + 1 + head_moves.HAND_SLIDE_FRAMES :] == 1).all()
        assert hidden[0] - head_moves.HAND_SLIDE_FRAMES >= 25
        assert 100 - hidden[-1] - head_moves.HAND_SLIDE_FRAMES >= 30


def test_nothing_else_hides_the_head(all_kinds):
    """In all other kinds nothing is ever before the head."""
    for kind, same in all_kinds.items():
        if kind != "hidden":
            assert all((scene.visible == 1).all() for scene in same)


def test_distractors_have_the_color_of_skin():
    """In most seeds there is half a head's area or more of the skin's hue that isn't there without them."""
    more = 0
    for seed in range(8):
        areas = {}
        for kind in ("normal", "distractor"):
            scene = scenes.head(seed, 2, kind=kind, noise=0, light=0)
            image = scene.frames[0].color.astype(float)
            middle = ellipse(scene, 0, 0.4)
            skin = np.median(image[middle], axis=0)
            hue = np.abs(image / image.sum(axis=2, keepdims=True) - skin / skin.sum()).max(axis=2) < 0.02
            away = ~ellipse(scene, 0, 2.5)
            areas[kind] = (hue & away).sum() / ellipse(scene, 0).sum()
        more += areas["distractor"] > areas["normal"] + 0.5
    assert more >= 6


def test_noise_does_not_change_the_truth():
    """Twice the noise leaves boxes and positions, and is twice as far from the picture without."""
    exact, noisy, noisier = (scenes.head(2, 3, noise=noise) for noise in (0.0, 2.0, 4.0))
    assert exact.boxes == noisy.boxes == noisier.boxes
    np.testing.assert_array_equal(exact.positions, noisier.positions)
    for channel in ("color", "right"):
        pictures = [getattr(scene.frames[1], channel).astype(float) for scene in (exact, noisy, noisier)]
        inside = (pictures[0] > 20) & (pictures[0] < 235)
        far = [np.std((picture - pictures[0])[inside]) for picture in pictures[1:]]
        assert far == pytest.approx([2.0, 4.0], rel=0.05)


@pytest.mark.parametrize("kind", scenes.HEAD_KINDS)
@pytest.mark.parametrize("frames", [1, 2])
def test_short_scenes_are_scenes(kind, frames):
    """A scene of one or two frames has as many truths, all of them finite."""
    scene = scenes.head(5, frames=frames, kind=kind)
    assert len(scene.frames) == len(scene.boxes) == frames
    assert np.isfinite(scene.positions).all()
    assert np.isfinite(scene.light).all()


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"frames": 0}, ValueError, "frames: expected a count above 0, got 0"),
        ({"camera": "tof"}, ValueError, "camera: expected one of 160x120, 640x480, got 'tof'"),
        ({"kind": "dark"}, ValueError, "kind: expected one of normal, distractor, .* got 'dark'"),
        ({"light": 1.0}, ValueError, "light: expected a share of 0 or more and below 1"),
        ({"light": np.nan}, ValueError, "light: expected a finite number"),
        ({"noise": -1}, ValueError, "noise: expected levels of 255, 0 or more, got -1"),
    ],
)
def test_bad_arguments_are_named(arguments, error, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(error, match=words):
        scenes.head(**arguments)


def test_heads_need_no_scikit_image():
    """A fresh interpreter without scikit-image and matplotlib makes a head."""
    code = (
        "import sys; sys.modules['skimage'] = sys.modules['matplotlib'] = None\n"
        "from tricue.scenes import head\n"
        "assert len(head(frames=2).frames) == 2"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_walks_keep_their_distance_from_the_cameras():
    """Over 50 seeds and ten seconds the path stays in its range, and within what both cameras see."""
    for seed in range(50):
        rng = np.random.default_rng(seed)
        room = heads._range(heads._rig("160x120", rng), "normal")
        moves = head_moves.sample_walk(300, room, turning=False, rng=rng)
        x, y, z = moves.center.T
        assert room.near <= z.min()
        assert z.max() <= room.far
        assert (np.abs(x - room.baseline / 2) + room.baseline / 2 + 0.12 < room.side * z).all()
        assert (np.abs(y) + 0.12 < room.up * z).all()


def test_a_head_at_rest_stays_where_it_is_asked_to(rendered):
    """Box and position are the same in all frames, only noise differs; swinging light changes all pixels."""
    scene = rendered(scenes.static_head, 2, 3, distance=2.0, aside=(0.4, -0.2))
    assert len(set(scene.boxes)) == 1
    np.testing.assert_array_equal(scene.positions, scene.positions[:1].repeat(3, 0))
    assert 1.8 < scene.positions[0, 2] < 2.0
    half = scene.rig.intrinsics.width / 2 / scene.rig.intrinsics.fx
    assert scene.positions[0, 0] == pytest.approx(0.4 * half * 2 + scene.rig.baseline / 2, abs=0.05)
    first, second = (frame.color.astype(int) for frame in scene.frames[:2])
    assert 0 < np.abs(first - second).mean() < 3
    swinging = scenes.static_head(2, 3, distance=2.0, light=0.3)
    assert np.ptp(swinging.light) > 0
    still = scenes.static_head(2, 2, noise=0.0)
    np.testing.assert_array_equal(still.frames[0].color, still.frames[1].color)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"distance": 0.2}, "distance: expected 0.5 to 10 m"),
        ({"aside": (0.9, 0.0)}, "aside: expected a head in both views at 1.5 m"),
    ],
)
def test_a_head_at_rest_is_in_sight(wrong, message):
    """A head that a camera couldn't see is refused by the argument's name."""
    with pytest.raises(ValueError, match=message):
        scenes.static_head(**wrong)
