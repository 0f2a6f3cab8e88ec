# SPDX-License-Identifier: MIT
"""The flow and depth tracker through ``tricue track``: pairs, depth, color alone."""

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.cli import main
from tricue.scenes import WalkScene, overtaking

FRAMES = 10
WALKER = ["--tracker", "flow-depth"]


@pytest.fixture(scope="module")
def scene() -> WalkScene:
    """A walker before a pair."""
    return overtaking(seed=3, frames=FRAMES)


@pytest.fixture(scope="module")
def measured() -> WalkScene:
    """The same before a depth camera."""
    return overtaking(seed=3, frames=FRAMES, depth=True)


def written(scene: WalkScene, place: Path) -> Path:
    """A scene as left/ and right/, or color/ and depth/ in millimeters, with the rig."""
    sides = ("left", "right") if scene.frames[0].right is not None else ("color", "depth")
    for side in sides:
        (place / side).mkdir(parents=True)
    for index, frame in enumerate(scene.frames):
        assert frame.color is not None
        cv2.imwrite(str(place / sides[0] / f"{index:04}.png"), frame.color)
        if frame.right is not None:
            cv2.imwrite(str(place / "right" / f"{index:04}.png"), frame.right)
        else:
            assert frame.depth is not None
            millimeters = np.nan_to_num(1000 * frame.depth).astype(np.uint16)
            cv2.imwrite(str(place / "depth" / f"{index:04}.png"), millimeters)
    camera = scene.rig.intrinsics
    values = {name: getattr(camera, name) for name in ("fx", "fy", "cx", "cy", "width", "height")}
    lines = [f"{name} = {value}" for name, value in values.items()]
    (place / "camera.toml").write_text("\n".join(lines))
    (place / "rig.toml").write_text("\n".join([*lines, f"baseline = {scene.rig.baseline}"]))
    return place


def boxed(scene: WalkScene) -> list[str]:
    """The first true box, as an option."""
    return ["--box", ",".join(f"{number:.2f}" for number in scene.boxes[0])]


def positions(path: Path) -> NDArray[np.float64]:
    """(M, 3) of a CSV."""
    rows = list(csv.DictReader(path.read_text().splitlines()))
    return np.array([[float(row[key]) for key in ("X_m", "Y_m", "Z_m")] for row in rows])


def test_a_walker_before_a_pair(scene: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a box and a rig are enough: every file is written, positions are within 10 % of the
    distance, and the overlay has the target's pixels in it.
    """
    pytest.importorskip("matplotlib")
    folder = written(scene, tmp_path / "pair")
    out = {name: tmp_path / f"o.{name}" for name in ("mp4", "csv", "json", "png")}
    files = ["--output", str(out["mp4"]), "--csv", str(out["csv"]), "--json", str(out["json"])]
    camera = ["--calibration", str(folder / "rig.toml"), "--plot", str(out["png"])]
    assert main(["track", str(folder), *WALKER, *boxed(scene), *camera, *files]) == 0
    printed = capsys.readouterr()
    assert f"{FRAMES} tracked" in printed.out
    assert not printed.err
    assert all(f"wrote {path}" in printed.out for path in out.values())
    off = np.linalg.norm(positions(out["csv"]) - scene.positions, axis=1)
    assert (off / np.linalg.norm(scene.positions, axis=1)).max() < 0.1
    assert json.loads(out["json"].read_text())["params"]["cues"] == ["flow", "disparity"]
    capture = cv2.VideoCapture(str(out["mp4"]))
    pictures = [capture.read()[1] for _ in range(FRAMES)]
    assert not capture.read()[0]
    first, last = (_green(picture) for picture in (pictures[0], pictures[-1]))
    assert last > first + 0.015  # of the picture: the first frame has no target pixels yet


def _green(picture: NDArray[np.uint8]) -> float:
    """The share of the pixels that are."""
    blue, green, red = np.moveaxis(picture.astype(float), 2, 0)
    return float((2 * green - blue - red > 60).mean())


def test_a_walker_in_color_and_depth(
    measured: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that color with a folder of depth and intrinsics give positions, and an overlay."""
    folder = written(measured, tmp_path / "rgbd")
    depth = ["--depth", str(folder / "depth"), "--depth-scale", "0.001"]
    camera = ["--calibration", str(folder / "camera.toml")]
    files = ["--output", str(tmp_path / "o.mp4"), "--csv", str(tmp_path / "o.csv")]
    arguments = [str(folder / "color"), *WALKER, *boxed(measured), *depth, *camera, *files]
    assert main(["track", *arguments]) == 0
    assert f"{FRAMES} tracked" in capsys.readouterr().out
    off = np.linalg.norm(positions(tmp_path / "o.csv") - measured.positions, axis=1)
    assert off.max() < 0.3
    assert (tmp_path / "o.mp4").stat().st_size > 0


def test_flow_alone_needs_color_alone(
    scene: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that with cues=flow images without any depth are tracked, without a position."""
    folder = written(scene, tmp_path / "pair") / "left"
    more = ["--set", "cues=flow", "--csv", str(tmp_path / "o.csv"), "--output", str(tmp_path / "o.mp4")]
    assert main(["track", str(folder), *WALKER, *boxed(scene), *more]) == 0
    printed = capsys.readouterr()
    assert f"{FRAMES} tracked" in printed.out
    assert not printed.err
    rows = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert {row["Z_m"] for row in rows} == {""}


def test_disparity_alone_needs_depth_alone(
    measured: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that with cues=disparity a folder of depth is tracked, and drawn on the depth."""
    folder = written(measured, tmp_path / "rgbd")
    more = ["--set", "cues=disparity", "--depth-scale", "0.001", "--output", str(tmp_path / "o.mp4")]
    assert main(["track", str(folder / "depth"), *WALKER, *boxed(measured), *more]) == 0
    assert f"{FRAMES} tracked" in capsys.readouterr().out
    assert (tmp_path / "o.mp4").stat().st_size > 0


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--set", "cues=color"], "cues: expected one of 'flow', 'disparity', got 'color'"),
        (["--set", "cues="], "cues: expected 'flow', 'disparity' or both, got ()"),
        ([], "right"),  # a left image alone
        (
            ["--set", "cues=flow", "--box", "500,500,9,9"],
            "expected a part inside the image of 160x120 pixels",
        ),
        (["--set", "bins=2"], "bins: expected at least 8"),
    ],
)
def test_errors_in_a_line(
    scene: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str], more: list[str], message: str
) -> None:
    """It proves that what is wrong with options is one line on stderr, and exit code 2."""
    folder = written(scene, tmp_path / "pair") / "left"
    assert main(["track", str(folder), *WALKER, *boxed(scene), *more]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_a_box_is_needed(scene: WalkScene, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that the error says how to give one."""
    folder = written(scene, tmp_path / "pair")
    assert main(["track", str(folder), *WALKER, "--calibration", str(folder / "rig.toml")]) == 2
    error = capsys.readouterr().err
    assert "--box x,y,width,height" in error
    assert error.count("\n") == 1
