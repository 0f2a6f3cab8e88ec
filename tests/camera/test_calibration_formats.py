# SPDX-License-Identifier: MIT
import pickle
import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Intrinsics, StereoRig

SIZE = (640, 480)
LEFT = np.array([[500.0, 0, 320, 0], [0, 500, 240, 0], [0, 0, 1, 0]])
KITTI = (
    "P2: 700 0 600 45 0 700 170 0.2 0 0 1 0.003\nP3: 700 0 600 -333 0 700 170 2 0 0 1 0.003\nR_rect 1 0 0\n"
)
RAW = "calib_time: 09-Jan-2012 13:57:47\nS_rect_02: 1.242e+03 3.75e+02\n"
RAW += "P_rect_02: 700 0 600 45 0 700 170 0 0 0 1 0\n"

# As camera_calibration and camera_info_manager write them.
CAMERA_INFO = """\
image_width: 640
image_height: 480
camera_name: narrow_stereo/left
camera_matrix:
  rows: 3
  cols: 3
  data: [500.25,   0.  , 320.5 ,
           0.  , 501.  , 240.  ,
           0.  ,   0.  ,   1.  ]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.361976, 0.110510, 0.001014, -0.000505, 0.000000]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix: {rows: 3, cols: 4, data: [480, 0, 318.75, 0, 0, 481, 239, 0, 0, 0, 1, 0]}
"""
LENS = "-0.361976, 0.110510, 0.001014, -0.000505, 0.000000"
STRAIGHT = CAMERA_INFO.replace(LENS, "0, 0., 0.0, 0, 0")


def right(tx: float = -60.0, ty: float = 0.0, cx: float = 320.0) -> NDArray[np.float64]:
    """The right projection matrix of a rig; tx = -f b."""
    return np.array([[500.0, 0, cx, tx], [0, 500, 240, ty], [0, 0, 1, 0]])


def opencv_file(path: Path, **values: Any) -> Path:
    """A file as OpenCV writes it."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in values.items():
        storage.write(name, value)
    storage.release()
    return path


@pytest.mark.parametrize("suffix", ["yml", "xml", "json"])
def test_opencv_files_hold_a_camera(tmp_path: Path, suffix: str) -> None:
    """It proves that a camera matrix with its image size is read from all three of OpenCV's formats."""
    path = opencv_file(tmp_path / f"c.{suffix}", image_width=640, image_height=480, camera_matrix=LEFT[:, :3])
    assert Intrinsics.from_opencv(path) == Intrinsics(500, 500, 320, 240, 640, 480)


def test_the_rectified_camera_comes_first(tmp_path: Path) -> None:
    """It proves that of a stereo file the rectified P1 is taken, and any other matrix by its name."""
    path = opencv_file(tmp_path / "c.yml", M1=LEFT[:, :3] * [2, 2, 1], P1=LEFT)
    assert Intrinsics.from_opencv(path, size=SIZE).fx == 500
    assert Intrinsics.from_opencv(path, key="M1", size=SIZE).fx == 1000


def test_opencv_rig_in_millimeters(tmp_path: Path) -> None:
    """It proves that the baseline is -P2[0,3] / f, brought to meters by the board's unit."""
    path = opencv_file(tmp_path / "c.yml", P1=LEFT, P2=right(-500 * 62.5))
    assert StereoRig.from_opencv(path, unit=0.001, size=SIZE).baseline == pytest.approx(0.0625)


def test_a_rig_agrees_with_opencvs_rectification(tmp_path: Path) -> None:
    """It proves that depth by stereoRectify's P1 and P2 is what its Q matrix gives for a disparity."""
    matrix, turn = LEFT[:, :3], cv2.Rodrigues(np.array([0.01, -0.02, 0.005]))[0]
    shift = np.array([[-0.12], [0.002], [0.001]])
    _r1, _r2, p1, p2, q, *_ = cv2.stereoRectify(matrix, np.zeros(5), matrix, np.zeros(5), SIZE, turn, shift)
    rig = StereoRig.from_opencv(opencv_file(tmp_path / "c.yml", P1=p1, P2=p2, Q=q), size=SIZE)
    point = q @ [100.0, 50.0, 7.0, 1.0]
    assert rig.depth(7.0) == pytest.approx(point[2] / point[3])
    assert rig.intrinsics.back_project(100, 50, rig.depth(7.0)) == pytest.approx(point[:3] / point[3])


