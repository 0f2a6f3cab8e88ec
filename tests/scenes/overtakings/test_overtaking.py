# SPDX-License-Identifier: MIT
import subprocess
import sys
from functools import cache

import cv2
import numpy as np
import pytest
from tricue import scenes
from tricue.reference import rectify_verged
from tricue.scenes.overtakings import overtaking as overtakings
from tricue.scenes.overtakings import plan as overtaking_moves
from tricue.scenes.overtakings.hall import Hall
from tricue.scenes.overtakings.truth import WalkGeometry

WIDTH, HEIGHT = 160, 120
overtaking = cache(scenes.overtaking)  # for scenes that several tests look at


@pytest.fixture(scope="module")
def clean():
    """30 frames without noise, of either kind: the target alone, and half hidden in the end."""
    return [scenes.overtaking(3, 30, kind=kind, noise=0) for kind in scenes.OVERTAKING_KINDS]


@pytest.fixture(scope="module")
def stories():
    """The plan, the people's places and all sights of 100 frames: of 2 plain seeds, and 6 varied ones."""
    return [story(kind, seed) for kind, count in (("plain", 2), ("varied", 6)) for seed in range(count)]


def story(kind, seed):
    """What happens in a scene, without its pictures."""
    rng = np.random.default_rng(seed)
    plan = overtaking_moves.PLAIN_PLAN if kind == "plain" else overtaking_moves.sample_plan(rng)
    people, paths = overtakings._sample_people(plan, "160x120", 100, rng)
    truth = WalkGeometry(paths.pan, Hall([]), people)
    return plan, paths, [truth.truth_at(index) for index in range(100)]


def warp(image, x, y):
    """The float32 image at pixel coordinates (H, W), between the pixels too."""
    return cv2.remap(image, x.astype(np.float32), y.astype(np.float32), cv2.INTER_LANCZOS4)


def inner(region, pixels):
    """The region (H, W) without a rim of so many pixels."""
    return cv2.erode(region.astype(np.uint8), np.ones((2 * pixels + 1, 2 * pixels + 1))) > 0


def smooth_surfaces(disparity):
    """Where no depth edge, and no image edge, is within 4 pixels of a pixel or of where it comes from."""
    jumps = np.abs(cv2.Laplacian(disparity, cv2.CV_32F)) > 0.3
    inside = np.zeros(disparity.shape, bool)
    inside[5:-5, 15:-5] = True
    return inner(~jumps, 4) & inside


def residual(warped, image, region):
    """By how many pixels along x the warped image is off there, by least squares, and levels of 255."""
    warped, image = (cv2.GaussianBlur(picture, (0, 0), 0.7) for picture in (warped, image))
    slope = cv2.Sobel(image, cv2.CV_32F, 1, 0, scale=1 / 8)[region]
    error = (warped - image)[region]
    return float((error * slope).sum() / (slope**2).sum()), float(np.abs(error).mean())


@pytest.mark.parametrize(("kind", "depth"), [("plain", False), ("varied", True)])
def test_seed_decides_everything(kind, depth):
    """One seed gives one scene bit for bit, the start of a longer one; another one has other pixels."""
    first, again, other = (
        scenes.overtaking(seed, frames, kind=kind, depth=depth) for seed, frames in ((3, 4), (3, 2), (4, 2))
    )
    assert first.boxes[:2] == again.boxes
    assert first.rig == again.rig
    assert first.rig != other.rig
    for name in ("positions", "visible", "masks", "flow", "disparity"):
        for one, same in zip(getattr(first, name)[:2], getattr(again, name), strict=True):
            np.testing.assert_array_equal(one, same)
    for one, same, different in zip(first.frames[:2], again.frames, other.frames, strict=True):
        for channel in one.channels:
            np.testing.assert_array_equal(getattr(one, channel), getattr(same, channel))
            assert not np.array_equal(getattr(one, channel), getattr(different, channel))


