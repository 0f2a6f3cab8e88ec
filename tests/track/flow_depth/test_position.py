# SPDX-License-Identifier: MIT
"""That positions and covariances are those of the box's middle and the disparity, and honest."""

from dataclasses import replace

import numpy as np
import pytest
from tricue import Box, FlowDepthTracker, Frame, Intrinsics, Status, StereoRig

ARRAYS = {"pair": {}, "depth camera": {"depth": True}}


@pytest.fixture(scope="session", params=ARRAYS)
def followed(request, overtakings, follow):
    """A scene's first frames, in which the target is seen, and its tracks."""
    scene = overtakings(0, 55, **ARRAYS[request.param])
    return scene, follow(FlowDepthTracker(rig=scene.rig), scene.frames[:16], scene.boxes[0])


def test_positions_are_where_boxes_are(followed):
    """A position projects into the middle of its box, to rounding."""
    scene, tracks = followed
    for track in tracks:
        center = scene.rig.intrinsics.project(track.position) + 0.5
        np.testing.assert_allclose(center, track.box.center, rtol=0, atol=1e-9)


def test_covariances_are_one(followed):
    """A covariance is symmetric and positive definite in every frame, and longest along the line of sight."""
    for track in followed[1]:
        np.testing.assert_array_equal(track.covariance, track.covariance.T)
        values, vectors = np.linalg.eigh(track.covariance)
        assert values[0] > 0
        assert abs(vectors[:, -1] @ track.position) > 0.98 * np.linalg.norm(track.position)


def test_covariances_are_honest(followed):
    """The mean normalized error squared, 3 for a perfect one, is between 1 and 6: errors last for some
    frames, and a few of them tell no more than the order of magnitude.
    """
    scene, tracks = followed
    offs = np.array([track.position for track in tracks]) - scene.positions[: len(tracks)]
    squared_deviations = [
        off @ np.linalg.solve(track.covariance, off) for track, off in zip(tracks, offs, strict=True)
    ]
    assert 1 < np.mean(squared_deviations) < 6


def test_noises_are_the_parameters(followed):
    """Twice the noise of place and disparity is twice the standard deviation, with the same position."""
    scene, _ = followed
    single, noisy = (
        FlowDepthTracker(rig=scene.rig, place_noise=1.5 * more, disparity_noise=0.2 * more).init(
            scene.frames[0], scene.boxes[0]
        )
        for more in (1, 2)
    )
    np.testing.assert_array_equal(single.position, noisy.position)
    np.testing.assert_allclose(noisy.covariance, 4 * single.covariance, rtol=1e-9)


def test_a_missed_target_gets_less_certain(followed):
    """After t seconds without the target its variance is larger by the square of acceleration_noise t² / 2 in
    every direction; while it is seen that noise changes nothing.
    """
    scene, _ = followed
    trackers = [FlowDepthTracker(rig=scene.rig, acceleration_noise=noise) for noise in (1.0, 2.0)]
    for tracker in trackers:
        tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:12]:
        slow, fast = (tracker.update(frame) for tracker in trackers)
        assert slow == fast
    first = scene.frames[11]
    blind = {"right": first.right * 0} if first.depth is None else {"depth": first.depth * np.nan}
    for i in range(1, 9):
        frame = Frame(first.color * 0, timestamp=first.timestamp + i / 15, **blind)
        slow, fast = (tracker.update(frame) for tracker in trackers)
        assert slow.score == 0
        drift = ((i / 15) ** 2 / 2) ** 2
        np.testing.assert_allclose(fast.covariance - slow.covariance, 3 * drift * np.eye(3), atol=1e-9)


def test_a_missed_target_is_unknown_by_a_hundred_meters_at_most(followed):
    """However fast it may have gone, 100 m in every direction come on top of its covariance, not more."""
    scene, _ = followed
    tracker = FlowDepthTracker(rig=scene.rig, acceleration_noise=1e5)
    tracker.init(scene.frames[0], scene.boxes[0])
    first = scene.frames[1]
    seen = tracker.update(first)
    blind = {"right": first.right * 0} if first.depth is None else {"depth": first.depth * np.nan}
    for _ in range(3):
        last = tracker.update(Frame(first.color * 0, **blind))
        np.testing.assert_allclose(np.diag(last.covariance - seen.covariance), 100**2, rtol=0.01)