def test_kitti_tracking_files(tmp_path: Path) -> None:
    """It proves that P2 and P3 give the camera and the baseline, with and without colons after the keys."""
    for text in (KITTI, KITTI.replace(":", "")):
        (tmp_path / "calib.txt").write_text(text)
        rig = StereoRig.from_kitti(tmp_path / "calib.txt", size=(1242, 375))
        assert rig.intrinsics == Intrinsics(700, 700, 600, 170, 1242, 375)
        assert rig.baseline == pytest.approx((45 + 333) / 700)


def test_kitti_raw_files(tmp_path: Path) -> None:
    """It proves that raw files are read, dates left out, and the image's size taken from S_rect."""
    (tmp_path / "calib_cam_to_cam.txt").write_text(RAW)
    assert Intrinsics.from_kitti(tmp_path / "calib_cam_to_cam.txt") == Intrinsics(
        700, 700, 600, 170, 1242, 375
    )


def test_toml_tables(tmp_path: Path) -> None:
    """It proves that a camera is read from the top of a file, from its only table, or from a named one."""
    keys = "fx = 500\nfy = 501.5\ncx = 320\ncy = 240\n"
    path = tmp_path / "c.toml"
    expected = Intrinsics(500, 501.5, 320, 240, 640, 480)
    path.write_text(keys + "width = 640\nheight = 480\nbaseline = 0.12\n")
    assert Intrinsics.from_toml(path) == expected
    assert StereoRig.from_toml(path) == StereoRig(expected, 0.12)
    path.write_text("[depth]\n" + keys)
    assert Intrinsics.from_toml(path, size=SIZE) == expected
    path.write_text("[color]\n" + keys.replace("501.5", "7") + "[depth]\n" + keys)
    assert Intrinsics.from_toml(path, table="depth", size=SIZE) == expected


def test_real_files(data: Path) -> None:
    """It proves the readers on real files: KITTI's known baseline, OpenCV's Q matrix, a TOML table."""
    kitti = StereoRig.from_kitti(data / "stereo/kitti-tracking/calib/0005.txt", size=(1242, 375))
    assert kitti.baseline == pytest.approx(0.5327, abs=1e-4)
    board = data / "stereo/conveyor-box/calibration.yml"
    rig = StereoRig.from_opencv(board, unit=0.025, size=(640, 360))
    assert rig.baseline == pytest.approx(0.025 / 0.28079397682334289)  # Q[3, 2] = 1 / baseline
    depth = Intrinsics.from_toml(data / "rgbd/intrinsics.toml", table="depth", size=SIZE)
    assert (depth.fx, depth.cy) == (567.90, 242.57)


def opencv(**values: Any) -> Callable[[Path], Any]:
    """A case: these values in an OpenCV file, read as a rig."""
    return lambda folder: StereoRig.from_opencv(opencv_file(folder / "c.yml", **values), size=SIZE)


def text(content: str, read: Callable[..., Any], **options: Any) -> Callable[[Path], Any]:
    """A case: this text in a file, read by ``read``."""

    def case(folder: Path) -> Any:
        (folder / "c.txt").write_text(content)
        return read(folder / "c.txt", **options)

    return case