@pytest.mark.parametrize(
    ("camera", "shape"), [("160x120", (120, 160)), ("640x480", (480, 640))], ids=["small", "large"]
)
def test_scene_is_whole(camera, shape):
    """Images, masks, flow and disparity have the camera's size; there is one of each truth a frame."""
    scene = overtaking(2, 2, camera, kind="varied")
    assert scene.name == f"overtaking, varied, {camera}, seed 2"
    assert [frame.channels for frame in scene.frames] == [("color", "right")] * 2
    assert {frame.color.shape for frame in scene.frames} == {(*shape, 3)}
    assert [frame.timestamp for frame in scene.frames] == pytest.approx(np.arange(2) / 15)
    for name in ("boxes", "visible_boxes", "visible", "positions", "masks", "flow", "disparity", "others"):
        assert len(getattr(scene, name)) == 2
    assert {mask.shape for mask in scene.masks} == {map_.shape for map_ in scene.disparity} == {shape}
    assert {flow.shape for flow in scene.flow} == {(*shape, 2)}
    assert np.isnan(scene.flow[0]).all()
    assert np.isfinite(scene.flow[1]).all()
    assert scene.events == scenes.Events(None, None, None, None)


def test_both_cameras_see_one_world():
    """At 640x480 boxes, flow and disparity are those of 160x120, four times as long."""
    small, large = (overtaking(2, 2, camera, kind="varied") for camera in overtakings.RAYS_PER_PIXEL)
    assert np.array(large.boxes) == pytest.approx(4 * np.array(small.boxes))
    np.testing.assert_allclose(large.positions, small.positions, atol=0.01)
    for name in ("disparity", "flow"):
        few, many = (getattr(scene, name)[1] for scene in (small, large))
        # The corners of the small pixels' centers: the mean of the four large ones that meet there.
        at = [many[1 + i :: 4, 1 + j :: 4] for i in (0, 1) for j in (0, 1)]
        near = np.ptp(at, axis=0) < 0.2
        np.testing.assert_allclose(np.mean(at, axis=0)[near], 4 * few[near], atol=0.1)
        assert near.mean() > 0.8


@pytest.mark.parametrize("kind", scenes.OVERTAKING_KINDS)
def test_flow_takes_the_frame_before_to_this_one(kind):
    """Warped by the true flow the last frame is this one, to 0.05 px on target and hall, and not without.

    In frame 7 the legs are apart, so that little of one was behind the other before.
    """
    scene = scenes.overtaking(3, 8, "640x480", kind=kind, depth=True, noise=0)
    before, now = (scene.frames[i].color.astype(np.float32) for i in (6, 7))
    flow, mask = scene.flow[7], scene.masks[7]
    v, u = np.indices(mask.shape)
    warped = warp(before, u - flow[..., 0], v - flow[..., 1])
    one_part = inner(np.abs(cv2.Laplacian(flow, cv2.CV_32F)).max(axis=2) < 0.4, 4)
    hall = smooth_surfaces(scene.disparity[7]) & ~mask
    for region in (hall, inner(mask, 4) & one_part):
        assert region.sum() > 2000
        shift, levels = residual(warped, now, region)
        assert abs(shift) < 0.05
        assert levels < 1.5
    assert residual(before, now, region)[1] > 8 * levels


def test_disparity_takes_the_right_image_to_the_left(clean):
    """Warped by the true disparity the right image is the left one but for its gain, to 0.05 px."""
    for scene in clean:
        left, right = (getattr(scene.frames[3], name).astype(np.float32) for name in ("color", "right"))
        disparity = scene.disparity[3]
        v, u = np.indices(disparity.shape)
        warped = warp(right, u - disparity, v)
        region = smooth_surfaces(disparity) & (left.max(axis=2) < 235)
        gain = (warped[region] * left[region]).sum() / (warped[region] ** 2).sum()
        assert 0.94 < gain < 1.06
        assert abs(residual(gain * warped, left, region)[0]) < 0.05
        assert residual(gain * warped, left, region)[1] < 1.5


