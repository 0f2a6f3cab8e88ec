# SPDX-License-Identifier: MIT
"""Poses: a camera's place and direction in the world, against OpenCV's rotations and sampled points."""

import pickle
import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Frame, Intrinsics, Pose, StereoRig

RNG = np.random.default_rng(1)
TURN = cv2.Rodrigues(np.array([0.3, -1.1, 0.4]))[0]
PLACE = np.array([2.0, -1.0, 1.6])
POSE = Pose(TURN, PLACE)
CAMERA = {"fx": 100.0, "fy": 100.0, "cx": 79.5, "cy": 59.5, "width": 160, "height": 120}


def test_points_are_turned_and_moved():
    """Points come to the camera's place plus the rotated offset, many at once."""
    points = RNG.normal(size=(5, 4, 3))
    expected = np.array([TURN @ point + PLACE for point in points.reshape(-1, 3)]).reshape(5, 4, 3)
    np.testing.assert_allclose(POSE.to_world(points), expected, atol=1e-12)
    np.testing.assert_allclose(POSE.to_world([0, 0, 0]), PLACE)
    np.testing.assert_allclose(POSE.matrix @ [*points[0, 0], 1], [*expected[0, 0], 1], atol=1e-12)


def test_a_camera_that_looks_along_y():
    """The example of docs/data.md: forward is the world's y, up is its z."""
    pose = Pose([[1, 0, 0], [0, 0, 1], [0, -1, 0]], [2, 0, 1.6])
    np.testing.assert_allclose(pose.to_world([0, 0, 3]), [2, 3, 1.6])
    np.testing.assert_allclose(pose.to_world([0, -1, 0]), [2, 0, 2.6])


@pytest.mark.parametrize(
    ("pan", "tilt", "ahead", "right", "down"),
    [
        (90, 0, [1, 0, 0], [0, 0, -1], [0, 1, 0]),  # looks to the right
        (0, 90, [0, -1, 0], [1, 0, 0], [0, 0, 1]),  # looks up, the image's upper edge behind
        (90, 90, [0, -1, 0], [0, 0, -1], [1, 0, 0]),  # looks up, the upper edge to the left
    ],
)
def test_a_head_that_pans_and_tilts(pan, tilt, ahead, right, down):
    """Pan turns the camera to the right, about the vertical; then tilt raises its view."""
    pose = Pose.from_pan_tilt(*np.radians([pan, tilt]), translation=(1, 2, 3))
    axes = pose.to_world(np.eye(3)) - [1, 2, 3]
    np.testing.assert_allclose(axes, [right, down, ahead], atol=1e-12)


@pytest.mark.parametrize("name", ["pan", "tilt"])
def test_an_angle_that_is_none_is_named(name):
    """NaN is no angle."""
    with pytest.raises(ValueError, match=rf"^{name}: expected a finite number, radians, got nan"):
        Pose.from_pan_tilt(**{"pan": 0.0, "tilt": 0.0, name: np.nan})


@pytest.mark.parametrize("name", ["pan", "tilt"])
def test_degrees_are_told(name, recwarn):
    """At the caller's line, in the words of PanTilt; a whole turn in radians gives no warning."""
    expected = rf"^{name}: expected radians, got about -40, which looks like degrees"
    with pytest.warns(UserWarning, match=expected) as told:
        Pose.from_pan_tilt(**{"pan": 0.0, "tilt": 0.0, name: -41.0})
    assert told[0].filename == __file__
    Pose.from_pan_tilt(-2 * np.pi, 2 * np.pi)
    assert not recwarn


def test_covariance_is_that_of_the_moved_points():
    """The covariance of sampled points, transformed one by one, is the transformed covariance, exactly."""
    root = np.diag([0.1, 0.2, 0.9])
    root[2, 0] = 0.4
    sample = RNG.normal(size=(200, 3)) @ root.T
    measured = np.cov(POSE.to_world(sample).T)
    np.testing.assert_allclose(POSE.covariance_to_world(np.cov(sample.T)), measured, atol=1e-12)


@pytest.mark.parametrize(
    ("points", "error", "message"),
    [
        ([1, 2], ValueError, r"(..., 3), got shape (2,)"),
        (5.0, ValueError, r"(..., 3), got shape ()"),
        (None, ValueError, r"(..., 3), got shape ()"),  # NumPy takes None for NaN
        ("here", TypeError, r"(..., 3), got 'here'"),
    ],
)
def test_what_are_no_points_is_named(points, error, message):
    """A wrong shape, or what aren't numbers, is named with the argument."""
    with pytest.raises(error, match=rf"^points: expected numbers of shape {re.escape(message)}$"):
        POSE.to_world(points)


def test_what_is_no_covariance_is_named():
    """That of a plane isn't one of a point, nor is a row of variances."""
    for covariance in (np.eye(2), np.ones(3)):
        message = rf"^covariance: .* \(\.\.\., 3, 3\), got shape {re.escape(str(covariance.shape))}$"
        with pytest.raises(ValueError, match=message):
            POSE.covariance_to_world(covariance)


def test_inverse_brings_points_back():
    """There and back again, as values and as matrices."""
    points = RNG.normal(size=(6, 3))
    np.testing.assert_allclose(POSE.inverse.to_world(POSE.to_world(points)), points, atol=1e-12)
    np.testing.assert_allclose(POSE.inverse.matrix, np.linalg.inv(POSE.matrix), atol=1e-12)
    np.testing.assert_allclose(Pose.from_matrix(POSE.matrix).matrix, POSE.matrix, atol=1e-15)