@pytest.mark.parametrize(
    ("read", "message"),
    [
        (opencv(M1=LEFT), "expected P1 and P2 of a rectified rig"),
        (opencv(P1=LEFT, P2=right(60.0)), "swap the two cameras"),
        (opencv(P1=LEFT, P2=right(0.0)), "expected two cameras apart"),
        (opencv(P1=LEFT, P2=right(0.0, -60.0)), "one above the other"),
        (opencv(P1=LEFT, P2=right(cx=330.0)), "CALIB_ZERO_DISPARITY"),
        (opencv(P1=LEFT[:, :3], P2=LEFT[:, :3]), r"expected projection matrices \(3, 4\)"),
        (opencv(P1=LEFT[:2], P2=LEFT), r"expected a camera matrix \(3, 3\) or \(3, 4\), got \(2, 4\)"),
        (opencv(P1=LEFT[:, :3].T, P2=LEFT), "expected a camera matrix fx 0 cx, .* is it transposed"),
        (opencv(P1=0 * LEFT, P2=right()), "fx: expected pixels above 0"),
        (lambda p: Intrinsics.from_opencv(opencv_file(p / "c.yml", P1=LEFT)), r"pass size=\(width, height\)"),
        (
            lambda p: Intrinsics.from_opencv(opencv_file(p / "c.yml", F=LEFT)),
            "named camera_matrix or .* found none",
        ),
        (
            lambda p: Intrinsics.from_opencv(opencv_file(p / "c.yml", P1=LEFT), key="M2"),
            "named M2, found none",
        ),
        (
            text("This is no calibration.\n", Intrinsics.from_opencv),
            "expected a file that cv2.FileStorage wrote, or ROS's camera_info",
        ),
        (
            text("%YAML:1.0\n---\nP1: [1, 2\n", Intrinsics.from_opencv),
            "expected a file that cv2.FileStorage wrote",
        ),
        (text("", Intrinsics.from_opencv), "expected a file that cv2.FileStorage wrote"),
        (
            text(STRAIGHT.replace("320.5 ,", ""), Intrinsics.from_opencv),
            "camera_matrix: .* as many numbers as",
        ),
        (
            text(STRAIGHT.replace("320.5", "wide"), Intrinsics.from_opencv),
            "camera_matrix: .* as many numbers",
        ),
        (
            text(STRAIGHT.replace("data: [500", "date: [500"), Intrinsics.from_opencv),
            "camera_matrix: expected a",
        ),
        (
            text(STRAIGHT.replace("rows: 3", "rows: -1", 1), Intrinsics.from_opencv),
            "camera_matrix: expected a",
        ),
        (
            text(STRAIGHT.replace("cols: 5", "cols: 6"), Intrinsics.from_opencv),
            "distortion_coefficients: expe",
        ),
        (
            text(STRAIGHT.replace("data: [0,", "data: [" + "0," * 65), Intrinsics.from_opencv),
            "distortion_coefficients: expected",
        ),
        (text(KITTI, Intrinsics.from_kitti), r"pass size=\(width, height\)"),
        (text(KITTI, Intrinsics.from_kitti, camera=1), "expected a line P1 or P_rect_01 with 12 numbers"),
        (text("P2: 1 2 3\n", Intrinsics.from_kitti), "expected a line P2 or P_rect_02 with 12 numbers"),
        (text("fx = = 3", Intrinsics.from_toml), "expected a TOML file"),
        (
            text("[a]\nfx=1\n[b]\nfx=2", Intrinsics.from_toml),
            "expected one camera, with the key fx, found it in several tables, 'a', 'b'; table= chooses one$",
        ),
        (text("[a]\nfx=1", Intrinsics.from_toml, table="b"), r"one of its tables \('a'\), got 'b'"),
        (text("width = 3", Intrinsics.from_toml, table="b"), r"none with the key fx\), got 'b'"),
        (text("width = 3", Intrinsics.from_toml), "expected one camera, with the key fx, found none$"),
        (text("", Intrinsics.from_toml), "expected one camera, with the key fx, found none$"),
        (text("fx = 3", Intrinsics.from_toml, size=SIZE), "expected the key fy"),
        (text("fx = 3\nfy = 3\ncx=320\ncy=240", StereoRig.from_toml, size=SIZE), "expected the key baseline"),
        (text("fx = 3\nfy = 3\ncx=1\ncy=1", StereoRig.from_toml), r"pass size=\(width, height\)"),
        (text("fx = -3\nfy = 3\ncx=1\ncy=1", Intrinsics.from_toml, size=SIZE), "fx: expected pixels above 0"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, read: Callable[[Path], Any], message: str) -> None:
    """It proves that each kind of unusable file is a ValueError with the file's name and the reason."""
    with pytest.raises(ValueError, match=rf"c\.\w+: .*{message}"):
        read(tmp_path)


SIZED = {
    "yml": Intrinsics.from_opencv,
    "txt": Intrinsics.from_kitti,
    "toml": Intrinsics.from_toml,
    "rig.yml": StereoRig.from_opencv,
    "rig.txt": StereoRig.from_kitti,
    "rig.toml": StereoRig.from_toml,
}


def sized_file(path: Path) -> Path:
    """A camera, or a rig, for images of 640x480 in a file of each format, named by its suffix."""
    if path.suffix == ".yml":
        return opencv_file(path, image_width=640, image_height=480, P1=LEFT, P2=right())
    if path.suffix == ".toml":
        path.write_text("fx = 500\nfy = 500\ncx = 320\ncy = 240\nwidth = 640\nheight = 480\nbaseline = 0.1\n")
    else:
        path.write_text(KITTI + "S_rect_02: 6.4e+02 4.8e+02\n")
    return path


@pytest.mark.parametrize("suffix", SIZED)
def test_a_size_other_than_the_files_is_refused(tmp_path: Path, suffix: str) -> None:
    """It proves that no given size replaces the file's, whose focal length would be wrong for it; the file's
    own may be given, as any sequence.
    """
    path, read = sized_file(tmp_path / f"c.{suffix}"), SIZED[suffix]
    assert read(path) == read(path, size=SIZE) == read(path, size=list(SIZE))
    with pytest.raises(
        ValueError, match=rf"c\.{suffix}: .* images of 320x240 pixels, got one for 640x480"
    ) as error:
        read(path, size=(320, 240))
    assert str(pickle.loads(pickle.dumps(error.value))) == str(error.value)


@pytest.mark.parametrize(
    ("size", "error", "expected"),
    [
        (640, TypeError, "(width, height), pixels, got 640"),
        ((480, 640, 3), ValueError, "(width, height), pixels, got (480, 640, 3)"),  # an image's shape
        ((640.5, 480), TypeError, "a whole number, pixels, got 640.5"),
        ((0, 480), ValueError, "pixels above 0, got 0"),
    ],
)
@pytest.mark.parametrize("suffix", SIZED)
def test_what_is_no_size_is_named(
    tmp_path: Path, suffix: str, size: Any, error: type[Exception], expected: str
) -> None:
    """It proves that the message blames the argument instead of the file."""
    path = sized_file(tmp_path / f"c.{suffix}")
    with pytest.raises(error, match=rf"^size: expected {re.escape(expected)}$"):
        SIZED[suffix](path, size=size)


def test_a_part_of_the_size_counts_too(tmp_path: Path) -> None:
    """It proves that a TOML file with the width alone takes the height that is given, and no other width."""
    path = tmp_path / "c.toml"
    path.write_text("fx = 500\nfy = 500\ncx = 320\ncy = 240\nwidth = 640\n")
    assert Intrinsics.from_toml(path, size=SIZE).height == 480
    with pytest.raises(ValueError, match="images of 320x480 pixels, got one for 640x480"):
        Intrinsics.from_toml(path, size=(320, 480))


BENT = np.array([-0.3, 0.1, 0.0, 0.0, 0.0])


@pytest.mark.parametrize(
    ("values", "key"),
    [
        ({"camera_matrix": LEFT[:, :3], "distortion_coefficients": BENT}, None),
        ({"cameraMatrix": LEFT[:, :3], "distCoeffs": BENT[:, None]}, None),
        ({"K": LEFT[:, :3], "D": BENT}, None),
        ({"M1": LEFT[:, :3], "D1": BENT, "D2": 0 * BENT}, None),
        ({"M1": LEFT[:, :3], "D1": 0 * BENT, "M2": LEFT[:, :3], "D2": BENT}, "M2"),
        ({"K1": LEFT[:, :3], "distCoeffs1": BENT}, None),
    ],
)
def test_distortion_is_told(tmp_path: Path, values: dict[str, Any], key: str | None) -> None:
    """It proves that a lens that bends is warned of, by the file's name, where the caller reads it."""
    path = opencv_file(tmp_path / "c.yml", **values)
    with pytest.warns(UserWarning, match=r"c\.yml: its lens' distortion isn't taken out") as told:
        assert Intrinsics.from_opencv(path, key=key, size=SIZE).fx == 500
    assert [each.filename for each in told] == [__file__]


def test_a_list_of_coefficients_is_told(tmp_path: Path) -> None:
    """It proves that coefficients that C++ wrote as a std::vector count as those in a matrix."""
    path = tmp_path / "c.json"
    numbers = [5, 0, 320, 0, 5, 240, 0, 0, 1]
    matrix = f'{{"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d", "data": {numbers}}}'
    path.write_text(f'{{"camera_matrix": {matrix}, "distCoeffs": [-0.3, 0.1, 0, 0]}}')
    with pytest.warns(UserWarning, match=r"c\.json: its lens' distortion isn't taken out"):
        Intrinsics.from_opencv(path, size=SIZE)


@pytest.mark.parametrize(
    "values",
    [
        {"camera_matrix": LEFT[:, :3], "distortion_coefficients": 0 * BENT},
        {"camera_matrix": LEFT[:, :3]},
        {"P1": LEFT, "M1": 2 * LEFT[:, :3], "D1": BENT, "P2": right()},
    ],
)
def test_where_no_lens_bends_nothing_is_told(tmp_path: Path, values: dict[str, Any]) -> None:
    """It proves that zeros, no coefficients, and those of the raw cameras of a rectified pair don't warn."""
    path = opencv_file(tmp_path / "c.yml", **values)
    assert Intrinsics.from_opencv(path, size=SIZE).fx == 500
    if "P2" in values:
        assert StereoRig.from_opencv(path, size=SIZE).intrinsics.fx == 500


@pytest.mark.parametrize(("skew", "told"), [(20.0, True), (-3.0, True), (0.9, False)])
def test_skew_is_told(tmp_path: Path, skew: float, told: bool) -> None:
    """It proves that skew that moves the image's border over half a pixel is warned of, and by how much."""
    matrix = LEFT.copy()
    matrix[0, 1] = skew
    path = opencv_file(tmp_path / "c.yml", camera_matrix=matrix[:, :3])
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        assert Intrinsics.from_opencv(path, size=SIZE).fx == 500
    expected = f"{path}: its skew of {skew:.3g} px, up to {abs(skew) * 240 / 500:.2g} px, isn't taken out"
    assert [(str(each.message), each.filename) for each in found] == [(expected, __file__)] * told


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text,
        lambda text: text.replace("narrow_stereo/left", "00b09d0100990bb2"),  # a FireWire camera's number
        lambda text: text.replace("camera_name: narrow_stereo/left", "camera_name:"),
        lambda text: f"# Saved by hand\n---\n{text}",
        lambda text: f"\ufeff{text}",
        lambda text: text.replace("\n", "\r\n"),
        lambda text: f"%YAML:1.0\n---\n{text}",
        lambda text: text.replace("cols: 5", "cols: 0").replace("0, 0., 0.0, 0, 0", ""),
    ],
)
def test_ros_camera_info_is_read(tmp_path: Path, change: Callable[[str], str]) -> None:
    """It proves that ROS's file gives its camera matrix and size, and by name the one of rectified images,
    whatever the camera is called.
    """
    path = tmp_path / "c.yaml"
    path.write_text(change(STRAIGHT), encoding="utf-8", newline="")
    assert Intrinsics.from_opencv(path) == Intrinsics(500.25, 501, 320.5, 240, 640, 480)
    rectified = Intrinsics.from_opencv(path, key="projection_matrix")
    assert rectified == Intrinsics(480, 481, 318.75, 239, 640, 480)


