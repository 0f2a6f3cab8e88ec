# SPDX-License-Identifier: MIT
"""One reader for each calibration format: OpenCV's (and ROS's), KITTI's, the Princeton Benchmark's, TOML.

The readers return checked numbers, from which :class:`tricue.Intrinsics` and :class:`tricue.StereoRig` are
made. Many files don't hold the image's size; ``size=(width, height)`` gives it. ImageSizeError is raised if
the file holds another size. Errors name the file and the key: ValueError, or OSError for a missing file.
"""

import difflib
import pathlib
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeVar

import numpy as np

from tricue.camera import toml
from tricue.camera.numbers import pinhole, positive, positive_whole
from tricue.camera.opencv_file import OpenCVFile
from tricue.camera.pose import Pose
from tricue.camera.text import lines_of
from tricue.camera.types import Matrix, PathLike, Size

T = TypeVar("T")
# Names in files of OpenCV's samples and tutorials. In the file of a rectified rig, P1 is the left camera's.
_OPENCV_KEYS = ("camera_matrix", "cameraMatrix", "K", "P1", "M1", "K1")
NUMBERED_DISTORTION_KEYS = ("D{}", "distCoeffs{}", "dist_coeffs_{}", "distortion_{}")
"""For the left camera (1) and the right one (2): first the name in OpenCV's sample stereo_calib."""
_DISTORTION_KEYS = ("distortion_coefficients", "distCoeffs", "dist_coeffs", "dist_coeff", "distortion", "D")

POSE_KEYS = ("pose", "rotation", "translation")
LIKELY_MISSPELLED = 0.85
"""The similarity (difflib's ratio) above which an unknown key is taken for a misspelled one."""

MAX_SKEWED = 0.5
"""Pixels by which a camera matrix's skew may move a point of the image before a note says so."""


MIN_SCALE = 4 / 3
"""How much larger or smaller than the images those that a principal point suggests must be for a note.

A real lens' principal point, up to a tenth of the image off its middle, gives 1.2; 1080 rows for 720, 1.5.
"""


class ImageSizeError(ValueError):
    """A calibration is for another image size than expected.

    own: width and height in the file, pixels.
    """

    def __init__(self, message: str, own: Size = (0, 0)) -> None:
        super().__init__(message)
        self.own = own


