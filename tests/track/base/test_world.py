# SPDX-License-Identifier: MIT
"""Positions in the world: of every tracker that tells one, by the camera's pose or by the frame's."""

import csv
import dataclasses
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Frame, Pose, StereoRig, create
from tricue.cli import main
from tricue.scenes import StereoScene

POSE = Pose(cv2.Rodrigues(np.array([0.2, 0.9, -0.1]))[0], (1.0, 2.0, 0.5))
OTHER = Pose(np.eye(3), (5.0, 0.0, 0.0))


@pytest.fixture(scope="module")
def scene(heads) -> StereoScene:
    """A head before a stereo pair."""
    return heads(0)


def posed(rig: StereoRig) -> StereoRig:
    """The rig in the world."""
    return StereoRig(dataclasses.replace(rig.intrinsics, pose=POSE), rig.baseline)


def check(track) -> None:
    """World position and covariance are those of the camera's frame, turned and moved."""
    turn = np.array(POSE.rotation)
    np.testing.assert_allclose(track.world_position, turn @ track.position + POSE.translation, atol=1e-12)
    np.testing.assert_allclose(track.world_covariance, turn @ track.covariance @ turn.T, atol=1e-12)


@pytest.mark.parametrize("name", ["stereo-head", "flow-depth", "fused"])
def test_stereo_trackers_are_in_the_world(name, scene):
    """A rig with a pose puts tracks into the world, too; in the camera's frame they are the same."""
    with_pose, without = (create(name, rig=rig) for rig in (posed(scene.rig), scene.rig))
    for tracker in (with_pose, without):
        tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:4]:
        track, plain = with_pose.update(frame), without.update(frame)
        check(track)
        assert plain.pose is None
        assert plain.world_position is None
        assert plain.world_covariance is None
        assert dataclasses.replace(track, pose=None) == plain


def test_the_depth_tracker_is_in_the_world(rendered):
    """A person in depth, by a depth camera with a pose."""
    from tricue.scenes import walker

    scene = rendered(walker, 0, 4)
    tracker = create("depth-particle", intrinsics=dataclasses.replace(scene.intrinsics, pose=POSE))
    check(tracker.init(scene.frames[0], scene.boxes[0]))
    check(tracker.update(scene.frames[1]))


def test_the_frames_pose_counts_before_the_cameras(scene):
    """A moving camera gives its pose with each frame; a frame without one has the camera's."""
    tracker = create("stereo-head", rig=posed(scene.rig))
    first = scene.frames[0]
    moved = Frame(first.color, right=first.right, timestamp=first.timestamp, pose=OTHER)
    track = tracker.init(moved, scene.boxes[0])
    np.testing.assert_allclose(track.world_position, track.position + [5, 0, 0])
    check(tracker.update(scene.frames[1]))


def test_without_a_position_there_is_none_in_the_world(scene):
    """A stereo pair without a rig has no meters, in no frame."""
    tracker = create("stereo-head")
    first = scene.frames[0]
    track = tracker.init(Frame(first.color, right=first.right, pose=POSE), scene.boxes[0])
    assert track.position is None
    assert track.world_position is None


def test_files_have_the_world_where_there_is_a_pose(scene, tmp_path: Path):
    """CSV and JSON have nine more columns with a pose in the calibration, and none without."""
    for index, frame in enumerate(scene.frames[:3]):
        for side, image in (("left", frame.color), ("right", frame.right)):
            (tmp_path / "pair" / side).mkdir(parents=True, exist_ok=True)
            assert image is not None
            cv2.imwrite(str(tmp_path / "pair" / side / f"{index}.png"), image)
    camera = dataclasses.asdict(scene.rig.intrinsics)
    del camera["pose"]
    lines = [f"{name} = {value}" for name, value in {**camera, "baseline": scene.rig.baseline}.items()]
    headers = {}
    for name, more in (("plain", []), ("posed", [f"pose = {POSE.matrix.tolist()}"])):
        (tmp_path / f"{name}.toml").write_text("\n".join(lines + more))
        place = ["track", str(tmp_path / "pair"), "--tracker", "stereo-head"]
        box = ["--box", ",".join(map(str, scene.boxes[0])), "--calibration", str(tmp_path / f"{name}.toml")]
        files = ["--csv", str(tmp_path / f"{name}.csv"), "--json", str(tmp_path / f"{name}.json")]
        assert main([*place, *box, *files]) == 0
        headers[name] = (tmp_path / f"{name}.csv").read_text().splitlines()[0].split(",")
    assert headers["posed"][: len(headers["plain"])] == headers["plain"]
    added = headers["posed"][len(headers["plain"]) :]
    assert added[:4] == ["world_X_m", "world_Y_m", "world_Z_m", "world_XX_m2"]
    assert len(added) == 9
    rows = list(csv.DictReader((tmp_path / "posed.csv").read_text().splitlines()))
    for row in rows:
        point = [float(row[f"{axis}_m"]) for axis in "XYZ"]
        world = [float(row[f"world_{axis}_m"]) for axis in "XYZ"]
        np.testing.assert_allclose(world, POSE.to_world(point), atol=1e-5)
    document = json.loads((tmp_path / "posed.json").read_text())
    assert document["intrinsics"]["pose"]["translation"] == list(POSE.translation)
    assert document["tracks"][0]["world_X_m"] == float(rows[0]["world_X_m"])
    assert "pose" not in json.loads((tmp_path / "plain.json").read_text())["intrinsics"]