def test_a_rig_is_read_from_ros_right_camera(tmp_path: Path) -> None:
    """It proves that the right camera's projection gives camera and baseline, and that the left one's is told
    to have none.
    """
    path = tmp_path / "right.yaml"
    path.write_text(CAMERA_INFO.replace("318.75, 0,", "318.75, -57.6,"))
    rig = StereoRig.from_opencv(path)
    assert rig.intrinsics == Intrinsics(480, 481, 318.75, 239, 640, 480)
    assert rig.baseline == pytest.approx(0.12)
    assert StereoRig.from_opencv(path, unit=1).baseline == rig.baseline
    with pytest.raises(ValueError, match=r"right\.yaml: ROS's camera_info is in meters, got the unit 0\.025"):
        StereoRig.from_opencv(path, unit=0.025)
    path.write_text(CAMERA_INFO)
    with pytest.raises(ValueError, match=r"right\.yaml: a left camera's camera_info has no baseline"):
        StereoRig.from_opencv(path)
    path.write_text(CAMERA_INFO.replace("318.75, 0,", "318.75, 57.6,"))
    with pytest.raises(ValueError, match="the right camera is left of the left one"):
        StereoRig.from_opencv(path)


def test_ros_distortion_is_told(tmp_path: Path) -> None:
    """It proves that the lens of a camera_info is warned of, but not for rectified images."""
    path = tmp_path / "c.yaml"
    path.write_text(CAMERA_INFO)
    with pytest.warns(UserWarning, match=r"c\.yaml: its lens' distortion isn't taken out"):
        assert Intrinsics.from_opencv(path).fx == 500.25
    assert Intrinsics.from_opencv(path, key="projection_matrix").fx == 480


@pytest.mark.parametrize("read", [Intrinsics.from_opencv, Intrinsics.from_kitti, Intrinsics.from_toml])
def test_missing_files_are_named(tmp_path: Path, read: Callable[..., Any]) -> None:
    """It proves that a file that isn't there is a FileNotFoundError, in OpenCV's format too."""
    with pytest.raises(FileNotFoundError, match="nowhere"):
        read(tmp_path / "nowhere", size=SIZE)