def test_a_pose_is_a_value():
    """Equal poses are equal and hash alike, pickle, and can't be changed; a camera keeps its pose."""
    again = Pose(TURN.copy(), PLACE.copy())
    assert again == POSE == pickle.loads(pickle.dumps(POSE))
    assert hash(again) == hash(POSE)
    assert Pose(TURN) != POSE
    camera = Intrinsics(**CAMERA, pose=POSE.matrix)
    assert camera.pose == POSE
    assert camera != Intrinsics(**CAMERA)
    assert StereoRig(camera, 0.1).pose == POSE
    assert StereoRig(Intrinsics(**CAMERA), 0.1).pose is None
    assert Frame(np.zeros((4, 4), np.uint8), pose=POSE).pose is POSE
    assert Frame(np.zeros((4, 4), np.uint8)).pose is None


def test_a_rounded_rotation_is_made_orthogonal():
    """Four digits, as written by hand, do; the rotation is then exactly one."""
    turn = np.array(Pose(np.round(TURN, 4)).rotation)
    np.testing.assert_allclose(turn.T @ turn, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(turn, TURN, atol=1e-4)


@pytest.mark.parametrize(
    ("rotation", "translation", "message"),
    [
        (2 * np.eye(3), PLACE, "rotation: expected a rotation matrix"),
        (np.diag([1, 1, -1]), PLACE, "rotation: expected a right-handed rotation"),
        (np.eye(4), PLACE, r"rotation: expected numbers of shape \(3, 3\), got shape \(4, 4\)"),
        (np.full((3, 3), np.nan), PLACE, "rotation: expected finite numbers"),
        (np.eye(3), [1, 2], r"translation: expected numbers of shape \(3,\)"),
        (np.eye(3), [1, 2, np.inf], "translation: expected finite numbers"),
        ("north", PLACE, "rotation: expected numbers"),
    ],
)
def test_what_is_no_pose_is_named(rotation, translation, message):
    """A matrix that isn't a rotation, or numbers that are too many or not finite, are named."""
    with pytest.raises((TypeError, ValueError), match=message):
        Pose(rotation, translation)


def test_a_matrix_that_is_no_pose_is_named():
    """The last row says that it is a rigid motion; a camera names its pose."""
    matrix = POSE.matrix
    matrix[3, 0] = 1
    with pytest.raises(ValueError, match="pose: expected the last row 0, 0, 0, 1"):
        Pose.from_matrix(matrix)
    with pytest.raises(ValueError, match=r"pose: expected numbers of shape \(4, 4\)"):
        Intrinsics(**CAMERA, pose=np.eye(3))
    assert Pose.from_matrix(POSE.matrix[:3]) == POSE


@pytest.mark.parametrize("pose", [(TURN, PLACE), [TURN.tolist(), PLACE.tolist()], [[1, 2], [3]], "north", {}])
def test_what_is_no_matrix_is_named(pose):
    """Rotation and translation side by side, and rows of different lengths, are errors that name the pose."""
    image = np.zeros((4, 4), np.uint8)
    for make in (
        Pose.from_matrix,
        lambda pose: Intrinsics(**CAMERA, pose=pose),
        lambda p: Frame(image, pose=p),
    ):
        with pytest.raises(TypeError, match=r"^pose: expected numbers of shape \(4, 4\), got "):
            make(pose)


def toml(*lines: str) -> str:
    """A calibration with more lines."""
    return "\n".join([*(f"{name} = {value}" for name, value in CAMERA.items()), "baseline = 0.1", *lines])


def test_a_toml_file_may_have_a_pose(tmp_path: Path):
    """As one matrix or as rotation and translation; a rig has that of its camera, most files have none."""
    path = tmp_path / "rig.toml"
    path.write_text(toml(f"pose = {POSE.matrix.tolist()}"))
    assert Intrinsics.from_toml(path).pose == POSE
    assert StereoRig.from_toml(path).pose == POSE
    path.write_text(toml(f"rotation = {TURN.tolist()}", f"translation = {PLACE.tolist()}"))
    assert StereoRig.from_toml(path).pose == POSE
    path.write_text(toml("translation = [0, 0, 1.5]"))
    assert StereoRig.from_toml(path).pose == Pose(np.eye(3), (0, 0, 1.5))
    path.write_text(toml())
    assert StereoRig.from_toml(path).pose is None


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["pose = [1, 2, 3]"], r"rig.toml: pose: expected numbers of shape \(4, 4\)"),
        (['rotation = "north"'], "rig.toml: rotation: expected numbers"),
        (["translation = [0, 0, 0]", f"pose = {np.eye(4).tolist()}"], "rig.toml: pose: expected alone"),
        (["translaton = [0, 0, 1]"], r"rig.toml: translaton: unknown key; did you mean translation\?"),
    ],
)
def test_a_bad_pose_names_the_file(lines, message, tmp_path: Path):
    """What isn't a pose is told with the file's name."""
    (tmp_path / "rig.toml").write_text(toml(*lines))
    with pytest.raises((TypeError, ValueError), match=message):
        Intrinsics.from_toml(tmp_path / "rig.toml")
