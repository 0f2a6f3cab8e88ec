# SPDX-License-Identifier: MIT
"""Pinhole intrinsics and rectified stereo rigs. Camera frame: x right, y down, z forward, meters."""

import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.numbers import finite, pinhole, positive, positive_whole
from tricue.camera.pose import Pose, as_pose
from tricue.camera.types import PathLike, Size

MAX_PLAUSIBLE_BASELINE = 2.0  # meters; a larger one is most likely in another unit


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """A pinhole camera without distortion, as in OpenCV: u = fx X / Z + cx, v = fy Y / Z + cy.

    fx, fy: focal lengths. cx, cy: the principal point. width, height: the image's size. All in pixels.

    Coordinates (u, v) are OpenCV's: (0, 0) is the *center* of the first pixel. In a :class:`Box`, (0, 0) is
    that pixel's corner, so a point (x, y) of a box has u = x - 0.5 and v = y - 0.5.

    pose: the camera's pose in the world, a :class:`tricue.Pose` or its (4, 4) matrix; None if it isn't known.
    With a pose, tracks also have positions in the world.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    pose: Pose | None = None

    if TYPE_CHECKING:  # the field is a Pose, but a matrix can be passed, too

        def __init__(
            self,
            fx: float,
            fy: float,
            cx: float,
            cy: float,
            width: int,
            height: int,
            pose: Pose | ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        names = ("fx", "fy", "cx", "cy", "width", "height")
        for name, value in zip(names, pinhole(*(getattr(self, name) for name in names)), strict=True):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "pose", as_pose(self.pose))

    @classmethod
    def from_fov(
        cls, width: int, height: int, horizontal_deg: float, vertical_deg: float | None = None
    ) -> "Intrinsics":
        """From the whole image's fields of view, in degrees; the principal point is at the image's center.

        Pixels are square unless the vertical angle is given. The SR-3000 time-of-flight camera is
        ``from_fov(176, 144, 47.5, 39.5)``.
        """
        fx = _focal_length(width, horizontal_deg, "width", "horizontal_deg")
        fy = fx if vertical_deg is None else _focal_length(height, vertical_deg, "height", "vertical_deg")
        return cls(fx, fy, (width - 1) / 2, (height - 1) / 2, width, height)

    # The methods import the readers, because these import cv2, which takes long to load.

    @classmethod
    def from_opencv(cls, path: PathLike, *, key: str | None = None, size: Size | None = None) -> "Intrinsics":
        """From the camera matrix in a file of ``cv2.FileStorage`` or in a camera_info file of ROS.

        key: the matrix's name in the file; by default the first known name. Warns (UserWarning) if the file
        has distortion, which isn't corrected. Rectified images have none; their matrix is the projection
        matrix, ``key="P1"`` or, in a camera_info, ``key="projection_matrix"``. ValueError for a ``size``
        that differs from the file's.
        """
        from tricue.camera.calibration_formats import read_opencv_camera

        return cls(*read_opencv_camera(path, key=key, size=size))

    @classmethod
    def from_kitti(cls, path: PathLike, *, camera: int = 2, size: Size | None = None) -> "Intrinsics":
        """From a KITTI calibration; see :func:`tricue.camera.calibration_formats.read_kitti_camera`."""
        from tricue.camera.calibration_formats import read_kitti_camera

        return cls(*read_kitti_camera(path, camera=camera, size=size))

    @classmethod
    def from_toml(cls, path: PathLike, *, table: str | None = None, size: Size | None = None) -> "Intrinsics":
        """From the keys fx, fy, cx, cy, width, height of a TOML file or of one of its tables.

        The keys ``pose``, the rows of a (4, 4) matrix, or ``rotation`` and ``translation`` may give the
        camera's pose. size: width and height in pixels, for a file without them.
        """
        from tricue.camera.calibration_formats import read_toml_camera

        return cls(*read_toml_camera(path, table=table, size=size))

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The camera matrix K (3, 3)."""
        return np.array([[self.fx, 0, self.cx], [0, self.fy, self.cy], [0, 0, 1]], np.float64)

    @property
    def vector(self) -> NDArray[np.float64]:
        """fx, fy, cx, cy in pixels, (4,): the form in which kernels take a camera."""
        return np.array([self.fx, self.fy, self.cx, self.cy], np.float64)

    def back_project(self, u: ArrayLike, v: ArrayLike, z: ArrayLike) -> NDArray[np.float64]:
        """Points (..., 3), meters in the camera frame, at pixel coordinates u, v and depths z in meters.

        The arguments broadcast; NaN stays NaN.
        """
        u, v, z = np.broadcast_arrays(*(np.asarray(a, np.float64) for a in (u, v, z)))
        return np.stack([(u - self.cx) * z / self.fx, (v - self.cy) * z / self.fy, z], axis=-1)

    def project(self, points: ArrayLike) -> NDArray[np.float64]:
        """Pixel coordinates (..., 2) of points (..., 3) in meters, camera frame; NaN behind the camera."""
        points = np.asarray(points, np.float64)
        if points.ndim == 0 or points.shape[-1] != 3:
            raise ValueError(f"points: expected (..., 3), got {points.shape}")
        x, y, z = np.moveaxis(points, -1, 0)
        z = np.where(z > 0, z, np.nan)
        return np.stack([self.fx * x / z + self.cx, self.fy * y / z + self.cy], axis=-1)

    def _repr_html_(self) -> str:
        from tricue.notebook.cameras import intrinsics_html

        return intrinsics_html(self)


