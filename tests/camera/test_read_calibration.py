# SPDX-License-Identifier: MIT
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Intrinsics, Pose
from tricue.camera.read_calibration import read_intrinsics, read_registration, read_rig
from tricue.camera.rectification import Rectification

SIZE = (640, 480)
CAMERA = Intrinsics(500.0, 510.0, 320.0, 240.0, *SIZE)


def toml(path: Path, text: str = "", focal: float = 500.0) -> Path:
    """The camera's four numbers in TOML, before or after other lines."""
    path.write_text(f"{text}fx = {focal}\nfy = 510.0\ncx = 320.0\ncy = 240.0\n")
    return path


def opencv(path: Path, size: tuple[int, int] | None = None) -> Path:
    """The camera as cv2.FileStorage writes it."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    storage.write("camera_matrix", CAMERA.matrix)
    if size:
        storage.write("image_width", size[0])
        storage.write("image_height", size[1])
    storage.release()
    return path


def kitti(path: Path) -> Path:
    """The camera as P2 of a KITTI calibration."""
    numbers = " ".join(map(str, np.column_stack([CAMERA.matrix, np.zeros(3)]).ravel()))
    path.write_text(f"P0: {numbers}\nP2: {numbers}\n")
    return path


def test_every_format_is_known(tmp_path: Path) -> None:
    """It proves that TOML, OpenCV's three and KITTI's file give the same camera, of the images' size."""
    names = ("c.yml", "c.yaml", "c.xml", "c.json")
    files = [opencv(tmp_path / name) for name in names]
    files += [toml(tmp_path / "c.toml"), kitti(tmp_path / "calib.txt")]
    files.append(opencv(tmp_path / "d.yml").rename(tmp_path / "yaml.txt"))  # known by what is in it
    for path in files:
        assert read_intrinsics(path, SIZE, "depth") == CAMERA, path


def test_a_path_may_be_text(tmp_path: Path) -> None:
    """It proves that a calibration is read by its path or by the path's text."""
    path = toml(tmp_path / "c.toml", "width = 640\nheight = 480\nbaseline = 0.1\n")
    assert read_intrinsics(str(path), SIZE, "depth") == CAMERA
    assert read_rig(str(path), SIZE) == read_rig(path, SIZE)
    assert read_registration(str(path), SIZE, SIZE) is None


def test_blanks_of_kittis_file(tmp_path: Path) -> None:
    """It proves that tabs part its numbers as well, and that its lines may be indented or hold nothing."""
    path = kitti(tmp_path / "calib.txt")
    path.write_text(
        "".join(f"  {line}\n" for line in path.read_text().replace(" ", "\t").splitlines()) + " :\n"
    )
    assert read_intrinsics(path, SIZE, "depth") == CAMERA


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path, encoding: str) -> None:
    """It proves that a file of any text format is known as before once Windows' editor or PowerShell has
    written it, also by its first line.
    """
    files = [opencv(tmp_path / "d.yml").rename(tmp_path / "yaml.txt"), kitti(tmp_path / "calib.txt")]
    files[1].write_text(files[1].read_text().partition("\n")[2])
    files += [opencv(tmp_path / "d.yml"), opencv(tmp_path / "d.xml"), opencv(tmp_path / "d.json")]
    files += [toml(tmp_path / "c.toml", "width = 640\nheight = 480\n")]
    for path in files:
        path.write_text(path.read_text(), encoding=encoding)
        assert read_intrinsics(path, SIZE, "depth") == CAMERA, path


def test_ros_file_is_known(tmp_path: Path) -> None:
    """It proves that a camera_info is read, with one warning of its lens, for images of its size alone."""
    path, numbers = tmp_path / "c.yaml", ", ".join(map(str, CAMERA.matrix.ravel()))
    path.write_text(
        "image_width: 640\nimage_height: 480\ncamera_name: head\n"
        f"camera_matrix:\n  rows: 3\n  cols: 3\n  data: [{numbers}]\n"
        "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, 0, 0, 0, 0]\n"
    )
    with pytest.warns(UserWarning, match="its lens' distortion isn't taken out") as told:
        assert read_intrinsics(path, SIZE, "color") == CAMERA
    assert len(told) == 1
    with pytest.raises(ValueError, match="the color images of 320x240 pixels, got one for 640x480"):
        read_intrinsics(path, (320, 240), "color")


