# SPDX-License-Identifier: MIT
"""The stereo head tracker itself through ``tricue track``; test_track_stereo.py uses a stand-in."""

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box
from tricue.cli import main
from tricue.export.table import COVARIANCE
from tricue.scenes import StereoScene, head, room_scene, write_sequence

FRAMES = 12
HEAD = ["--tracker", "stereo-head"]


@pytest.fixture(scope="module")
def scene() -> StereoScene:
    """A head in the light of a room."""
    return head(seed=4, frames=FRAMES)


@pytest.fixture
def folder(scene: StereoScene, tmp_path: Path) -> Path:
    """The scene as left/ and right/, with the true boxes and the rig."""
    place = tmp_path / "pair"
    for index, frame in enumerate(scene.frames):
        for side, image in (("left", frame.color), ("right", frame.right)):
            (place / side).mkdir(parents=True, exist_ok=True)
            assert image is not None
            cv2.imwrite(str(place / side / f"{index:04}.png"), image)
    (place / "groundtruth.txt").write_text("\n".join(",".join(map(str, box)) for box in scene.boxes))
    camera = scene.rig.intrinsics
    values = {name: getattr(camera, name) for name in ("fx", "fy", "cx", "cy", "width", "height")}
    lines = [f"{name} = {value}" for name, value in {**values, "baseline": scene.rig.baseline}.items()]
    (place / "rig.toml").write_text("\n".join(lines))
    return place


def calibrated(folder: Path) -> list[str]:
    """The command with its calibration."""
    return ["track", str(folder), *HEAD, "--calibration", str(folder / "rig.toml")]