def test_disparities_are_those_of_the_story():
    """The target has 4 to 6 px, who overtakes 3 to 5.5 px more, the hall less, and all pixels have one."""
    for seed in range(4):
        scene = overtaking(seed, 2, "160x120", kind="varied")
        disparity = scene.disparity[0]
        intrinsics, baseline = scene.rig.intrinsics, scene.rig.baseline
        target, overtaker = (
            intrinsics.fx * baseline / z for z in (scene.positions[0, 2], scene.others[0][0].position[2])
        )
        assert 4.0 < target < 6.0
        assert 3.0 < overtaker - target < 5.5
        assert np.median(disparity[scene.masks[0]]) == pytest.approx(target, abs=0.15)
        hall = np.ones_like(scene.masks[0])
        for box in (scene.boxes[0], *(other.box for other in scene.others[0])):
            left, top, right, bottom = (int(side) for side in box.clip(WIDTH, HEIGHT).xyxy)
            hall[top : bottom + 1, left : right + 1] = False
        hall[80:] = False  # the floor comes nearer
        assert disparity.min() > 1.0
        assert disparity[hall].max() < target - 0.5
        assert np.ptp(disparity[hall]) > 0.5


def test_masks_agree_with_boxes_and_visible_shares(clean):
    """A mask's pixels fill the visible box, lie within the whole box, and are all of it while it is free."""
    for scene in clean:
        whole = scene.masks[0].sum()
        for index, mask in enumerate(scene.masks):
            rows, columns = np.nonzero(mask)
            visible = scene.visible_boxes[index]
            assert (visible.x, visible.y) == (columns.min(), rows.min())
            assert (visible.width, visible.height) == (np.ptp(columns) + 1, np.ptp(rows) + 1)
            box = scene.boxes[index]
            assert box.x - 0.5 <= visible.x
            assert visible.xyxy[2] <= box.xyxy[2] + 0.5
            if scene.visible[index] == 1:
                assert np.array(visible) == pytest.approx(np.array(box), abs=1.0)
            # Arms and legs swing, so the whole has not always the same size.
            assert mask.sum() / whole == pytest.approx(scene.visible[index], abs=0.25)


def test_flow_agrees_with_the_positions(clean):
    """Along x the median flow on the target is the motion of its projected position, but for its limbs."""
    for scene in clean:
        moved = np.diff(scene.rig.intrinsics.project(scene.positions), axis=0)
        for index in range(1, 8):
            flow = np.median(scene.flow[index][scene.masks[index]], axis=0)
            assert flow[0] == pytest.approx(moved[index - 1, 0], abs=0.5)


def test_the_first_frame_shows_the_target_whole(stories):
    """At first nothing hides any of it, and its box is inside the image, 60 to 80 pixels high."""
    for _, _, sights in stories:
        assert sights[0].visible == 1
        box = sights[0].target.box
        assert box.clip(WIDTH, HEIGHT) == box
        assert 60 < box.height < 80


def test_the_target_is_overtaken(stories):
    """Hiding begins in time, 5 frames or more have less than 1 % of the target, then it comes back, whole."""
    for plan, _, sights in stories:
        visible = np.array([truth.visible for truth in sights])
        events = overtakings._events(visible, round(plan.passing_frame))
        assert 8 < events.hiding < events.hidden < events.back < 56
        assert events.hidden < 32
        assert (visible < 0.01).sum() >= 5
        assert 10 <= events.back - events.hidden <= 35
        assert visible[events.hidden : events.back].max() <= 0.25
        assert visible[events.back : events.passing].max() > 0.7
        assert (visible[-6:] == 1).all()