@dataclass(frozen=True, slots=True)
class StereoRig:
    """Two rectified cameras side by side with the same intrinsics, and their baseline.

    baseline: meters between the optical centers. Disparities are positive: x_right = x_left - d. The pose in
    ``intrinsics`` is the left camera's. Warns (UserWarning) if the baseline is above 2 m, which looks like
    another unit.
    """

    intrinsics: Intrinsics
    baseline: float

    def __post_init__(self) -> None:
        if not isinstance(self.intrinsics, Intrinsics):
            raise TypeError(f"intrinsics: expected tricue.Intrinsics, got {type(self.intrinsics).__name__}")
        object.__setattr__(self, "baseline", positive(self.baseline, "baseline", "meters"))
        if self.baseline > MAX_PLAUSIBLE_BASELINE:
            warnings.warn(f"baseline: {self.baseline:g} m is wide; is it in meters?", stacklevel=3)

    @classmethod
    def from_opencv(cls, path: PathLike, *, unit: float = 1.0, size: Size | None = None) -> "StereoRig":
        """From P1 and P2 of ``cv2.stereoRectify`` in a file of ``cv2.FileStorage``.

        Or from ROS's camera_info of the right camera, which is in meters. unit: meters per unit of the
        calibration board of OpenCV.
        """
        from tricue.camera.calibration_formats import read_opencv_rig

        camera, baseline = read_opencv_rig(path, unit=unit, size=size)
        return cls(Intrinsics(*camera), baseline)

    @classmethod
    def from_kitti(
        cls, path: PathLike, *, cameras: tuple[int, int] = (2, 3), size: Size | None = None
    ) -> "StereoRig":
        """From a KITTI calibration; see :func:`tricue.camera.calibration_formats.read_kitti_rig`."""
        from tricue.camera.calibration_formats import read_kitti_rig

        camera, baseline = read_kitti_rig(path, cameras=cameras, size=size)
        return cls(Intrinsics(*camera), baseline)

    @classmethod
    def from_toml(cls, path: PathLike, *, table: str | None = None, size: Size | None = None) -> "StereoRig":
        """As :meth:`Intrinsics.from_toml`, with the key ``baseline`` in meters."""
        from tricue.camera.calibration_formats import read_toml_rig

        camera, baseline = read_toml_rig(path, table=table, size=size)
        return cls(Intrinsics(*camera), baseline)

    @property
    def pose(self) -> Pose | None:
        """The left camera's pose, or None."""
        return self.intrinsics.pose

    def depth(self, disparity: ArrayLike) -> NDArray[np.float64]:
        """Depth z = fx b / d in meters, in the disparity's shape; NaN where the disparity isn't above 0."""
        disparity = np.asarray(disparity, np.float64)
        return self.intrinsics.fx * self.baseline / np.where(disparity > 0, disparity, np.nan)

    def _repr_html_(self) -> str:
        from tricue.notebook.cameras import rig_html

        return rig_html(self)


def _focal_length(pixels: Any, angle: Any, size_name: str, angle_name: str) -> float:
    positive_whole(pixels, size_name, "pixels")
    if not 0 < finite(angle, angle_name, "degrees") < 180:
        raise ValueError(f"{angle_name}: expected degrees above 0 and below 180, got {angle!r}")
    return float(pixels / (2 * math.tan(math.radians(angle) / 2)))
