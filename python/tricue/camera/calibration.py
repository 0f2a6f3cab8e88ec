# SPDX-License-Identifier: MIT
"""Calibration files: OpenCV's, KITTI's, the Princeton Tracking Benchmark's, TOML.

Many of them don't hold the image's size; then ``size=(width, height)`` gives it. The readers' errors name
the file and the key: ValueError, or OSError for a file that isn't there.
"""

import pathlib
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera import toml
from tricue.camera.numbers import positive
from tricue.camera.rig import Intrinsics, Path, Size, StereoRig

if TYPE_CHECKING:
    from typing_extensions import Self

Matrix = NDArray[np.float64]
Camera = TypeVar("Camera", Intrinsics, StereoRig)
# Names that OpenCV's samples and tutorials write. Where a rectified pair is saved, its camera is meant.
_OPENCV_KEYS = ("camera_matrix", "cameraMatrix", "K", "P1", "M1", "K1")


def opencv_intrinsics(path: Path, *, key: str | None = None, size: Size | None = None) -> Intrinsics:
    """The camera matrix of a ``cv2.FileStorage`` file: YAML, XML or JSON.

    key: its name in the file; by default the first of camera_matrix, cameraMatrix, K, P1, M1, K1.
    """
    with OpenCVFile(path) as file:
        keys = (key,) if key else _OPENCV_KEYS
        matrix = next((m for m in map(file.matrix, keys) if m is not None), None)
        if matrix is None:
            raise ValueError(f"{path}: expected a camera matrix named {' or '.join(keys)}, found none")
        return _intrinsics(matrix, size or file.size(), path)


def opencv_rig(path: Path, *, unit: float = 1.0, size: Size | None = None) -> StereoRig:
    """The rectified rig of a ``cv2.FileStorage`` file with the P1 and P2 of ``cv2.stereoRectify``.

    unit: metres per unit of the calibration's board: 0.001 where its squares were given in millimetres.
    """
    with OpenCVFile(path) as file:
        left, right = file.matrix("P1"), file.matrix("P2")
        if left is None or right is None:
            raise ValueError(
                f"{path}: expected P1 and P2 of a rectified rig, as cv2.stereoRectify gives them"
            )
        return projected_rig(left, right, positive(unit, "unit", "metres"), size or file.size(), path)


def kitti_intrinsics(path: Path, *, camera: int = 2, size: Size | None = None) -> Intrinsics:
    """A rectified camera of KITTI's calib.txt (P2) or calib_cam_to_cam.txt (P_rect_02); 2 is left, color."""
    values = _kitti(path)
    return _intrinsics(_kitti_projection(values, camera, path), size or _kitti_size(values, camera), path)


def kitti_rig(path: Path, *, cameras: tuple[int, int] = (2, 3), size: Size | None = None) -> StereoRig:
    """Two rectified cameras of a KITTI calibration, left first: (2, 3) are color, (0, 1) grey."""
    values = _kitti(path)
    left, right = (_kitti_projection(values, camera, path) for camera in cameras)
    return projected_rig(left, right, 1.0, size or _kitti_size(values, cameras[0]), path)


def kitti_offset(path: Path, *, camera: int = 2) -> Matrix:
    """What leads from camera 0's frame, in which KITTI's labels are, to a rectified camera's: (3,) metres.

    Its projection matrix is K [I | offset].
    """
    matrix = _kitti_projection(_kitti(path), camera, path)
    intrinsics = _intrinsics(matrix, (1, 1), path)  # refuses what can't be a camera; the size has no part
    x, y, z = map(float, matrix[:, 3])
    (fx, cx), (fy, cy) = (intrinsics.fx, intrinsics.cx), (intrinsics.fy, intrinsics.cy)
    return np.array([(x - cx * z) / fx, (y - cy * z) / fy, z])


def princeton_intrinsics(path: Path, *, size: Size | None = None) -> Intrinsics:
    """The camera matrix K in a frames.mat, which counts pixels from 1, as MATLAB does.

    ValueError also where SciPy, which reads it, isn't installed.
    """
    try:
        from scipy.io import loadmat
    except ImportError:
        raise ValueError(f"{path}: it takes SciPy to read it, pip install scipy") from None
    with pathlib.Path(path).open("rb") as file:
        try:
            matrix = np.array(loadmat(file, simplify_cells=True)["frames"]["K"], np.float64)
        except Exception:  # loadmat has no error of its own: zlib's, its stream's and others come through
            raise ValueError(f"{path}: expected MATLAB's file of a struct frames with the matrix K") from None
    if matrix.shape == (3, 3):
        matrix[:2, 2] -= 1
    return _intrinsics(matrix, size, path)


def toml_intrinsics(path: Path, *, table: str | None = None, size: Size | None = None) -> Intrinsics:
    """Keys fx, fy, cx, cy (and width, height without ``size``), at the top of the file or in ``table``."""
    return _toml_intrinsics(_toml_table(path, table), size, path)


def toml_rig(path: Path, *, table: str | None = None, size: Size | None = None) -> StereoRig:
    """The keys of :func:`toml_intrinsics` and ``baseline`` in metres."""
    values = _toml_table(path, table)
    return _named(path, StereoRig, _toml_intrinsics(values, size, path), _value(values, "baseline", path))