def test_a_rig_of_another_size_is_refused(tmp_path: Path) -> None:
    """It proves that the size in a rig's file, of any format, is checked against the images'."""
    path = toml(tmp_path / "c.toml", "width = 640\nheight = 480\nbaseline = 0.1\n")
    assert read_rig(path, SIZE).intrinsics == CAMERA
    with pytest.raises(ValueError, match="the color images of 320x240 pixels, got one for 640x480"):
        read_rig(path, (320, 240))


def test_the_channel_chooses_the_table(tmp_path: Path) -> None:
    """It proves that of a file's tables the one of the channel is read, and an only one whatever its name."""
    color, depth = (toml(tmp_path / name).read_text() for name in ("a.toml", "b.toml"))
    both = tmp_path / "both.toml"
    both.write_text(f"[color]\n{color}[depth]\n{depth.replace('fx = 500.0', 'fx = 567.9')}")
    assert read_intrinsics(both, SIZE, "depth").fx == 567.9
    assert read_intrinsics(both, SIZE, "color").fx == 500.0
    assert read_intrinsics(toml(tmp_path / "o.toml", "[color]\n"), SIZE, "depth").fx == 500.0


@pytest.mark.parametrize("suffix", ["toml", "yml"])
def test_another_size_is_refused(tmp_path: Path, suffix: str) -> None:
    """It proves that a file that says it is for images of another size is an error that names both sizes."""
    path = tmp_path / f"c.{suffix}"
    if suffix == "toml":
        toml(path, "width = 320\nheight = 240\n")
    else:
        opencv(path, (320, 240))
    assert read_intrinsics(path, (320, 240), "depth").width == 320
    with pytest.raises(
        ValueError, match=r"expected .* the depth images of 640x480 pixels, got one for 320x240"
    ):
        read_intrinsics(path, SIZE, "depth")


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("c.toml", "fx = 500\n", "c.toml: expected the key fy"),
        ("c.toml", "fx = -1\nfy = 1\ncx = 1\ncy = 1\n", "c.toml: fx: expected pixels above 0"),
        ("c.toml", "fx = '5'\nfy = 1\ncx = 1\ncy = 1\n", "c.toml: fx: expected a number, pixels, got '5'"),
        ("c.toml", "fx 500", "c.toml: expected a TOML file"),
        ("c.yml", "fx: 500\n", "c.yml: expected"),
        ("c.txt", "500 500 320 240\n", r"c.txt: expected a calibration by OpenCV .*, KITTI .* or in \.toml"),
        ("c.bin", "", "c.bin: expected a calibration by OpenCV"),
    ],
)
def test_bad_files_are_named(tmp_path: Path, name: str, text: str, message: str) -> None:
    """It proves that a file that holds no camera is an error with its name."""
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=message):
        read_intrinsics(tmp_path / name, SIZE, "depth")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    """It proves that a file that isn't there is an OSError, whatever its suffix."""
    for name in ("no.toml", "no.yml", "no.txt"):
        with pytest.raises(FileNotFoundError, match=name):
            read_intrinsics(tmp_path / name, SIZE, "depth")


def test_a_princeton_file_without_its_matrix_is_named(tmp_path: Path) -> None:
    """It proves that a frames.mat that is none, is cut off or lacks K is an error that names it."""
    io = pytest.importorskip("scipy.io")
    whole, other, text, wide = (tmp_path / name for name in ("w.mat", "o.mat", "t.mat", "v.mat"))
    io.savemat(whole, {"frames": {"K": CAMERA.matrix}}, do_compression=True)
    io.savemat(other, {"frames": {"length": 3.0}})
    io.savemat(wide, {"frames": {"K": np.ones((2, 2))}})
    text.write_text("K = eye(3)")
    assert read_intrinsics(whole, SIZE, "depth").fx == CAMERA.fx
    whole.write_bytes(whole.read_bytes()[:-20])
    for path in (whole, other, text):
        with pytest.raises(ValueError, match=f"{path}: expected MATLAB's file of a struct frames"):
            read_intrinsics(path, SIZE, "depth")
    with pytest.raises(FileNotFoundError, match=r"nowhere\.mat"):
        read_intrinsics(tmp_path / "nowhere.mat", SIZE, "depth")
    with pytest.raises(ValueError, match=r"v.mat: expected a camera matrix \(3, 3\)"):
        read_intrinsics(wide, SIZE, "depth")