class PinholeParameters(NamedTuple):
    """A pinhole camera without distortion, all in pixels, and its pose; see :class:`tricue.Intrinsics`."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    pose: Pose | None = None


class RigParameters(NamedTuple):
    """A rectified stereo rig: the camera matrix that both cameras have, and the baseline in meters."""

    camera: PinholeParameters
    baseline: float


def read_opencv_camera(
    path: PathLike, *, key: str | None = None, size: Size | None = None
) -> PinholeParameters:
    """The camera matrix in a file of ``cv2.FileStorage`` (YAML, XML, JSON) or a camera_info of ROS (YAML).

    key: its name in the file; by default the first of camera_matrix, cameraMatrix, K, P1, M1, K1 that is
        there. For rectified images it is a projection matrix (3, 4): P1 or, in a camera_info,
        projection_matrix.
    Warns (UserWarning) if the file has distortion, unless the matrix is a projection matrix.
    """
    with OpenCVFile(path) as file:
        keys = (key,) if key else _OPENCV_KEYS
        matrices = ((name, file.matrix(name)) for name in keys)
        name, matrix = next(((name, found) for name, found in matrices if found is not None), ("", None))
        if matrix is None:
            raise ValueError(f"{path}: expected a camera matrix named {' or '.join(keys)}, found none")
        camera = _camera_of_matrix(matrix, file.size(), size, path)
        if matrix.shape == (3, 3) and _is_distorted(file, name):
            warnings.warn(f"{path}: its lens' distortion isn't taken out", stacklevel=3)
        return camera


def read_opencv_rig(path: PathLike, *, unit: float = 1.0, size: Size | None = None) -> RigParameters:
    """The rectified rig in a file of ``cv2.FileStorage`` or in the camera_info (ROS, YAML) of a right camera.

    The file has P1 and P2 of ``cv2.stereoRectify``; a camera_info has the baseline in its projection_matrix.
    unit: meters per unit of the calibration board, 0.001 if its squares were given in millimeters. ValueError
        for another unit than 1 with a camera_info, which is in meters by definition.
    """
    with OpenCVFile(path) as file:
        left, right = file.matrix("P1"), file.matrix("P2")
        if left is None and right is None:
            left, right = _ros_projections(file.matrix("projection_matrix"), path)
            if left is not None and unit != 1:
                raise ValueError(f"{path}: ROS's camera_info is in meters, got the unit {unit}; leave it out")
        if left is None or right is None:
            raise ValueError(
                f"{path}: expected P1 and P2 of a rectified rig, as cv2.stereoRectify gives them, or ROS's "
                "camera_info of the right camera"
            )
        return rig_of_projections(left, right, positive(unit, "unit", "meters"), path, file.size(), size)


def read_kitti_camera(path: PathLike, *, camera: int = 2, size: Size | None = None) -> PinholeParameters:
    """A rectified camera in KITTI's calib.txt (P2) or calib_cam_to_cam.txt (P_rect_02).

    camera: KITTI's number of the camera; 2 is the left color camera.
    """
    values = _kitti_values(path)
    projection = _kitti_projection(values, camera, path)
    return _camera_of_matrix(projection, _kitti_size(values, camera), size, path)


def read_kitti_rig(
    path: PathLike, *, cameras: tuple[int, int] = (2, 3), size: Size | None = None
) -> RigParameters:
    """Two rectified cameras in a KITTI calibration, left first: (2, 3) are color, (0, 1) gray."""
    values = _kitti_values(path)
    left, right = (_kitti_projection(values, camera, path) for camera in cameras)
    return rig_of_projections(left, right, 1.0, path, _kitti_size(values, cameras[0]), size)


def read_kitti_offset(path: PathLike, *, camera: int = 2) -> Matrix:
    """The translation (3,), meters, from camera 0's frame to a rectified camera's frame.

    KITTI's labels are in the frame of camera 0. The camera's projection matrix is K [I | offset].
    """
    matrix = _kitti_projection(_kitti_values(path), camera, path)
    k = _camera_of_matrix(matrix, (1, 1), None, path)  # checks the matrix; the size doesn't matter
    x, y, z = map(float, matrix[:, 3])
    return np.array([(x - k.cx * z) / k.fx, (y - k.cy * z) / k.fy, z])


def read_princeton_camera(path: PathLike, *, size: Size | None = None) -> PinholeParameters:
    """The camera with matrix K in a frames.mat, which counts pixels from 1, as MATLAB does.

    Reading it needs SciPy; ValueError if SciPy isn't installed.
    """
    try:
        from scipy.io import loadmat
    except ImportError:
        raise ValueError(f"{path}: it takes SciPy to read it, pip install scipy") from None
    with pathlib.Path(path).open("rb") as file:
        try:
            matrix = np.array(loadmat(file, simplify_cells=True)["frames"]["K"], np.float64)
        except Exception:  # loadmat has no error of its own: zlib's and others come through
            raise ValueError(f"{path}: expected MATLAB's file of a struct frames with the matrix K") from None
    if matrix.shape == (3, 3):
        matrix[:2, 2] -= 1
    return _camera_of_matrix(matrix, None, size, path)


def read_toml_camera(
    path: PathLike, *, table: str | None = None, size: Size | None = None
) -> PinholeParameters:
    """A camera from the keys fx, fy, cx, cy, and width, height or else ``size``; and its pose, if any.

    The pose is the key ``pose``, (4, 4), or one or both of ``rotation``, (3, 3), and ``translation``, (3,).
    table: the TOML table that holds them; by default the top of the file, or its only table with fx.
    """
    return _toml_camera(_toml_table(path, table), size, path)


def read_toml_rig(path: PathLike, *, table: str | None = None, size: Size | None = None) -> RigParameters:
    """A rig from the keys of :func:`read_toml_camera` and ``baseline`` in meters."""
    values = _toml_table(path, table)
    camera = _toml_camera(values, size, path)
    baseline = _required(values, "baseline", path)
    return RigParameters(camera, _name_file(path, lambda: positive(baseline, "baseline", "meters")))


def image_size(own: Size | None, given: Size | None, path: PathLike) -> Size | None:
    """The size in the file, or else the given one; ImageSizeError if they differ."""
    if given is None:
        return own
    size = checked_size(given)
    if own not in (None, size):
        raise other_size(own, size, path)
    return size


def checked_size(size: Any) -> Size:
    """The width and height of an image; TypeError or ValueError names the argument size."""
    try:
        width, height = size
    except (TypeError, ValueError) as error:  # no sequence, or an image's shape
        raise type(error)(f"size: expected (width, height), pixels, got {size!r:.80}") from None
    return positive_whole(width, "size", "pixels"), positive_whole(height, "size", "pixels")


def other_size(own: Size, given: Size, path: PathLike, images: str = "images") -> ImageSizeError:
    """The error for a file whose images have another size than the given ones."""
    return ImageSizeError(
        f"{path}: expected a calibration for {images} of {given[0]}x{given[1]} pixels, "
        f"got one for {own[0]}x{own[1]}",
        own,
    )


def rig_of_projections(
    left: Matrix,
    right: Matrix,
    unit: float,
    path: PathLike,
    own: Size | None,
    given: Size | None = None,
) -> RigParameters:
    """The rig of two rectified cameras, from their projection matrices (3, 4).

    unit: meters per unit of the matrices' last column. path: the file that errors name. own, given: the
    image's size in the file, and the images' size. ValueError unless both cameras have the same camera matrix
    and are side by side, left first.
    """
    camera = _camera_of_matrix(left, own, given, path)
    if left.shape != (3, 4) or right.shape != (3, 4):
        raise ValueError(f"{path}: expected projection matrices (3, 4), got {left.shape} and {right.shape}")
    if not np.allclose(left[:, :3], right[:, :3], rtol=0, atol=1e-3):
        raise ValueError(
            f"{path}: expected the same camera matrix in both cameras (cv2.CALIB_ZERO_DISPARITY), got two"
        )
    baseline, vertical = (left[:2, 3] - right[:2, 3]) / left[[0, 1], [0, 1]]
    if abs(vertical) > abs(baseline):
        raise ValueError(f"{path}: expected cameras side by side, got one above the other")
    if baseline < 0:
        raise ValueError(f"{path}: the right camera is left of the left one; swap the two cameras")
    if baseline == 0:
        raise ValueError(f"{path}: expected two cameras apart from each other, got baseline 0")
    return RigParameters(camera, float(baseline) * unit)


def skew_note(matrix: Matrix, height: int) -> str:
    """A note on a camera matrix's skew if leaving it out moves a point of the image by more than MAX_SKEWED;
    "" else.

    height: of the image, pixels.
    """
    skew, fy, cy = float(matrix[0, 1]), float(matrix[1, 1]), float(matrix[1, 2])
    farthest = abs(skew / fy) * max(cy, height - cy)
    return f"its skew of {skew:.3g} px, up to {farthest:.2g} px, isn't taken out" * (farthest > MAX_SKEWED)


def check_principal_point(cx: float, cy: float, size: Size, path: PathLike) -> None:
    """ValueError if a principal point is outside the image, and a warning (UserWarning) if it suggests images
    of another size: for files that don't hold the size that they are for.
    """
    width, height = size
    point = f"{path}: its principal point ({cx:.6g}, {cy:.6g})"
    if not (0 <= cx < width and 0 <= cy < height):
        raise ValueError(
            f"{point} is outside the images of {width}x{height} pixels; is it for images of another size? "
            "If not, add these images' size to it"
        )
    scales = 2 * cx / width, 2 * cy / height
    if min(scales) > MIN_SCALE or max(scales) < 1 / MIN_SCALE:
        warnings.warn(
            f"{point} suggests images of about {2 * cx:.0f}x{2 * cy:.0f} pixels, not {width}x{height}; "
            "if it is for these, positions are wrong",
            stacklevel=5,
        )


def _camera_of_matrix(
    matrix: Matrix, own: Size | None, given: Size | None, path: PathLike
) -> PinholeParameters:
    """The camera with that matrix; own, given: the image's size in the file, and the images' size."""
    size = image_size(own, given, path)
    if matrix.shape not in ((3, 3), (3, 4)):
        raise ValueError(f"{path}: expected a camera matrix (3, 3) or (3, 4), got {matrix.shape}")
    if size is None:
        raise ValueError(f"{path}: the file doesn't hold the image's size; pass size=(width, height)")
    if matrix[1, 0] or matrix[2, 0] or matrix[2, 1]:
        hint = "; is it transposed, as by MATLAB?" if matrix[2, 0] and not matrix[0, 2] else ""
        raise ValueError(f"{path}: expected a camera matrix fx 0 cx, 0 fy cy, 0 0 1, got another one{hint}")
    fx, fy, cx, cy = map(float, (matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2]))
    camera = _name_file(path, lambda: PinholeParameters(*pinhole(fx, fy, cx, cy, *size)))
    if own is None:
        check_principal_point(cx, cy, size, path)
    if note := skew_note(matrix, camera.height):
        warnings.warn(f"{path}: {note}", stacklevel=4)
    return camera


def _ros_projections(right: Matrix | None, path: PathLike) -> tuple[Matrix, Matrix] | tuple[None, None]:
    """Both cameras' projection matrices (3, 4), from the right one's by ROS; None if that isn't there."""
    if right is None or right.shape != (3, 4):
        return None, None
    if not right[:, 3].any():
        raise ValueError(
            f"{path}: a left camera's camera_info has no baseline; expected the right camera's, as right.yaml"
        )
    left = right.copy()
    left[:, 3] = 0
    return left, right