class OpenCVFile:
    """A ``cv2.FileStorage`` opened for reading, whose failures are exceptions with the file's name."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with pathlib.Path(path).open("rb"):  # FileStorage says nothing about a missing file
            pass

    def __enter__(self) -> "Self":
        try:
            self.storage = cv2.FileStorage(str(self.path), cv2.FILE_STORAGE_READ)
        except (cv2.error, SystemError):
            raise ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote") from None
        if not self.storage.isOpened():
            raise ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote")
        return self

    def __exit__(self, *_: object) -> None:
        self.storage.release()

    def matrix(self, key: str) -> Matrix | None:
        """The matrix of that name, None where there is none."""
        node = self.storage.getNode(key)
        matrix = None if node.empty() or not node.isMap() else node.mat()
        return None if matrix is None else np.asarray(matrix, np.float64)

    def size(self) -> Size | None:
        """Width and height of the images, None where the file doesn't say it."""
        for names in (("image_width", "image_height"), ("width", "height"), ("imageWidth", "imageHeight")):
            nodes = [self.storage.getNode(name) for name in names]
            if all(node.isInt() for node in nodes):
                return int(nodes[0].real()), int(nodes[1].real())
        return None


def _intrinsics(matrix: Matrix, size: Size | None, path: Path) -> Intrinsics:
    if matrix.shape not in ((3, 3), (3, 4)):
        raise ValueError(f"{path}: expected a camera matrix (3, 3) or (3, 4), got {matrix.shape}")
    if size is None:
        raise ValueError(f"{path}: the file doesn't hold the image's size; pass size=(width, height)")
    fx, fy, cx, cy = map(float, (matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2]))
    return _named(path, Intrinsics, fx, fy, cx, cy, *size)


def _named(path: Path, kind: Callable[..., Camera], *values: Any) -> Camera:
    try:
        return kind(*values)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{path}: {error}") from None


def projected_rig(left: Matrix, right: Matrix, unit: float, size: Size | None, path: Path) -> StereoRig:
    """The rig of two rectified cameras' projection matrices (3, 4); ``path`` for the errors."""
    intrinsics = _intrinsics(left, size, path)
    if left.shape != (3, 4) or right.shape != (3, 4):
        raise ValueError(f"{path}: expected projection matrices (3, 4), got {left.shape} and {right.shape}")
    if not np.allclose(left[:, :3], right[:, :3], rtol=0, atol=1e-3):
        raise ValueError(
            f"{path}: expected the same camera matrix in both cameras (cv2.CALIB_ZERO_DISPARITY), got two"
        )
    baseline, rise = (left[:2, 3] - right[:2, 3]) / left[[0, 1], [0, 1]]
    if abs(rise) > abs(baseline):
        raise ValueError(f"{path}: expected cameras side by side, got one above the other")
    if baseline < 0:
        raise ValueError(f"{path}: the right camera is left of the left one; swap the two cameras")
    if baseline == 0:
        raise ValueError(f"{path}: expected two cameras apart from each other, got baseline 0")
    return StereoRig(intrinsics, float(baseline) * unit)


def _kitti(path: Path) -> dict[str, list[float]]:
    """Every line "key: numbers" or "key numbers"; lines that hold no numbers, such as dates, are left out."""
    lines = pathlib.Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    pairs = (line.replace(":", " ", 1).split() for line in lines if line.strip())
    return {key: numbers for key, *words in pairs if (numbers := _numbers(words)) is not None}


def _numbers(words: Iterable[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _kitti_projection(values: Mapping[str, list[float]], camera: int, path: Path) -> Matrix:
    names = (f"P{camera}", f"P_rect_{camera:02d}")
    numbers = next((values[name] for name in names if len(values.get(name, ())) == 12), None)
    if numbers is None:
        raise ValueError(f"{path}: expected a line {' or '.join(names)} with 12 numbers, found none")
    return np.reshape(numbers, (3, 4))


def _kitti_size(values: Mapping[str, list[float]], camera: int) -> Size | None:
    size = values.get(f"S_rect_{camera:02d}")
    return (round(size[0]), round(size[1])) if size and len(size) == 2 else None


def _toml_table(path: Path, table: str | None) -> Mapping[str, Any]:
    values = toml.read(path)
    tables = {name: value for name, value in values.items() if isinstance(value, dict) and "fx" in value}
    if table is None and "fx" in values:
        return values
    if table is None and len(tables) == 1:
        return next(iter(tables.values()))
    if table not in tables:
        known = ", ".join(map(repr, tables)) or "none with the key fx"
        raise ValueError(f"{path}: expected table to be one of its tables ({known}), got {table!r}")
    return tables[table]


def _toml_intrinsics(values: Mapping[str, Any], size: Size | None, path: Path) -> Intrinsics:
    if size is None and not ("width" in values and "height" in values):
        raise ValueError(f"{path}: the file doesn't hold the image's size; pass size=(width, height)")
    focal = (_value(values, key, path) for key in ("fx", "fy", "cx", "cy"))
    return _named(path, Intrinsics, *focal, *(size or (values["width"], values["height"])))


def _value(values: Mapping[str, Any], key: str, path: Path) -> Any:
    if key not in values:
        raise ValueError(f"{path}: expected the key {key}, found {', '.join(values)}")
    return values[key]
