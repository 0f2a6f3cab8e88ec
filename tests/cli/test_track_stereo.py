# SPDX-License-Identifier: MIT
import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, StereoRig, Track
from tricue.camera.box import BoxLike, as_box
from tricue.cli import main
from tricue.track.base import registry
from tricue.track.base.params import Params
from tricue.track.base.traits import Channels, Traits

BOX = ["--box", "10,10,20,20"]


class Pair:
    """A tracker that takes a pair and stays where it is; at the depth of its mean difference of levels."""

    Params = Params
    traits = Traits(channels=(Channels.of("color", "right"),), camera=frozenset({"rig"}))

    def __init__(self, rig: StereoRig | None = None, seed: int = 0, kernels: str = "native") -> None:
        self.params, self.rig = Params(), rig
        self.box = Box(0, 0, 1, 1)

    def init(self, frame: Frame, box: BoxLike | None = None) -> Track:
        self.box = as_box(box) if box is not None else self.box
        return self.update(frame)

    def update(self, frame: Frame) -> Track:
        frame.require("right")
        assert frame.color is not None
        assert frame.right is not None
        if self.rig is None:
            return Track(self.box, 1.0, Status.TRACKED)
        difference = float(frame.color.mean()) - float(frame.right.mean())
        position = self.rig.intrinsics.back_project(20, 20, self.rig.depth(difference))
        return Track(self.box, 1.0, Status.TRACKED, position)


@pytest.fixture(autouse=True)
def pair_tracker(monkeypatch: pytest.MonkeyPatch) -> None:
    """``--tracker fused`` now is that tracker."""
    monkeypatch.setitem(registry._BUILT_IN, "fused", f"{Pair.__module__}:Pair")


@pytest.fixture
def pair(tmp_path: Path) -> list[str]:
    """The command for two folders of three images, left 50 levels brighter than right."""
    for side, level in (("left", 150), ("right", 100)):
        (tmp_path / side).mkdir()
        for index in range(3):
            cv2.imwrite(str(tmp_path / side / f"{index}.png"), np.full((48, 64, 3), level, np.uint8))
    return ["track", str(tmp_path / "left"), "--right", str(tmp_path / "right"), *BOX]


def opencv_file(path: Path, **values: Any) -> Path:
    """A file as OpenCV writes it."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in values.items():
        storage.write(name, value)
    storage.release()
    return path


def rectified(path: Path, tx: float = -60.0, **more: Any) -> Path:
    """A rig of 500 px focal length, baseline 0.12."""
    left = np.array([[500.0, 0, 32, 0], [0, 500, 24, 0], [0, 0, 1, 0]])
    right = left.copy()
    right[0, 3] = tx
    return opencv_file(path, P1=left, P2=right, **more)


def raw(path: Path) -> Path:
    """Two raw cameras 12 cm apart, and no P1, P2."""
    camera, shift = np.array([[500.0, 0, 32], [0, 500, 24], [0, 0, 1]]), np.array([[-0.12], [0.0], [0.0]])
    return opencv_file(
        path, M1=camera, D1=np.zeros((1, 5)), M2=camera, D2=np.zeros((1, 5)), R=np.eye(3), T=shift
    )


def tracked(command: list[str], out: Path) -> dict[str, Any]:
    """What the run wrote as JSON."""
    assert main([*command, "--json", str(out)]) == 0
    content: dict[str, Any] = json.loads(out.read_text())
    return content


def test_the_rig_reaches_the_tracker(pair: list[str], tmp_path: Path) -> None:
    """It proves that pair and rig come to the tracker: depth is f b / d = 500 x 0.12 / 50 m in each frame."""
    file = rectified(tmp_path / "c.yml")
    content = tracked([*pair, "--calibration", str(file)], tmp_path / "o.json")
    assert [track["Z_m"] for track in content["tracks"]] == pytest.approx([1.2] * 3)
    assert content["intrinsics"]["fx"] == 500
    assert content["baseline"] == pytest.approx(0.12)


def test_the_boards_unit(pair: list[str], tmp_path: Path) -> None:
    """It proves that --unit brings an OpenCV calibration in millimeters to meters."""
    file = rectified(tmp_path / "c.yml", tx=-60000.0)
    content = tracked([*pair, "--calibration", str(file), "--unit", "0.001"], tmp_path / "o.json")
    assert content["baseline"] == pytest.approx(0.12)


def test_toml_and_kitti_rigs(pair: list[str], tmp_path: Path) -> None:
    """It proves that the other formats of a rig are read, and have no other unit than meters."""
    (tmp_path / "c.toml").write_text("fx = 500.0\nfy = 500.0\ncx = 32.0\ncy = 24.0\nbaseline = 0.12\n")
    (tmp_path / "c.txt").write_text(
        "P2: 500 0 32 0 0 500 24 0 0 0 1 0\nP3: 500 0 32 -60 0 500 24 0 0 0 1 0\n"
    )
    for name in ("c.toml", "c.txt"):
        content = tracked([*pair, "--calibration", str(tmp_path / name)], tmp_path / "o.json")
        assert content["baseline"] == pytest.approx(0.12)
        assert main([*pair, "--calibration", str(tmp_path / name), "--unit", "0.001"]) == 2


def test_kittis_calibration_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that KITTI's folder is enough: images and calibration are found, and said to be."""
    for camera, level in (("image_02", 150), ("image_03", 100)):
        (tmp_path / camera / "0005").mkdir(parents=True)
        cv2.imwrite(str(tmp_path / camera / "0005" / "0.png"), np.full((48, 64, 3), level, np.uint8))
    (tmp_path / "calib").mkdir()
    path = tmp_path / "calib" / "0005.txt"
    path.write_text("P2: 500 0 32 0 0 500 24 0 0 0 1 0\nP3: 500 0 32 -60 0 500 24 0 0 0 1 0\n")
    content = tracked(["track", str(tmp_path), *BOX], tmp_path / "o.json")
    assert content["tracks"][0]["Z_m"] == pytest.approx(1.2)
    assert f"calibration found: {path.resolve()}" in capsys.readouterr().out