def test_a_head_is_tracked_in_meters(
    folder: Path, scene: StereoScene, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the true first box and a rig are enough: every file is written, positions are within 4 %
    of the distance, and their covariances are those of a real error, in CSV and in JSON.
    """
    pytest.importorskip("matplotlib")
    out = {name: folder / f"o.{name}" for name in ("mp4", "csv", "json", "png")}
    files = ["--output", str(out["mp4"]), "--csv", str(out["csv"]), "--json", str(out["json"])]
    assert main([*calibrated(folder), *files, "--plot", str(out["png"])]) == 0
    printed = capsys.readouterr()
    assert f"{FRAMES} tracked" in printed.out
    assert all(f"wrote {path}" in printed.out for path in out.values())
    assert not printed.err
    rows = list(csv.DictReader(out["csv"].read_text().splitlines()))
    places = np.array([[float(row[key]) for key in ("X_m", "Y_m", "Z_m")] for row in rows])
    errors = np.linalg.norm(places - scene.positions, axis=1) / np.linalg.norm(scene.positions, axis=1)
    assert errors.max() < 0.04
    for row in rows:
        covariance = np.zeros((3, 3))
        covariance[np.triu_indices(3)] = [float(row[key]) for key in COVARIANCE]
        covariance += np.triu(covariance, 1).T
        assert np.linalg.eigvalsh(covariance).min() > 0
        assert 0.001 < np.sqrt(covariance[2, 2]) < 0.2
    assert [t["ZZ_m2"] for t in json.loads(out["json"].read_text())["tracks"]] == [
        float(row["ZZ_m2"]) for row in rows
    ]
    assert cv2.imread(str(out["png"])) is not None
    capture = cv2.VideoCapture(str(out["mp4"]))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == FRAMES


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_a_head_without_a_rig(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that without a calibration a head is followed, a warning says what is missing, the overlay
    is written, the plot not.
    """
    pytest.importorskip("matplotlib")
    files = ["--output", str(folder / "o.mp4"), "--json", str(folder / "o.json"), "--plot"]
    assert main(["track", str(folder), *HEAD, *files, str(folder / "o.png")]) == 0
    printed = capsys.readouterr()
    assert "tracks will have no position in meters" in printed.err
    assert printed.err.count("\n") == 1
    assert f"{FRAMES} tracked" in printed.out
    assert "not written, no track has a position" in printed.out
    assert {track["ZZ_m2"] for track in json.loads((folder / "o.json").read_text())["tracks"]} == {None}
    assert (folder / "o.mp4").stat().st_size > 0


@pytest.mark.parametrize("tracker", ["stereo-head", "color-particle"])
def test_detect_face_waits_for_a_head(
    folder: Path, scene: StereoScene, tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --detect face finds a head in stereo pairs, in the first frame that shows one, with any
    tracker.
    """
    for path in folder.glob("*/000[01].png"):
        cv2.imwrite(str(path), np.full((120, 160, 3), 90, np.uint8))
    (folder / "groundtruth.txt").unlink()
    place = calibrated(folder) if tracker == "stereo-head" else ["track", str(folder)]
    command = [*place, "--tracker", tracker, "--detect", "face"]
    assert main([*command, "--csv", str(folder / "o.csv")]) == 0
    rows = list(csv.DictReader((folder / "o.csv").read_text().splitlines()))
    assert [row["frame"] for row in rows] == [str(index) for index in range(2, FRAMES)]
    assert "started in frame 2" in capsys.readouterr().out
    box = Box(*(float(rows[0][key]) for key in ("x", "y", "width", "height")))
    assert box.iou(scene.boxes[2]) > 0.5


def test_detect_face_finds_a_head_in_depth(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that in color with depth --detect face starts on a head, which is followed in meters."""
    scene = room_scene("walker", 0, channels="rgbd", frames=4)
    write_sequence(scene, tmp_path / "room")
    command = ["track", str(tmp_path / "room"), "--detect", "face", "--csv", str(tmp_path / "o.csv")]
    assert main(command) == 0
    assert "started in frame" not in capsys.readouterr().out  # in the first
    rows = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    start = Box(*(float(rows[0][key]) for key in ("x", "y", "width", "height")))
    x, y, width, _ = scene.boxes[0]
    assert x < start.center[0] < x + width
    assert abs(start.y - y) < 5
    assert start.height < 30
    assert [row["status"] for row in rows] == ["tracked"] * 4
    assert all(row["Z_m"] for row in rows)


def small(folder: Path) -> None:
    """Make the right images those of another size."""
    for path in (folder / "right").iterdir():
        cv2.imwrite(str(path), np.zeros((60, 80, 3), np.uint8))


def blank(folder: Path) -> None:
    """Make both images black, where nothing has a disparity."""
    for path in folder.glob("*/*.png"):
        cv2.imwrite(str(path), np.zeros((120, 160, 3), np.uint8))


def shortened(folder: Path) -> None:
    """Leave out the last of the right images."""
    max((folder / "right").iterdir()).unlink()


def untrue(folder: Path) -> None:
    """Leave out the true boxes."""
    (folder / "groundtruth.txt").unlink()


@pytest.mark.parametrize(
    ("damage", "more", "message"),
    [
        (small, [], "right: expected the shape of color"),
        (blank, [], "expected a head with a disparity between near and far"),
        (blank, [], "--set near=METERS and --set far=METERS change the range of the search"),
        (shortened, [], "expected as many color as right images"),
        (untrue, ["--box", "500,500,20,20"], "expected a part inside the image of 160x120 pixels"),
        (untrue, ["--detect", "person"], "--detect person: stereo-head doesn't look for people"),
        (untrue, ["--set", "near=7"], "near: expected under far, 6 m, got 7"),
    ],
)
def test_errors_in_a_line(
    folder: Path, capsys: pytest.CaptureFixture[str], damage: object, more: list[str], message: str
) -> None:
    """It proves that what is wrong with pairs and options is one line on stderr, and exit code 2."""
    assert callable(damage)
    damage(folder)
    assert main([*calibrated(folder), *more]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_a_swapped_pair_is_noticed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that left and right taken for each other are warned of in a line."""
    (folder / "left").rename(folder / "other")
    (folder / "right").rename(folder / "left")
    (folder / "other").rename(folder / "right")
    main(calibrated(folder))
    assert "tricue track: warning: right: left and right seem to be swapped" in capsys.readouterr().err