def test_who_overtakes_is_nearer_and_a_little_faster(stories):
    """In the picture both go the plan's way, who overtakes a pixel a frame faster; he was behind at first."""
    for plan, paths, sights in stories:
        columns = np.array([[truth.target.box.center[0], truth.others[0].box.center[0]] for truth in sights])
        target, overtaker = (plan.direction * np.diff(columns[::20].T) / 20).mean(axis=1)
        assert 0.4 < target < 1.3
        assert 0.8 < overtaker - target < 1.1
        gap = plan.direction * (columns[:, 1] - columns[:, 0])
        assert gap[0] < -20
        assert gap[-1] > 40
        assert (sights[0].others[0].position[2] < 0.65 * sights[0].target.position[2]).all()
        speed = np.hypot(*np.diff(paths.target, axis=0).T) * overtaking_moves.OVERTAKING_FRAME_RATE
        assert speed.min() > 0.3
        assert speed.max() < 1.1


def test_the_target_passes_who_stands_at_its_depth(stories):
    """At the pass both are on one line of sight, their surfaces 0.4 pixels of disparity apart or less."""
    for plan, paths, sights in stories:
        index = round(plan.passing_frame)
        assert 65 < index <= 78
        target, standing = sights[index].target, sights[index].others[1]
        camera = paths.pan.rig.intrinsics
        columns = [camera.project(who.position)[0] for who in (target, standing)]
        assert columns[0] == pytest.approx(columns[1], abs=3)
        depths = np.array([target.position[2], standing.position[2]])
        near, far = camera.fx * paths.pan.rig.baseline / depths
        assert abs(near - far) < 0.4
        assert np.sign(far - near) == -np.sign(plan.standing_depth_offset)
        behind = min(truth.visible for truth in sights[index - 2 : index + 3])
        assert behind > 0.9 if plan.standing_depth_offset > 0 else 0.05 < behind < 0.6


def test_who_stands_moves_with_the_hall(stories):
    """In the picture who stands moves against the walk, at the speed of the pan."""
    for plan, _, sights in stories:
        columns = np.array([truth.others[1].box.center[0] for truth in sights])
        middle = np.abs(columns[:-1] - 80) < 30
        moved = -plan.direction * np.diff(columns)[middle]
        assert moved.mean() == pytest.approx(plan.pan_speed, rel=0.05, abs=0.01)


def test_varied_scenes_vary():
    """Among 16 varied seeds both directions and both sides of who stands occur; pans differ."""
    plans = [overtaking_moves.sample_plan(np.random.default_rng(seed)) for seed in range(16)]
    assert {plan.direction for plan in plans} == {-1, 1}
    assert {np.sign(plan.standing_depth_offset) for plan in plans} == {-1, 1}
    pans = [plan.pan_speed for plan in plans]
    assert min(pans) < 0.2
    assert max(pans) > 0.7
    assert all(0 <= pan <= 0.9 for pan in pans)


def test_limbs_move_against_the_trunk(clean):
    """While the trunk walks on evenly, flow on the target differs by a pixel or more: legs and arms swing."""
    scene = clean[0]
    spread = [np.ptp(scene.flow[i][scene.masks[i]][:, 0]) for i in range(1, 12)]
    assert max(spread) > 1.0


def test_depth_frames_hold_the_true_depth():
    """With depth=True most pixels have a depth, some have none; off the edges errors are a sensor's."""
    scene = scenes.overtaking(2, 2, kind="varied", depth=True)
    same = overtaking(2, 2, "160x120", kind="varied")
    assert [frame.channels for frame in scene.frames] == [("color", "depth")] * 2
    assert scene.boxes == same.boxes
    for frame, disparity in zip(scene.frames, scene.disparity, strict=True):
        truth = scene.rig.depth(disparity)
        measured = np.isfinite(frame.depth)
        assert 0.9 < measured.mean() < 0.99
        error = np.abs(frame.depth - truth)[measured] / truth[measured] ** 2
        assert 0.0005 < np.median(error) < 0.002
        assert np.median(np.abs(frame.depth - truth)[measured & scene.masks[0]]) < 0.06