def test_positions_are_the_same_at_every_resolution(followed):
    """In images of half the size the target is where it was, and as uncertain; so it is in frames of twice
    the size, whose pixels are half as large.
    """
    scene, _ = followed
    frame, box, camera = scene.frames[0], scene.boxes[0], scene.rig.intrinsics
    twice = {
        name: np.kron(image, np.ones((2, 2, *(1,) * (image.ndim - 2)), image.dtype))
        for name in frame.channels
        for image in [getattr(frame, name)]
    }
    focal, center = 2 * np.array([camera.fx, camera.fy]), 2 * np.array([camera.cx, camera.cy]) + 0.5
    rig = StereoRig(Intrinsics(*focal, *center, 2 * camera.width, 2 * camera.height), scene.rig.baseline)
    large = Box(*(2 * each for each in box))
    whole = FlowDepthTracker(rig=scene.rig).init(frame, box)
    half = FlowDepthTracker(rig=scene.rig, resolution=80).init(frame, box)
    double = FlowDepthTracker(rig=rig).init(Frame(**twice), large)
    for other in (half, double):
        np.testing.assert_allclose(other.position, whole.position, rtol=0.1, atol=0.1)
        deviations = [np.sqrt(np.diag(each.covariance)) for each in (whole, other)]
        np.testing.assert_allclose(deviations[1], deviations[0], rtol=0.15)


@pytest.mark.parametrize("cues", [("flow", "disparity"), ("disparity",), ("flow",)])
def test_without_calibration_there_is_none(cues, followed):
    """Without rig or camera, and by flow alone, tracks have a box but neither position nor covariance."""
    scene, _ = followed
    for rig in (None, scene.rig):
        tracker = FlowDepthTracker(rig=rig, cues=cues)
        tracks = [tracker.init(scene.frames[0], scene.boxes[0]), tracker.update(scene.frames[1])]
        for track in tracks:
            assert (track.position is None) == (rig is None or "disparity" not in cues)
            assert (track.covariance is None) == (track.position is None)
            measured = "disparity" in cues and (rig is not None or scene.frames[0].right is None)
            assert (track.depth is not None) == measured
            assert track.position is None or track.depth == track.position[2]


def test_a_camera_alone_does_not_calibrate_a_pair(overtakings):
    """With ``intrinsics`` a pair has no baseline and so no position; a depth camera has one, the same as with
    a rig.
    """
    pair, sensor = overtakings(0, 55), overtakings(0, 55, depth=True)
    camera = pair.rig.intrinsics
    assert FlowDepthTracker(intrinsics=camera).init(pair.frames[0], pair.boxes[0]).position is None
    found, expected = (
        FlowDepthTracker(**each).init(sensor.frames[0], sensor.boxes[0])
        for each in ({"intrinsics": camera}, {"rig": sensor.rig})
    )
    np.testing.assert_allclose(found.position, expected.position, rtol=1e-6)


def test_depth_images_need_no_camera(overtakings):
    """Without one there is no position, but the same depth, as disparities round to; a pair has none."""
    pair, sensor = overtakings(0, 55), overtakings(0, 55, depth=True)
    found, expected = (
        FlowDepthTracker(**each).init(sensor.frames[0], sensor.boxes[0])
        for each in ({}, {"intrinsics": sensor.rig.intrinsics})
    )
    assert found.position is None
    assert found.depth == pytest.approx(expected.depth, rel=0.03)
    assert expected.depth == expected.position[2]
    assert FlowDepthTracker().init(pair.frames[0], pair.boxes[0]).depth is None


def test_depth_goes_before_a_right_image(overtakings):
    """What is measured goes before what has to be matched, as in the fused tracker: tracks are those of depth
    alone.
    """
    pair, sensor = overtakings(0, 55), overtakings(0, 55, depth=True)
    both = [
        replace(known, right=frame.right) for frame, known in zip(pair.frames, sensor.frames, strict=True)
    ]
    trackers = [FlowDepthTracker(intrinsics=sensor.rig.intrinsics) for _ in range(2)]
    for number in range(5):
        alone, beside = (
            each.update(frames[number]) if number else each.init(frames[0], sensor.boxes[0])
            for each, frames in zip(trackers, (sensor.frames, both), strict=True)
        )
        assert beside == alone
        np.testing.assert_array_equal(beside.position, alone.position)


def test_a_pair_of_a_guessed_rig_never_gives_meters(overtakings):
    """Not even where depth images come later: their depths are converted by the rig that was guessed."""
    pair, sensor = overtakings(0, 55), overtakings(0, 55, depth=True)
    tracker = FlowDepthTracker(intrinsics=sensor.rig.intrinsics)
    tracker.init(pair.frames[0], pair.boxes[0])
    track = tracker.update(sensor.frames[1])
    assert (track.position, track.depth) == (None, None)


def test_the_rig_scales_positions(overtakings):
    """With twice the baseline everything in a pair is twice as far, in every direction."""
    scene = overtakings(0, 55)
    rigs = scene.rig, type(scene.rig)(scene.rig.intrinsics, 2 * scene.rig.baseline)
    once, twice = (FlowDepthTracker(rig=rig).init(scene.frames[0], scene.boxes[0]) for rig in rigs)
    np.testing.assert_allclose(twice.position, 2 * once.position, rtol=1e-12)
    assert twice.box == once.box
    assert twice.status is Status.TRACKED
