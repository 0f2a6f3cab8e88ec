# SPDX-License-Identifier: MIT
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import tricue.rerun
from tricue import Box, Frame, Intrinsics, Pose, Status, StereoRig, Track
from tricue.doctor.install import install_extra

CAMERA = Intrinsics(60, 60, 31.5, 23.5, 64, 48)
BOX = Box(10.0, 20.0, 6.0, 8.0)


def frame(index: int) -> Frame:
    """Blue and 2 m away all over."""
    color = np.full((48, 64, 3), (200, 20, 10), np.uint8)
    return Frame(color, np.full((48, 64), 2.0, np.float32), color, timestamp=index / 10)


def track(index: int, status: Status = Status.TRACKED, pose: Pose | None = None) -> Track:
    """A target that goes 1 m to the right a frame."""
    return Track(BOX, 0.5, status, np.array([float(index), 0.0, 2.0]), pose=pose)


class FakeRerun(ModuleType):
    """What is used of rerun; what is logged is kept: the path, the archetype's name, and its arguments."""

    def __init__(self) -> None:
        super().__init__("rerun")
        self.logged: list[tuple[str, str, tuple[Any, ...], dict[str, Any]]] = []
        self.times: list[dict[str, Any]] = []

    def __getattr__(self, name: str) -> Any:
        if not name[0].isupper():
            raise AttributeError(name)
        return lambda *arguments, **keywords: (name, arguments, keywords)

    def log(self, path: str, entity: Any, recording: Any) -> None:
        self.logged.append((path, *entity))

    def set_time(self, timeline: str, recording: Any, **time: Any) -> None:
        self.times.append({timeline: time})


@pytest.fixture
def rerun(monkeypatch: pytest.MonkeyPatch) -> FakeRerun:
    """A stand-in for rerun."""
    fake = FakeRerun()
    monkeypatch.setitem(sys.modules, "rerun", fake)
    return fake


def test_what_is_logged(rerun: FakeRerun) -> None:
    """It proves that images, box, position and camera get their paths, values and times."""
    tricue.rerun.log(frame(3), track(3), name="ball", camera=CAMERA, number=3)
    assert rerun.times == [{"time": {"duration": 0.3}}, {"frame": {"sequence": 3}}]
    logged = {path: (kind, arguments, keywords) for path, kind, arguments, keywords in rerun.logged}
    assert {path: kind for path, (kind, _, _) in logged.items()} == {
        "camera": "Pinhole",
        "camera/color": "Image",
        "camera/right": "Image",
        "camera/depth": "DepthImage",
        "camera/ball": "Boxes2D",
        "world/ball": "Points3D",
    }
    assert logged["camera/color"][2] == {"color_model": "BGR"}
    assert logged["camera/depth"][2] == {"meter": 1.0}
    box = logged["camera/ball"][2]
    assert (box["mins"], box["sizes"], box["labels"]) == ([[10, 20]], [[6, 8]], ["ball: tracked, 0.50"])
    assert np.array_equal(logged["world/ball"][1], [[[3.0, 0.0, 2.0]]])


def test_a_stereo_pair_is_shown_by_its_left_camera(rerun: FakeRerun) -> None:
    """It proves that the camera of any recording will do, as that of one with stereo pairs is a rig."""
    place = Pose(np.eye(3), [0, 0, 5])
    left = Intrinsics(60, 60, 31.5, 23.5, 64, 48, pose=place)
    tricue.rerun.log(frame(0), camera=StereoRig(left, 0.1))
    (pinhole,) = [keywords for _, kind, _, keywords in rerun.logged if kind == "Pinhole"]
    assert np.array_equal(pinhole["image_from_camera"], left.matrix)
    (placed,) = [keywords for _, kind, _, keywords in rerun.logged if kind == "Transform3D"]
    assert np.array_equal(placed["translation"], [0, 0, 5])


def test_positions_in_the_world(rerun: FakeRerun) -> None:
    """It proves that a pose puts the camera into the world, and the position where it is there."""
    pose = Pose(np.eye(3), np.array([0.0, 0.0, 5.0]))
    image = np.zeros((4, 6, 3), np.uint8)
    tricue.rerun.log(Frame(image, timestamp=1.7e9, pose=pose), track(1, pose=pose))
    assert rerun.times == [{"time": {"timestamp": 1.7e9}}]
    (placed,) = [keywords for path, kind, _, keywords in rerun.logged if kind == "Transform3D"]
    assert np.array_equal(placed["translation"], [0, 0, 5])
    (points,) = [arguments for _, kind, arguments, _ in rerun.logged if kind == "Points3D"]
    assert np.array_equal(points, [[[1.0, 0.0, 7.0]]])


def test_the_camera_is_where_the_tracks_pose_is(rerun: FakeRerun) -> None:
    """It proves that images and positions agree if only the tracker knows the pose, by its own camera."""
    tricue.rerun.log(frame(0), track(1, pose=Pose(np.eye(3), [0, 0, 5])), camera=CAMERA)
    (placed,) = [keywords for _, kind, _, keywords in rerun.logged if kind == "Transform3D"]
    assert np.array_equal(placed["translation"], [0, 0, 5])


def test_a_target_without_position_is_cleared(rerun: FakeRerun) -> None:
    """It proves that the last position doesn't stay in view, and that a second target needs no frame."""
    tricue.rerun.log(None, Track(BOX, 0.1, Status.LOST), name="b")
    assert [(path, kind) for path, kind, _, _ in rerun.logged] == [
        ("camera/b", "Boxes2D"),
        ("world/b", "Clear"),
    ]
    assert rerun.times == []


def test_paths_are_broken_where_nothing_was_tracked(rerun: FakeRerun) -> None:
    """It proves that a line doesn't go through frames in which the target was hidden."""
    tracks = [track(n, Status.OCCLUDED if n == 3 else Status.TRACKED) for n in range(7)]
    tricue.rerun.log_path(tracks, name="a")
    ((path, kind, (strips,), _),) = rerun.logged
    assert (path, kind) == ("world/a/path", "LineStrips3D")
    assert [strip[:, 0].tolist() for strip in strips] == [[0, 1, 2], [4, 5, 6]]


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that without rerun-sdk the error says what to install."""
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(ImportError, match=re.escape(f"needs rerun-sdk: {install_extra('rerun')}")):
        tricue.rerun.log(frame(0))


def test_a_saved_recording(tmp_path: Path) -> None:
    """It proves that Rerun's own program finds a saved recording in order, with what was logged."""
    rr = pytest.importorskip("rerun", reason="needs the extra rerun")
    path = tmp_path / "a.rrd"
    recording = rr.RecordingStream("tricue")
    recording.save(path)
    for index in range(3):
        tricue.rerun.log(frame(index), track(index), camera=CAMERA, number=index, recording=recording)
    tricue.rerun.log_path([track(index) for index in range(3)], recording=recording)
    recording.flush()
    del recording
    command = [sys.executable, "-m", "rerun_cli", "rrd"]
    subprocess.run([*command, "verify", str(path)], check=True, capture_output=True, timeout=60)
    printed = subprocess.run(
        [*command, "print", "-vvv", str(path)], check=True, capture_output=True, text=True, timeout=60
    ).stdout
    entities = set(re.findall(r"entity_path: (/\S+)", printed))
    expected = {"/camera", *(f"/camera/{name}" for name in ("color", "depth", "right", "target"))}
    assert expected | {"/world/target", "/world/target/path"} <= entities
    assert "[[13.0, 24.0]]" in printed  # the box's center
    assert "[[2.0, 0.0, 2.0]]" in printed  # the last position