def test_noise_is_as_said_and_does_not_change_the_truth():
    """Twice the noise leaves boxes, and is twice as far from the picture without, in both images."""
    exact, noisy, noisier = (scenes.overtaking(2, 2, noise=noise) for noise in (0.0, 2.0, 4.0))
    assert exact.boxes == noisy.boxes == noisier.boxes
    for channel in ("color", "right"):
        pictures = [getattr(scene.frames[1], channel).astype(float) for scene in (exact, noisy, noisier)]
        inside = (pictures[0] > 20) & (pictures[0] < 235)
        far = [np.std((picture - pictures[0])[inside]) for picture in pictures[1:]]
        assert far == pytest.approx([2.0, 4.0], rel=0.05)


def test_no_ray_passes_between_the_halls_boards():
    """Over the whole pan of the longest scenes there is a wall, floor or thing on each pixel's ray."""
    for seed in range(4):
        rng = np.random.default_rng(seed)
        truth, _ = overtakings._sample_geometry(
            overtaking_moves.sample_plan(rng), "160x120", overtakings.MAX_OVERTAKING_FRAMES, rng
        )
        for index in (0, 50, 100, overtakings.MAX_OVERTAKING_FRAMES - 1):
            assert truth.disparity(index).min() > 0.5
        assert np.isfinite(truth.flow(index)).all()


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"frames": 0}, ValueError, "frames: expected a count above 0, got 0"),
        ({"frames": 201}, ValueError, "frames: expected at most 200, got 201"),
        ({"frames": 1.5}, TypeError, "frames: expected a whole number, a count, got 1.5"),
        ({"camera": "tof"}, ValueError, "camera: expected one of 160x120, 640x480, got 'tof'"),
        ({"kind": "normal"}, ValueError, "kind: expected one of plain, varied, got 'normal'"),
        ({"noise": -1}, ValueError, "noise: expected levels of 255, 0 or more, got -1"),
        ({"noise": np.nan}, ValueError, "noise: expected a finite number"),
    ],
)
def test_bad_arguments_are_named(arguments, error, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(error, match=words):
        scenes.overtaking(**arguments)


def test_overtakings_need_no_scikit_image():
    """A fresh interpreter without scikit-image and matplotlib makes a scene."""
    code = (
        "import sys; sys.modules['skimage'] = sys.modules['matplotlib'] = None\n"
        "from tricue.scenes import overtaking\n"
        "assert len(overtaking(frames=2).frames) == 2"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("vergence", [1.0, 5.0])
def test_a_verged_right_image_rectifies_to_the_parallel_one(vergence):
    """Turned back by the kernel, the right image of a verged pair is that of a parallel one, where both see
    the same; left image and truth are the same.
    """
    parallel, verged = (scenes.overtaking(0, 2, noise=0, vergence=angle) for angle in (0.0, vergence))
    camera = parallel.rig.intrinsics
    angle = np.radians(vergence)
    for one, other in zip(parallel.frames, verged.frames, strict=True):
        np.testing.assert_array_equal(one.color, other.color)
        back = rectify_verged(other.right, angle, camera.fx, (camera.cx, camera.cy), 0.0)
        seen = np.s_[8:-8, 4 : camera.width - round(camera.fx * np.tan(angle)) - 8]
        wrong = np.abs(back[seen].astype(float) - one.right[seen]).mean()
        unrectified = np.abs(other.right[seen].astype(float) - one.right[seen]).mean()
        assert wrong < 5
        assert wrong < 0.4 * unrectified
    assert (verged.vergence, verged.boxes) == (vergence, parallel.boxes)


@pytest.mark.parametrize("vergence", [-1, 21, np.nan])
def test_vergence_is_checked(vergence):
    """It is 0 to 20 degrees."""
    with pytest.raises(ValueError, match="vergence: expected"):
        scenes.overtaking(0, 2, vergence=vergence)
