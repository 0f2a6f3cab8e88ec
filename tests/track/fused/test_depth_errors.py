# SPDX-License-Identifier: MIT
"""That a track's position is as wrong as its covariance says, where sensors have the faults of real ones."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, FusedTracker, Intrinsics, Status, StereoRig
from tricue.scenes import crossing, walker
from tricue.track.base.position_limit import MAX_SIGMA
from tricue.track.fused import position_filter
from tricue.track.fused import tracker as fused

ROOMS = [("held", 0), ("held", 1), ("table", 0), ("table", 1)]
FRAMES = 45


@pytest.fixture(scope="module")
def rooms(rendered: Callable[..., object]) -> list:
    """Things on a table and in a hand before a depth camera with faults."""
    pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    from tricue.scenes.rooms.scene import room_scene

    return [
        rendered(room_scene, kind, seed, size=(240, 180), channels="rgbd", frames=FRAMES)
        for kind, seed in ROOMS
    ]


@pytest.fixture(scope="module")
def people(rendered: Callable[..., object]) -> list:
    """People before a time-of-flight camera."""
    return [rendered(kind, seed) for kind in (walker, crossing) for seed in (0, 1)]


def lateral_deviations(scenes: list) -> NDArray[np.float64]:
    """(N, 2) errors to the right and down in standard deviations, of the frames that are TRACKED on the
    target; things have color and depth, people depth alone.
    """
    found = []
    for scene in scenes:
        tracker = FusedTracker(intrinsics=scene.intrinsics)
        for index, frame in enumerate(scene.frames):
            track = tracker.update(frame) if index else tracker.init(frame, scene.boxes[0])
            if track.status is Status.TRACKED and track.box.iou(Box(*scene.boxes[index])) > 0.5:
                error = track.position - scene.positions[index]
                found.append(np.abs(error[:2]) / np.sqrt(np.diag(track.covariance)[:2]))
    return np.array(found)


@pytest.mark.parametrize("kind", ["rooms", "people"])
def test_lateral_errors_are_within_the_covariance(kind, request):
    """Nine in ten are within two standard deviations, which aren't more than three times the errors."""
    found = lateral_deviations(request.getfixturevalue(kind))
    assert len(found) > 100
    assert np.all(np.mean(found <= 2, axis=0) >= 0.9)
    assert np.all(np.sqrt(np.mean(found**2, axis=0)) > 1 / 3)


def test_the_filter_alone_does_not_know_where_in_a_person_it_is(people, monkeypatch):
    """By the filter's own covariance a third of the errors down the image are beyond two deviations."""
    monkeypatch.setattr(fused, "lateral_variances", lambda *_: (0.0, 0.0))
    assert np.mean(lateral_deviations(people)[:, 1] <= 2) < 0.67


def deviations(rooms: list) -> NDArray[np.float64]:
    """(N,) errors along z in standard deviations, of the frames that are TRACKED on the target."""
    found = []
    for scene in rooms:
        tracker = FusedTracker(intrinsics=scene.intrinsics)
        for index, frame in enumerate(scene.frames):
            track = tracker.update(frame) if index else tracker.init(frame, scene.boxes[0])
            if track.status is Status.TRACKED and track.box.iou(Box(*scene.boxes[index])) > 0.3:
                error = track.position[2] - scene.positions[index, 2]
                found.append(abs(error) / np.sqrt(track.covariance[2, 2]))
    return np.array(found)


def test_depth_errors_are_within_the_covariance(rooms):
    """Over two thirds of the errors are within one standard deviation, 95 % within two."""
    found = deviations(rooms)
    assert found.size > 0.8 * FRAMES * len(ROOMS)
    assert np.mean(found <= 1) >= 0.68
    assert np.mean(found <= 2) >= 0.95


def test_the_filter_alone_does_not_know_them(rooms, monkeypatch):
    """By the filter's own covariance fewer are: the errors of its measurements aren't independent."""
    monkeypatch.setattr(position_filter, "SHARED_DEPTH_ERROR", 0.0)
    found = deviations(rooms)
    assert np.mean(found <= 1) < 0.6
    assert np.mean(found <= 2) < 0.9