def test_raw_pairs_are_rectified(pair: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that --rectify takes the file's raw cameras, gives the tracker the rig that comes of them,
    and sends every pair through the maps.
    """
    from tricue.camera.rectification import Rectification

    seen, call = [], Rectification.__call__

    def counted(self: Rectification, left: Any, right: Any) -> Any:
        seen.append(left.shape)
        return call(self, left, right)

    monkeypatch.setattr(Rectification, "__call__", counted)
    file = raw(tmp_path / "c.yml")
    content = tracked([*pair, "--calibration", str(file), "--rectify"], tmp_path / "o.json")
    assert seen == [(48, 64, 3)] * 3
    assert content["baseline"] == pytest.approx(0.12)
    assert content["intrinsics"]["fx"] == pytest.approx(500)
    assert [track["Z_m"] for track in content["tracks"]] == pytest.approx([1.2] * 3, rel=0.1)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--fov", "60"], "--fov: fused needs the stereo pair's baseline"),
        (["--rectify"], "--rectify: expected with --calibration FILE"),
        (["--unit", "0.001"], "--unit: expected with --calibration FILE"),
        (["--calibration", "raw.yml"], "raw.yml: expected P1 and P2 of a rectified rig"),
        (["--calibration", "rig.yml", "--rectify"], "found no M1 and M2"),
        (["--calibration", "rig.yml", "--unit", "0"], "unit: expected meters above 0"),
        (["--calibration", "big.yml"], "expected a calibration for the color images of 64x48 pixels"),
        (["--calibration", "swapped.yml"], "swap the two cameras"),
        (["--calibration", "nowhere.yml"], "nowhere.yml"),
    ],
)
def test_errors_in_a_line(
    pair: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    more: list[str],
    message: str,
) -> None:
    """It proves that each is one line on stderr with what to do, and exit code 2."""
    monkeypatch.chdir(tmp_path)
    raw(tmp_path / "raw.yml")
    rectified(tmp_path / "rig.yml")
    rectified(tmp_path / "big.yml", image_width=640, image_height=480)
    rectified(tmp_path / "swapped.yml", tx=60.0)
    assert main([*pair, *more]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_without_a_calibration_there_is_no_position(
    pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that a pair alone is tracked, and one line warns of what a missing calibration costs."""
    monkeypatch.setitem(registry._BUILT_IN, "stereo-head", f"{Pair.__module__}:Pair")
    content = tracked([*pair, "--tracker", "stereo-head"], tmp_path / "o.json")
    assert [track["Z_m"] for track in content["tracks"]] == [None] * 3
    assert content["baseline"] is None
    expected = "the stereo pair's calibration isn't known; tracks will have no position in meters; give "
    error = capsys.readouterr().err
    assert error.startswith(f"tricue track: warning: {expected}")
    assert error.count("\n") == 1


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_a_calibration_of_one_camera_beside_the_pair_is_left_out(
    pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a file that nobody asked for, without a baseline, is no error; the warning says why."""
    (tmp_path / "intrinsics.toml").write_text("fx = 500.0\nfy = 500.0\ncx = 32.0\ncy = 24.0\n")
    assert tracked(pair, tmp_path / "o.json")["baseline"] is None
    error = capsys.readouterr().err
    assert "left out the calibration beside the images" in error
    assert "expected the key baseline" in error
    assert error.count("\n") == 1


def test_a_missing_right_image_is_asked_for(
    pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a stereo tracker on left images alone says how to give the right ones."""
    command = [pair[0], pair[1], *BOX]
    for more in ([], ["--calibration", str(rectified(tmp_path / "c.yml"))]):
        assert main([*command, *more]) == 2
        error = capsys.readouterr().err
        assert "give the right camera's images with --right PLACE" in error
        assert error.count("\n") == 1


@pytest.mark.parametrize("option", [["--rectify"], ["--unit", "0.001"]])
def test_other_trackers_take_no_pair(
    pair: list[str], capsys: pytest.CaptureFixture[str], drift_tracker: str, option: list[str]
) -> None:
    """It proves that options of a pair are refused where nothing uses them; --right alone does no harm."""
    other = [*pair, "--tracker", drift_tracker]
    assert main(other) == 0
    assert main([*other, *option]) == 2
    assert f"{option[0]}: expected with a tracker that takes a stereo pair" in capsys.readouterr().err