def _is_distorted(file: OpenCVFile, key: str) -> bool:
    """Whether the file has nonzero distortion for the camera whose matrix has this name."""
    number = key[-1] if key[-1].isdigit() else ""
    names = [each.format(number) for each in NUMBERED_DISTORTION_KEYS] if number else _DISTORTION_KEYS
    found = next((numbers for numbers in map(file.numbers, names) if numbers is not None), None)
    return found is not None and bool(np.any(found != 0))


def _name_file(path: PathLike, check: Callable[[], T]) -> T:
    """The result of a check; its TypeError or ValueError becomes a ValueError that names the file."""
    try:
        return check()
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from None


def _kitti_values(path: PathLike) -> dict[str, list[float]]:
    """The numbers of each line "key: numbers" or "key numbers"; other lines, such as dates, are skipped."""
    split = filter(None, (line.replace(":", " ", 1).split() for line in lines_of(pathlib.Path(path))))
    return {key: numbers for key, *words in split if (numbers := _numbers(words)) is not None}


def _numbers(words: Iterable[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _kitti_projection(values: Mapping[str, list[float]], camera: int, path: PathLike) -> Matrix:
    names = (f"P{camera}", f"P_rect_{camera:02d}")
    numbers = next((values[name] for name in names if len(values.get(name, ())) == 12), None)
    if numbers is None:
        raise ValueError(f"{path}: expected a line {' or '.join(names)} with 12 numbers, found none")
    return np.reshape(numbers, (3, 4))


def _kitti_size(values: Mapping[str, list[float]], camera: int) -> Size | None:
    size = values.get(f"S_rect_{camera:02d}")
    return (round(size[0]), round(size[1])) if size and len(size) == 2 else None


def _toml_table(path: PathLike, table: str | None) -> Mapping[str, Any]:
    values = toml.read(path)
    tables = {name: value for name, value in values.items() if isinstance(value, dict) and "fx" in value}
    if table is None and "fx" in values:
        return values
    if table is None and len(tables) == 1:
        return next(iter(tables.values()))
    if table is None:
        known = f"found it in several tables, {', '.join(map(repr, tables))}" if tables else "found none"
        choose = "; table= chooses one" if tables else ""
        raise ValueError(f"{path}: expected one camera, with the key fx, {known}{choose}")
    if table not in tables:
        known = ", ".join(map(repr, tables)) or "none with the key fx"
        raise ValueError(f"{path}: expected table to be one of its tables ({known}), got {table!r}")
    return tables[table]


def _toml_camera(values: Mapping[str, Any], size: Size | None, path: PathLike) -> PinholeParameters:
    if size is None and not ("width" in values and "height" in values):
        raise ValueError(f"{path}: the file doesn't hold the image's size; pass size=(width, height)")
    fx, fy, cx, cy = (_required(values, key, path) for key in ("fx", "fy", "cx", "cy"))
    width, height = (0, 0) if size is None else checked_size(size)
    width, height = values.get("width", width), values.get("height", height)
    camera = _name_file(
        path, lambda: PinholeParameters(*pinhole(fx, fy, cx, cy, width, height), _toml_pose(values))
    )
    image_size((camera.width, camera.height), size, path)
    if "width" not in values and "height" not in values:
        check_principal_point(camera.cx, camera.cy, (camera.width, camera.height), path)
    return camera


def _toml_pose(values: Mapping[str, Any]) -> Pose | None:
    given = [key for key in POSE_KEYS if key in values]
    for key in values.keys() - POSE_KEYS:
        if meant := difflib.get_close_matches(key, POSE_KEYS, n=1, cutoff=LIKELY_MISSPELLED):
            raise ValueError(f"{key}: unknown key; did you mean {meant[0]}?")
    if "pose" in given and len(given) > 1:
        raise ValueError(f"pose: expected alone, got also {given[1]}")
    if "pose" in given:
        return Pose.from_matrix(values["pose"])
    if not given:
        return None
    return Pose(values.get("rotation", np.eye(3)), values.get("translation", np.zeros(3)))


def _required(values: Mapping[str, Any], key: str, path: PathLike) -> Any:
    if key not in values:
        raise ValueError(f"{path}: expected the key {key}, found {', '.join(values)}")
    return values[key]