def test_a_princeton_file_needs_scipy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that without SciPy the error says what to install."""
    monkeypatch.setitem(sys.modules, "scipy.io", None)
    with pytest.raises(ValueError, match=r"frames\.mat: it takes SciPy to read it, pip install scipy"):
        read_intrinsics(tmp_path / "frames.mat", SIZE, "depth")


def test_two_cameras_are_a_registration(tmp_path: Path) -> None:
    """It proves that the tables of a depth and a color camera tell how depth comes into the color image, each
    for its own size; the same camera twice, one camera and other formats tell that there is nothing to do.
    """
    depth, color = "[depth]\nscale = 0.001\n", "[color]\n"
    path = toml(tmp_path / "c.toml", depth, 567.9)
    assert read_registration(path, (720, 540), SIZE) is None
    path.write_text(path.read_text() + toml(tmp_path / "d.toml", color).read_text())
    found = read_registration(path, (720, 540), SIZE)
    assert found is not None
    assert found.depth == Intrinsics(567.9, 510.0, 320.0, 240.0, 720, 540)
    assert found.color == CAMERA
    path.write_text(path.read_text().replace("567.9", "500.0"))
    assert read_registration(path, SIZE, SIZE) is None
    assert read_registration(kitti(tmp_path / "calib.txt"), SIZE, SIZE) is None


def test_a_registration_keeps_the_depth_cameras_pose(tmp_path: Path) -> None:
    """It proves that positions in color's frame have a place in the world if only [depth] tells."""
    pose = f"translation = [0, 0, 1.6]\nrotation = {np.eye(3).tolist()}\n"
    path = toml(tmp_path / "c.toml", f"[depth]\n{pose}", 567.9)
    path.write_text(path.read_text() + toml(tmp_path / "d.toml", "[color]\n").read_text())
    found = read_registration(path, (720, 540), SIZE)
    assert found is not None
    assert found.color.pose == Pose(np.eye(3), (0, 0, 1.6))


def test_a_registration_of_another_size_is_refused(tmp_path: Path) -> None:
    """It proves that the color camera's size is checked against the color images."""
    path = tmp_path / "c.toml"
    tables = [toml(path, f"[{name}]\n").read_text() for name in ("depth", "color")]
    path.write_text("".join(tables) + "width = 1280\nheight = 960\n")
    with pytest.raises(ValueError, match="expected a calibration for the color images of 640x480"):
        read_registration(path, SIZE, SIZE)


def test_a_file_without_a_size_must_suit_the_images(tmp_path: Path) -> None:
    """It proves that a principal point outside the images is an error in every format that may lack their
    size, that one which suggests images of another size gives a note, and that the size in the file decides.
    """
    files = [opencv(tmp_path / "c.yml"), toml(tmp_path / "c.toml"), kitti(tmp_path / "calib.txt")]
    for path in files:
        outside = r"principal point \(320, 240\) is outside the images of 320x240 pixels"
        with pytest.raises(ValueError, match=f"{path}: its {outside}"):
            read_intrinsics(path, (320, 240), "depth")
        with pytest.warns(
            UserWarning, match=f"{path}: .* suggests images of about 640x480 pixels, not 1280x960"
        ):
            read_intrinsics(path, (1280, 960), "depth")
        assert read_intrinsics(path, (640, 360), "depth").height == 360  # cropped
    sized = toml(tmp_path / "corner.toml", "width = 320\nheight = 240\n")
    assert read_intrinsics(sized, (320, 240), "depth").width == 320


def test_rectification_checks_the_raw_cameras(tmp_path: Path) -> None:
    """It proves that raw cameras without an image size are checked as well."""
    storage = cv2.FileStorage(str(tmp_path / "raw.yml"), cv2.FILE_STORAGE_WRITE)
    for number in (1, 2):
        storage.write(f"M{number}", CAMERA.matrix)
        storage.write(f"D{number}", np.zeros(5))
    storage.write("R", np.eye(3))
    storage.write("T", np.array([-0.12, 0.0, 0.0]))
    storage.release()
    Rectification.from_opencv(tmp_path / "raw.yml", size=SIZE)
    with pytest.raises(ValueError, match=r"raw.yml: its principal point \(320, 240\) is outside"):
        Rectification.from_opencv(tmp_path / "raw.yml", size=(320, 240))
