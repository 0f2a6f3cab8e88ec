# SPDX-License-Identifier: MIT
"""What ``tricue track`` says and does about cameras, with the trackers themselves."""

import json
import shutil
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame, Intrinsics, StereoRig
from tricue.camera.box import Box
from tricue.cli import main
from tricue.cli.calibrations import find_calibration
from tricue.data.open_source import open_source
from tricue.track.base.registry import names

FRAMES = 4
PAIR, RGBD = ("fused", "flow-depth", "stereo-head"), ("fused", "flow-depth", "depth-particle")
MM = ("--depth-scale", "0.001")


def written(folder: Path, frames: Sequence[Frame], box: Box) -> Path:
    """The frames as folders of images, and the first true box."""
    images = {"left": "color", "right": "right"} if frames[0].right is not None else {"color": "color"}
    for index, frame in enumerate(frames):
        for name, channel in images.items():
            save(folder / name / f"{index}.png", getattr(frame, channel))
        if frame.depth is not None:
            save(folder / "depth" / f"{index}.png", np.nan_to_num(1000 * frame.depth).astype(np.uint16))
    (folder / "groundtruth.txt").write_text(",".join(map(str, box)))
    return folder


def save(path: Path, image: NDArray[Any]) -> None:
    """One image, in a folder that is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), image)


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A head before two cameras that nothing describes."""
    pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    from tricue.scenes import head

    scene = head(seed=3, frames=FRAMES)
    return written(tmp_path_factory.mktemp("data") / "pair", scene.frames, scene.boxes[0])