def test_depth_is_the_positions(rooms):
    """It is the position's z, with a camera and without, and comes and goes with the position."""
    scene = rooms[0]
    for cameras in ({"intrinsics": scene.intrinsics}, {}):
        tracker = FusedTracker(**cameras)
        tracks = [tracker.init(scene.frames[0], scene.boxes[0]), *map(tracker.update, scene.frames[1:10])]
        assert [track.depth for track in tracks] == [float(track.position[2]) for track in tracks]
    tracker = FusedTracker()
    assert tracker.init(Frame(scene.frames[0].color), scene.boxes[0]).depth is None
    assert tracker.update(scene.frames[1]).depth == pytest.approx(scene.positions[1, 2], rel=0.05)
    predicted = tracker.update(Frame(scene.frames[2].color))
    assert predicted.depth == predicted.position[2]


def test_depth_needs_no_right_camera(rooms):
    """A camera that is wrong by a factor of two leaves the depth, but not the position to the right."""
    scene, right = rooms[2], rooms[2].intrinsics
    wrong = replace(right, fx=2 * right.fx, fy=2 * right.fy)
    once, twice = (
        FusedTracker(intrinsics=camera).init(scene.frames[0], scene.boxes[0]) for camera in (right, wrong)
    )
    assert twice.depth == pytest.approx(once.depth, rel=1e-9)
    assert twice.position[0] == pytest.approx(once.position[0] / 2, rel=1e-6)


def test_a_guessed_rig_gives_no_depth(drawn, shoot):
    """Without ``rig`` a stereo pair has a guessed position and no depth; a depth image has one."""
    pair, measured = shoot("plain", "pair")[:3], shoot("plain", "rgbd")[:3]
    box = drawn("plain").boxes[0]
    for tracker, known in ((FusedTracker(), False), (FusedTracker(rig=drawn("plain").rig), True)):
        for frames, expected in ((pair, known), (measured, True), ([measured[0], *pair[1:]], known)):
            track = [tracker.init(frames[0], box), *map(tracker.update, frames[1:])][-1]
            assert track.position is not None
            assert (track.depth is not None) == expected


@pytest.mark.parametrize("width_of_view", [45, 90])
def test_a_guessed_camera_is_in_the_covariance(rooms, width_of_view, monkeypatch):
    """What the default camera is off by shows to the right and down, and not in the depth."""
    monkeypatch.setattr(fused, "lateral_variances", lambda *_: (0.0, 0.0))
    scene = rooms[2]
    camera = Intrinsics.from_fov(scene.intrinsics.width, scene.intrinsics.height, width_of_view)
    known, guessed = (
        FusedTracker(**cameras).init(scene.frames[0], scene.boxes[0])
        for cameras in ({"intrinsics": camera}, {})
    )
    off = guessed.position - known.position
    assert abs(off[0]) > 5 * np.sqrt(known.covariance[0, 0])
    assert np.all(np.abs(off) <= 2 * np.sqrt(np.diag(guessed.covariance)))
    assert np.sqrt(guessed.covariance[0, 0]) < 0.5 * abs(guessed.position[0])
    assert guessed.covariance[2, 2] == pytest.approx(known.covariance[2, 2], rel=0.1)
    assert np.linalg.eigvalsh(guessed.covariance).min() > 0


@pytest.mark.parametrize("baseline", [0.06, 0.2])
def test_a_guessed_rig_is_in_the_covariance(drawn, shoot, baseline):
    """All meters of a pair scale with the distance of its cameras."""
    frame, scene = shoot("plain", "pair")[0], drawn("plain")
    known, guessed = (
        FusedTracker(**cameras).init(frame, scene.boxes[0])
        for cameras in ({"rig": StereoRig(scene.rig.intrinsics, baseline)}, {})
    )
    off = guessed.position - known.position
    assert abs(off[2]) > 5 * np.sqrt(known.covariance[2, 2])
    assert np.all(np.abs(off) <= 2 * np.sqrt(np.diag(guessed.covariance)))


def test_five_minutes_without_depth_leave_a_position(drawn, shoot):
    """Color alone follows on, TRACKED, a frame a second; the position is unknown by 100 m, not by more."""
    frames = shoot("plain", "rgbd")
    tracker = FusedTracker(intrinsics=drawn("plain").intrinsics)
    tracker.init(frames[0], drawn("plain").boxes[0])
    for second in range(1, 301):
        track = tracker.update(Frame(frames[0].color, timestamp=float(second)))
    assert track.status is Status.TRACKED
    deviations = np.sqrt(np.diag(track.covariance))
    assert 0.9 * MAX_SIGMA < deviations.max() < 1.2 * MAX_SIGMA
    back = tracker.update(Frame(frames[0].color, depth=frames[0].depth, timestamp=301.0))
    assert np.sqrt(np.diag(back.covariance)).max() < 0.5
    np.testing.assert_allclose(back.position, drawn("plain").positions[0], atol=0.1)
