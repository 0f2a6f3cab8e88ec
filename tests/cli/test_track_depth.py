# SPDX-License-Identifier: MIT
import json
import re
import warnings
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Intrinsics
from tricue.cli import main
from tricue.track.base import registry

from tests.cli.track_commands import read_csv

MM = ("--depth-scale", "0.001")
FOV = ("--fov", "60,45")


def color_images(folder: Path, count: int = 6) -> Path:
    """A folder of gray-blue images, larger than the depth images."""
    folder.mkdir(parents=True, exist_ok=True)
    for index in range(count):
        cv2.imwrite(str(folder / f"{index}.png"), np.full((120, 160, 3), (120, 90, 80), np.uint8))
    return folder


def toml(path: Path, size: str = "") -> Path:
    """A calibration."""
    path.write_text(f"fx = 70.0\nfy = 70.0\ncx = 39.5\ncy = 29.5\n{size}")
    return path


def test_a_depth_tracker_starts_by_itself(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that without a box the tracker starts on the first frame with somebody in it, and that table,
    JSON, video and plot have the position in meters that the angles of view give.
    """
    pytest.importorskip("matplotlib")
    out = {name: tmp_path / f"o.{name}" for name in ("csv", "json", "avi", "png")}
    files = ["--csv", out["csv"], "--json", out["json"], "--output", out["avi"], "--plot", out["png"]]
    command = ["track", str(recording), "--tracker", nearest_tracker, *MM, *FOV, *map(str, files)]
    assert main(command) == 0
    printed = capsys.readouterr().out
    assert "depth: 6 frames, 4 tracked, 0 occluded, 0 lost" in printed
    assert "started in frame 2" in printed
    assert all(f"wrote {path}" in printed for path in out.values())
    rows = read_csv(out["csv"])
    camera = Intrinsics.from_fov(80, 60, 60, 45)
    assert [row["frame"] for row in rows] == ["2", "3", "4", "5"]
    for row, left in zip(rows, (10, 18, 26, 34), strict=True):
        assert [float(row[key]) for key in ("x", "y", "width", "height")] == [left, 20, 10, 30]
        expected = camera.back_project(left + 4.5, 34.5, 2.0)
        assert [float(row[key]) for key in ("X_m", "Y_m", "Z_m")] == pytest.approx(expected, abs=1e-6)
    content = json.loads(out["json"].read_text())
    assert content["intrinsics"]["fx"] == pytest.approx(camera.fx)
    assert content["tracks"][0]["Z_m"] == 2.0
    capture = cv2.VideoCapture(str(out["avi"]))
    pictures = [picture for there, picture in iter(capture.read, (False, None)) if there]
    assert len(pictures) == 4
    assert pictures[0].shape == (480, 640, 3)  # the depth's, eight times
    assert cv2.imread(str(out["png"])) is not None


def test_a_given_box_comes_first(recording: Path, nearest_tracker: str, tmp_path: Path) -> None:
    """It proves that with --box the tracker starts on the first frame, there."""
    path = tmp_path / "o.csv"
    box = ["--box", "1,2,30,40", "--csv", str(path)]
    assert main(["track", str(recording), "--tracker", nearest_tracker, *MM, *box]) == 0
    first = read_csv(path)[0]
    assert [first[key] for key in ("frame", "x", "width", "X_m")] == ["0", "1.0", "30.0", ""]


def test_a_true_box_can_be_left_to_the_tracker(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a sequence starts on its first true box, and with --detect person by itself; the first
    box alone is no truth to measure against.
    """
    (recording / "groundtruth.txt").write_text("1,2,30,40\n")
    path = tmp_path / "o.csv"
    command = ["track", str(recording), "--tracker", nearest_tracker, *MM, "--csv", str(path)]
    for extra, frame, x in (([], "0", "1.0"), (["--detect", "person"], "2", "10.0")):
        assert main([*command, *extra]) == 0
        first = read_csv(path)[0]
        assert (first["frame"], first["x"]) == (frame, x)
        assert "against the true boxes" not in capsys.readouterr().out


def test_color_beside_depth_is_tracked_as_ever(recording: Path, drift_tracker: str, tmp_path: Path) -> None:
    """It proves that a color tracker runs on a recording with depth, and is drawn on the color images."""
    color_images(recording.parent / "color")
    path = tmp_path / "o.avi"
    command = ["track", str(recording.parent), *MM, "--tracker", drift_tracker, "--box", "1,2,30,40"]
    assert main([*command, "--output", str(path)]) == 0
    picture = cv2.VideoCapture(str(path)).read()[1]
    assert picture.shape == (480, 640, 3)  # the color's, four times
    assert np.median(picture, axis=(0, 1)) == pytest.approx((120, 90, 80), abs=3)


def test_a_calibration_is_found_and_named(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that intrinsics.toml above the images is used and said so, --calibration goes before it, and
    --depth gives a color folder its depth.
    """
    found = toml(recording.parent / "intrinsics.toml")
    color = color_images(recording.parent / "color")
    path = tmp_path / "o.json"
    command = ["track", str(color), "--depth", str(recording), *MM, "--tracker", nearest_tracker]
    assert main([*command, "--json", str(path)]) == 0
    assert f"calibration found: {found}" in capsys.readouterr().out
    camera = {"fx": 70.0, "fy": 70.0, "cx": 39.5, "cy": 29.5, "width": 80, "height": 60}  # the depth's size
    assert json.loads(path.read_text())["intrinsics"] == camera
    other = toml(tmp_path / "other.toml")
    other.write_text(other.read_text().replace("fx = 70", "fx = 77"))
    assert main([*command, "--json", str(path), "--calibration", str(other)]) == 0
    assert "calibration found" not in capsys.readouterr().out
    assert json.loads(path.read_text())["intrinsics"]["fx"] == 77.0


def test_a_found_calibration_of_another_size_is_left_out(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a calibration that nobody asked for, of another size than the depth images, isn't used,
    which is said, and that a plot without positions isn't written, which is said too.
    """
    pytest.importorskip("matplotlib")
    toml(recording / "intrinsics.toml", "width = 640\nheight = 480\n")
    path = tmp_path / "o.png"
    assert main(["track", str(recording), *MM, "--tracker", nearest_tracker, "--plot", str(path)]) == 0
    printed = capsys.readouterr().out
    assert re.search(
        r"left out the calibration .*intrinsics.toml: .* 80x60 pixels, got one for 640x480", printed
    )
    assert f"{path}: not written, no track has a position in meters; --csv has it in pixels\n" in printed


def test_the_plot_of_an_earlier_run_is_not_taken_for_this_one(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that it is removed where there are no positions, and that this is said."""
    pytest.importorskip("matplotlib")
    path = tmp_path / "o.png"
    path.write_bytes(b"earlier")
    assert main(["track", str(recording), *MM, "--tracker", nearest_tracker, "--plot", str(path)]) == 0
    assert "no track has a position in meters; removed that of an earlier run" in capsys.readouterr().out
    assert not path.exists()
    assert not path.exists()


def test_a_wrong_unit_warns_once(
    recording: Path, nearest_tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that depth that looks like millimeters is one line of warning, not one a frame."""
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        assert (
            main(
                [
                    "track",
                    str(recording),
                    "--depth-scale",
                    "1",
                    "--box",
                    "1,2,8,9",
                    "--tracker",
                    nearest_tracker,
                ]
            )
            == 0
        )
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert error.startswith("tricue track: warning: depth: its median is about 4000 m")


def test_the_frame_rate_of_images_can_be_given(recording: Path, nearest_tracker: str, tmp_path: Path) -> None:
    """It proves that --fps sets the seconds in table and JSON, and the frame rate of the video."""
    out = {name: tmp_path / f"o.{name}" for name in ("csv", "json", "avi")}
    files = ["--csv", out["csv"], "--json", out["json"], "--output", out["avi"]]
    command = ["track", str(recording), "--tracker", nearest_tracker, *MM, "--box", "1,2,8,9", "--fps", "8"]
    assert main([*command, *map(str, files)]) == 0
    assert [float(row["time_s"]) for row in read_csv(out["csv"])] == [index / 8 for index in range(6)]
    assert json.loads(out["json"].read_text())["fps"] == 8.0
    assert cv2.VideoCapture(str(out["avi"])).get(cv2.CAP_PROP_FPS) == pytest.approx(8.0)


BAD = [
    (["{depth}"], "{depth}: expected --depth-scale, the meters per unit of these 16-bit images"),
    (
        ["{color}"],
        "frame: expected the channel depth, .*, got color; give its depth images with --depth FOLDER",
    ),
    (["{root}"], "frame: expected the channel depth.*; left out {depth}: --depth-scale"),
    (["{color}", "--depth", "{nobody}", *MM], "color: expected as many .*, got 6 color and 2 depth"),
    (["{color}", "--depth", "{color}", *MM], "{color}/0.png: expected depth, 16 bits .* not meters"),
    (
        ["{nobody}", *MM],
        "nobody: the tracker started in none of 2 frames: box: found nobody in this frame; give --box",
    ),
    (["{depth}", *MM, "--detect", "face"], "--detect face: expected color images"),
    (["{depth}", *MM, "--calibration", "{toml}"], "{toml}: .* of 80x60 pixels, got one for 8x6"),
    (["{depth}", *MM, "--calibration", "no.yml"], "no.yml: No such file or directory"),
    (["{depth}", *MM, "--fov", "190"], "--fov: expected degrees above 0 and below 180, got 190.0"),
    (["{depth}", *MM, "--fov", "60,0"], "--fov: expected degrees above 0 and below 180, got 0.0"),
    (["{depth}", *MM, "--fov", "60,45,30"], "argument --fov: expected one angle or two, .* got '60,45,30'"),
    (["{depth}", *MM, *FOV, "--calibration", "{toml}"], "argument --calibration: not allowed with"),
    (["{depth}", *MM, "--fps", "0"], "--fps: expected frames per second above 0, got 0.0"),
    (["{depth}", *MM, "--fps", "fast"], "argument --fps: invalid float value: 'fast'"),
    (["{depth}", "--depth-scale", "mm"], "argument --depth-scale: invalid float value: 'mm'"),
    (["{depth}", "--depth-scale", "-1"], "--depth-scale: expected meters per unit above 0, got -1.0"),
    (["{depth}", *MM, "--plot", "o.txt"], "o.txt: expected a picture's name that ends in .png"),
    (["{depth}", *MM, *FOV, "--plot", "{toml}"], ".*toml: expected a picture's name"),
    (
        ["{depth}", *MM, "--calibration", "{good}", "--json", "{good}"],
        ".* a file to write to that isn't read",
    ),
    (
        ["{depth}", *MM, "--tracker", "color-particle"],
        "frame: .* channel color, .*; --tracker depth-particle tracks",
    ),
    (["{color}", "--tracker", "drift", *FOV], "--fov: drift takes no camera's intrinsics; leave it out"),
    (
        ["{color}", "--tracker", "drift", "--detect", "person"],
        "--detect person: drift doesn't look for people",
    ),
]


@pytest.mark.usefixtures("drift_tracker")
@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_depth_is_one_line(
    recording: Path,
    nearest_tracker: str,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    message: str,
) -> None:
    """It proves that each mistake about depth is one line that says what is wrong and what to give."""
    pytest.importorskip("matplotlib")
    nobody = recording.parents[1] / "nobody"
    nobody.mkdir()
    for index in range(2):
        (nobody / f"{index}.png").write_bytes((recording / f"{index}.png").read_bytes())
    places = {
        "depth": recording,
        "root": recording.parent,
        "color": color_images(recording.parent / "color"),
        "nobody": nobody,
        "toml": toml(recording.parents[1] / "c.toml", "width = 8\nheight = 6\n"),
        "good": toml(recording.parents[1] / "good.toml"),
    }
    words = [word.format(**places) for word in arguments]
    words = words if "--tracker" in words else [*words, "--tracker", nearest_tracker]
    try:
        code = main(["track", *words])
    except SystemExit as stop:  # argparse's own way out
        code = int(str(stop.code))
    error = capsys.readouterr().err
    assert code == 2
    assert error.count("\n") == 1
    assert re.match(f"tricue track: {message.format(**places)}", error), error


def test_real_depth_from_the_command_line(
    data: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a real RGB-D sequence is followed with the calibration of its depth camera."""
    path = tmp_path / "o.json"
    folder = data / "rgbd" / "walk-away"
    assert main(["track", str(folder), "--tracker", nearest_tracker, "--json", str(path)]) == 0
    assert "calibration found" in capsys.readouterr().out
    content = json.loads(path.read_text())
    assert content["fps"] == 4.0
    assert content["intrinsics"]["fx"] == 567.9
    assert len(content["tracks"]) == 34
    assert content["tracks"][0]["x"] == 0.0  # the first true box's


@pytest.mark.filterwarnings("default")  # that there is no calibration is no matter here
@pytest.mark.parametrize(
    ("more", "chosen"),
    [
        ((), "depth-particle"),
        (("--detect", "person"), "depth-particle"),
        (("--box", "10,20,10,30"), "fused"),
    ],
)
def test_the_default_tracker_can_start(
    recording: Path,
    nearest_tracker: str,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    more: tuple[str, ...],
    chosen: str,
) -> None:
    """It proves that where no tracker is chosen it is "fused" from a box on, but in depth without one that
    which finds people.
    """
    monkeypatch.setitem(registry._BUILT_IN, "fused", registry._BUILT_IN[nearest_tracker])
    assert main(["track", str(recording), *MM, *more, "--json", str(tmp_path / "o.json")]) == 0
    assert json.loads((tmp_path / "o.json").read_text())["tracker"] == chosen