@pytest.fixture(scope="module")
def rgbd(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A walker before a depth camera that nothing describes."""
    pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    from tricue.scenes import overtaking

    scene = overtaking(0, FRAMES, depth=True)
    return written(tmp_path_factory.mktemp("data") / "rgbd", scene.frames, scene.boxes[0])


def tracked(folder: Path, *options: str) -> dict[str, Any]:
    """What a run on the folder writes as JSON."""
    path = folder.parent / "o.json"
    assert main(["track", str(folder), *options, "--json", str(path)]) == 0
    content: dict[str, Any] = json.loads(path.read_text())
    return content


def has_positions(content: dict[str, Any]) -> bool:
    """Whether the last track has one."""
    return content["tracks"][-1]["Z_m"] is not None


def test_every_tracker_in_meters_is_tried_below() -> None:
    """It proves that a new tracker doesn't come without a look at what it does without a calibration."""
    assert {*PAIR, *RGBD, "color-particle"} == set(names())


@pytest.mark.filterwarnings("default")  # they are to be printed
@pytest.mark.parametrize("tracker", PAIR)
def test_what_an_unknown_pair_costs_is_true(
    pair: Path, tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the warning says that positions are missing, and what to give."""
    content = tracked(pair, "--tracker", tracker)
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert error.startswith("tricue track: warning: the stereo pair's calibration isn't known; ")
    assert not has_positions(content)
    assert "tracks will have no position in meters" in error
    assert "--assume-fov" in error
    assert "give --calibration FILE" in error
    assert content["intrinsics"] is None
    assert content["baseline"] is None


@pytest.mark.filterwarnings("default")  # they are to be printed
@pytest.mark.parametrize("tracker", RGBD)
def test_what_an_unknown_depth_camera_costs_is_true(
    rgbd: Path, tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the lack of positions is said at the end, and that the measured depth is there."""
    content = tracked(rgbd, "--tracker", tracker, *MM)
    printed = capsys.readouterr()
    assert not has_positions(content)
    assert not printed.err
    assert "intrinsics aren't known; tracks have no position in meters; give --calib" in printed.out
    assert content["tracks"][-1]["depth_m"] is not None


@pytest.mark.parametrize("tracker", RGBD)
def test_assumed_meters_say_so(rgbd: Path, tracker: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --assume-fov gives the positions of --fov, under names that say so."""
    assumed = tracked(rgbd, "--tracker", tracker, *MM, "--assume-fov", "60")
    assert "assumed, by --assume-fov" in capsys.readouterr().out
    known = tracked(rgbd, "--tracker", tracker, *MM, "--fov", "60")
    assert (assumed["intrinsics_assumed"], "intrinsics_assumed" in known) == (True, False)
    for mine, theirs in zip(assumed["tracks"], known["tracks"], strict=True):
        assert "X_m" not in mine
        assert mine["X_m_assumed"] == theirs["X_m"]
        assert mine["depth_m"] == theirs["depth_m"]


def test_an_assumed_camera_says_what_it_replaces(
    rgbd: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a calibration beside the images isn't left out without a word."""
    place = shutil.copytree(rgbd, tmp_path / "known")
    file = place / "intrinsics.toml"
    file.write_text("fx = 500.0\nfy = 500.0\ncx = 80.0\ncy = 60.0\n")
    tracked(place, *MM, "--assume-fov", "60")
    assert f"by --assume-fov, instead of the calibration that is there: {file}" in capsys.readouterr().out


@pytest.mark.parametrize("tracker", PAIR)
def test_an_assumed_pair(pair: Path, tracker: str) -> None:
    """It proves that a pair is assumed by its angles, and that it is said."""
    content = tracked(pair, "--tracker", tracker, "--assume-fov", "60")
    assert (content["intrinsics_assumed"], content["baseline"]) == (True, 0.12)
    assert content["tracks"][-1]["Z_m_assumed"] is not None


def test_color_particle_assumes_nothing(rgbd: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a tracker without a camera refuses one."""
    box = (rgbd / "groundtruth.txt").read_text()
    words = [
        "track",
        str(rgbd / "color"),
        "--tracker",
        "color-particle",
        f"--box={box}",
        "--assume-fov",
        "60",
    ]
    assert main(words) == 2
    assert "--assume-fov: color-particle takes no camera; leave it out" in capsys.readouterr().err


@pytest.mark.parametrize("tracker", ["fused", "flow-depth", "color-particle"])
def test_color_alone_needs_no_camera(rgbd: Path, tracker: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that nothing is said about positions where no tracker could tell any."""
    more = ["--set", "cues=flow"] if tracker == "flow-depth" else []
    box = (rgbd / "groundtruth.txt").read_text()
    assert not has_positions(tracked(rgbd / "color", "--tracker", tracker, f"--box={box}", *more))
    printed = capsys.readouterr()
    assert "position" not in printed.out + printed.err


def test_a_file_is_for_the_images_that_a_recording_rectifies(pair: Path, tmp_path: Path) -> None:
    """Another focal length than theirs is refused, as meters would be wrong; another baseline is taken."""
    own = StereoRig(Intrinsics(150.0, 150.0, 80.0, 60.0, 160, 120), 0.1)
    source = replace(open_source(pair), camera=own, rectify=lambda left, right: (left, right))
    file = tmp_path / "rig.toml"
    options = Namespace(
        tracker="stereo-head", calibration=file, fov=None, rectify=False, unit=None, assume_fov=None
    )
    file.write_text("fx = 150\nfy = 150\ncx = 80\ncy = 60\nbaseline = 0.2\n")
    found = find_calibration(options, source).rig
    assert found is not None
    assert found.baseline == 0.2
    file.write_text("fx = 200\nfy = 200\ncx = 80\ncy = 60\nbaseline = 0.1\n")
    with pytest.raises(ValueError, match=r"expected a focal length of 150 px, .* got 200; give"):
        find_calibration(options, source)


def raw_cameras(path: Path, size: tuple[int, int] = (160, 120)) -> Path:
    """Raw cameras of a stereo pair, whose lenses bend, as cv2.stereoCalibrate gives them."""
    camera = Intrinsics.from_fov(*size, 60.0).matrix
    bent = np.array([-0.1, 0.02, 0.0, 0.0, 0.0])
    values = {
        "M1": camera,
        "D1": bent,
        "M2": camera,
        "D2": bent,
        "R": np.eye(3),
        "T": np.array([-0.12, 0, 0]),
    }
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in {"image_width": size[0], "image_height": size[1], **values}.items():
        storage.write(name, value)
    storage.release()
    return path


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_raw_cameras_of_another_size_do_not_rectify(
    pair: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --rectify refuses a calibration for larger images in one line, and doesn't warn of
    distortion, which it takes out.
    """
    words = ["track", str(pair), "--tracker", "stereo-head", "--rectify", "--calibration"]
    assert main([*words, str(raw_cameras(tmp_path / "c.yml"))]) == 0
    assert "distortion" not in capsys.readouterr().err
    assert main([*words, str(raw_cameras(tmp_path / "raw640.yml", (640, 480)))]) == 2
    error = capsys.readouterr().err
    assert "raw640.yml: expected a calibration for images of 160x120 pixels, got one for 640x480" in error
    assert error.count("\n") == 1


CAMERA_INFO = """\
image_width: 160
image_height: 120
camera_name: 00b09d0100990bb2
camera_matrix:
  rows: 3
  cols: 3
  data: [140, 0, 79.5, 0, 140, 59.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.02, 0, 0, 0]}
"""


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_distortion_is_told_once(rgbd: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that ROS's camera_info is a calibration, and its lens' distortion is told in one line."""
    path = tmp_path / "c.yaml"
    path.write_text(CAMERA_INFO)
    content = tracked(rgbd, *MM, "--calibration", str(path))
    assert (content["intrinsics"]["fx"], content["intrinsics"]["cx"]) == (140, 79.5)
    assert has_positions(content)
    error = capsys.readouterr().err
    assert error == f"tricue track: warning: {path}: its lens' distortion isn't taken out\n"
    path.write_text(CAMERA_INFO.replace("-0.1, 0.02", "0, 0"))
    assert tracked(rgbd, *MM, "--calibration", str(path))["tracks"] == content["tracks"]
    assert not capsys.readouterr().err
    path.write_text(CAMERA_INFO.replace("160", "320"))
    assert main(["track", str(rgbd), *MM, "--calibration", str(path)]) == 2
    error = capsys.readouterr().err
    assert (
        "c.yaml: expected a calibration for the depth images of 160x120 pixels, got one for 320x120" in error
    )
    assert error.count("\n") == 1


DEPTH = Intrinsics(60.0, 60.0, 39.5, 29.5, 80, 60)
COLOR = Intrinsics(180.0, 180.0, 84.5, 54.5, 160, 120)  # of twice the pixels, longer, and off to the right
NEAR, WALL = 2000, 4000  # millimeters
PERSON = Box(34, 20, 10, 22)  # in the depth image, going right by a pixel a frame


def seen_by(camera: Intrinsics, shift: float) -> Box:
    """Where a camera sees the person, from the place of the depth camera."""
    corners = [
        camera.project(DEPTH.back_project(x - 0.5, y - 0.5, NEAR / 1000)) + 0.5
        for x, y in (
            (PERSON.x + shift, PERSON.y),
            (PERSON.x + PERSON.width + shift, PERSON.y + PERSON.height),
        )
    ]
    return Box.from_xyxy(*np.concatenate(corners).tolist())


@pytest.fixture
def two_cameras(tmp_path: Path) -> Path:
    """A person of texture before a wall of texture; a depth and a color camera of other intrinsics."""
    folder, rng = tmp_path / "two", np.random.default_rng(0)
    wall, shirt = (cv2.resize(rng.integers(0, 256, (30, 40, 3), np.uint8), (160, 120)) for _ in range(2))
    for index in range(6):
        color, depth = wall.copy(), np.full((60, 80), WALL, np.uint16)
        for image, camera, value in ((color, COLOR, shirt), (depth, DEPTH, NEAR)):
            x0, y0, x1, y1 = (round(at) for at in seen_by(camera, index).xyxy)
            image[y0:y1, x0:x1] = value if camera is DEPTH else value[: y1 - y0, : x1 - x0]
        save(folder / "color" / f"{index}.png", color)
        save(folder / "depth" / f"{index}.png", depth)
    lines = []
    for name, camera in (("depth", DEPTH), ("color", COLOR)):
        lines += [f"[{name}]", *(f"{key} = {getattr(camera, key)}" for key in ("fx", "fy", "cx", "cy"))]
    (folder / "intrinsics.toml").write_text("\n".join(lines))
    return folder


def box_option(box: Box) -> str:
    """The box to start on."""
    return f"--box={','.join(map(str, box))}"


@pytest.mark.parametrize("tracker", ["fused", "flow-depth"])
def test_depth_of_another_camera_comes_into_the_color_image(
    two_cameras: Path, tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a tracker of both gets depth where the color is: boxes are the color image's, and the
    person is at its true place in meters, by the color camera.
    """
    start = box_option(seen_by(COLOR, 0))
    content = tracked(two_cameras, "--tracker", tracker, *MM, start)
    assert "depth registered to color by both cameras' intrinsics" in capsys.readouterr().out
    assert content["intrinsics"]["fx"] == COLOR.fx
    assert content["intrinsics"]["width"] == COLOR.width
    last, true = content["tracks"][-1], seen_by(COLOR, 5)
    assert Box(*(last[key] for key in ("x", "y", "width", "height"))).iou(true) > 0.7
    x, y = true.center
    expected = COLOR.back_project(x - 0.5, y - 0.5, NEAR / 1000)
    assert [last[key] for key in ("X_m", "Y_m", "Z_m")] == pytest.approx(expected, abs=0.1)


def test_a_given_file_of_two_cameras_does_so_too(two_cameras: Path, tmp_path: Path) -> None:
    """It proves that --calibration is read as the file beside the images."""
    found = tracked(two_cameras, *MM, box_option(seen_by(COLOR, 0)))
    file = (two_cameras / "intrinsics.toml").rename(tmp_path / "c.toml")
    given = tracked(two_cameras, *MM, box_option(seen_by(COLOR, 0)), "--calibration", str(file))
    assert given["tracks"] == found["tracks"]


def test_a_depth_tracker_keeps_its_pixels(two_cameras: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a tracker of depth alone gets the depth camera's image and intrinsics as ever."""
    content = tracked(two_cameras, "--tracker", "depth-particle", *MM, box_option(PERSON))
    assert content["intrinsics"]["fx"] == DEPTH.fx
    assert content["tracks"][-1]["x"] == pytest.approx(PERSON.x + 5, abs=2)
    assert "registered to color" not in capsys.readouterr().out


def test_one_camera_has_nothing_to_bring(
    rgbd: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that where both tables tell the same camera, depth stays as it is."""
    numbers = "fx = 140.0\nfy = 140.0\ncx = 79.5\ncy = 59.5\n"
    two, one = tmp_path / "two.toml", tmp_path / "one.toml"
    two.write_text(f"[depth]\n{numbers}scale = 0.001\n[color]\n{numbers}")
    one.write_text(numbers)
    both = tracked(rgbd, *MM, "--calibration", str(two))
    assert "registered to color" not in capsys.readouterr().out
    assert tracked(rgbd, *MM, "--calibration", str(one))["tracks"] == both["tracks"]


def test_true_boxes_of_the_depth_image_go_with_it(two_cameras: Path) -> None:
    """It proves that where positions were measured in the depth, and boxes so count its pixels, the tracker
    starts in the color image where the person is.
    """
    boxes = [",".join(map(str, seen_by(DEPTH, shift))) for shift in range(6)]
    (two_cameras / "groundtruth.txt").write_text("\n".join(boxes))
    (two_cameras / "position_z_mm.txt").write_text("2000\n" * 6)
    channels = "".join(f"channels.{name}={name}/%d.png\n" for name in ("color", "depth"))
    (two_cameras / "sequence").write_text(f"name=two\nfps=4\nlength=6\n{channels}")
    first = tracked(two_cameras)["tracks"][0]
    assert [first[key] for key in ("x", "y", "width", "height")] == pytest.approx(tuple(seen_by(COLOR, 0)))


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_sizes_that_differ_are_advised_on(two_cameras: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that depth of another size without such a file is an error that says what helps."""
    (two_cameras / "intrinsics.toml").unlink()
    assert main(["track", str(two_cameras), *MM, box_option(seen_by(COLOR, 0))]) == 2
    error = capsys.readouterr().err
    assert "frame.depth: expected shape (120, 160), got (60, 80)" in error
    assert error.endswith(
        "pixels: --calibration FILE in TOML, with the tables depth and color, registers it\n"
    )
