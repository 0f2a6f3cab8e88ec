# SPDX-License-Identifier: MIT
"""Rectification of stereo pairs: both images are remapped so that a point is in the same row of both.

The raw cameras follow OpenCV's pinhole model with its distortion coefficients (cv2.stereoCalibrate), not its
fisheye model. Points in the cameras' frames: x_right = rotation @ x_left + translation.
"""

import warnings
from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.calibration_formats import (
    NUMBERED_DISTORTION_KEYS,
    check_principal_point,
    checked_size,
    image_size,
    rig_of_projections,
    skew_note,
)
from tricue.camera.frame import Frame
from tricue.camera.numbers import positive
from tricue.camera.opencv_file import OpenCVFile
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.types import Matrix, PathLike, Size

# Keys of the left camera (1) and the right one (2): first those of OpenCV's sample stereo_calib.
_CAMERA_KEYS = ("M{}", "K{}", "cameraMatrix{}", "camera_matrix_{}", "CM{}")
DISTORTION_COUNTS = 4, 5, 8, 12, 14  # of OpenCV's coefficients
_ZERO_DISPARITY = 0x400  # cv2.CALIB_ZERO_DISPARITY, which has another name in cv2 5


class StereoCalibration(NamedTuple):
    """Two cameras before rectification, left first, as cv2.stereoCalibrate gives them.

    cameras: their matrices (3, 3), pixels. distortions: of each, 4, 5, 8, 12 or 14 coefficients, or none.
    rotation, translation: (3, 3), and three numbers in the unit of the calibration's board, left to right.
    """

    cameras: tuple[Matrix, Matrix]
    distortions: tuple[Matrix, Matrix]
    rotation: Matrix
    translation: Matrix


class RectifyingTransforms(NamedTuple):
    """The transforms to both rectified cameras, left first, as cv2.stereoRectify gives them.

    rotations: R1 and R2, (3, 3). projections: P1 and P2, (3, 4), in pixels and, for the baseline, the unit of
    the calibration's board.
    """

    rotations: tuple[Matrix, Matrix]
    projections: tuple[Matrix, Matrix]


class Rectification:
    """Rectifies the stereo pairs of one calibrated rig; created once, called for each stereo pair.

    raw: the calibrated cameras. size: width and height of the raw images, pixels; the rectified images have
        the same size, and are black where the raw ones have no pixels. unit: meters per unit of the
        translation. rectified: the transforms to apply; by default those that change focal length and
        principal point as little as possible.
    rig: the rig of the rectified images. Positions are in the frame of its left camera, which is turned by R1
        from the raw one's.
    """

    rig: StereoRig

    def __init__(
        self,
        raw: StereoCalibration,
        size: Size,
        *,
        unit: float = 1.0,
        rectified: RectifyingTransforms | None = None,
    ) -> None:
        self._prepare(raw, size, unit, rectified, "rectification")

    @classmethod
    def from_opencv(cls, *paths: PathLike, unit: float = 1.0, size: Size | None = None) -> "Rectification":
        """From files of ``cv2.FileStorage``: M1, D1, M2, D2 with R1, R2, P1, P2 or, without these, with R, T.

        paths: one file, or several that together hold all matrices, such as intrinsics.yml and extrinsics.yml
            of OpenCV's sample. unit: meters per unit of the board, 0.001 for millimeters. size: of the raw
            images, needed if the files don't hold it.
        ValueError or OSError names the file, and says what is missing or that its images have another size.
        """
        if not paths:
            raise ValueError("paths: expected a calibration file, got none")
        made = cls.__new__(cls)
        with ExitStack() as stack:
            files = _CalibrationFiles(
                [stack.enter_context(OpenCVFile(path)) for path in paths], " and ".join(map(str, paths))
            )
            rectified = files.rectified()
            raw, own = files.raw(posed=rectified is None), files.size(size)
            made._prepare(raw, own, unit, rectified, files.names)
            if not any(file.size() for file in files.files):
                for camera in raw.cameras:
                    check_principal_point(camera[0, 2], camera[1, 2], own, files.names)
        return made

    def __call__(self, left: NDArray[Any], right: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Rectify a stereo pair: uint8 images, BGR (H, W, 3) or gray (H, W), of the calibration's size.

        ValueError or TypeError for other images.
        """
        pair = Frame(left, right=right)  # checks both
        camera = self.rig.intrinsics
        if left.shape[:2] != (camera.height, camera.width):
            raise ValueError(
                f"left: expected images of {camera.width}x{camera.height} pixels, which the calibration is "
                f"for, got {left.shape[1]}x{left.shape[0]}"
            )
        assert pair.color is not None
        assert pair.right is not None
        first, second = (
            np.asarray(cv2.remap(image, *maps, cv2.INTER_LINEAR))
            for image, maps in zip((pair.color, pair.right), self._maps, strict=True)
        )
        return first, second

    def _prepare(
        self,
        raw: StereoCalibration,
        size: Size,
        unit: float,
        rectified: RectifyingTransforms | None,
        names: str,
    ) -> None:
        size, raw = checked_size(size), _checked(raw, names, is_posed=rectified is None)
        rotations, projections = rectified or _rectify(raw, size)
        camera, baseline = rig_of_projections(*projections, positive(unit, "unit", "meters"), names, size)
        self.rig = StereoRig(Intrinsics(*camera), baseline)
        for note in filter(None, (skew_note(each, size[1]) for each in raw.cameras)):
            warnings.warn(f"{names}: {note}", stacklevel=3)
        self._maps = [
            # Fixed point has cv2.remap's own resolution, 1/32 px, and needs less memory than floats.
            cv2.initUndistortRectifyMap(camera, distortion, rotation, projection[:, :3], size, cv2.CV_16SC2)
            for camera, distortion, rotation, projection in zip(
                raw.cameras, raw.distortions, rotations, projections, strict=True
            )
        ]


def is_rotation(matrix: Matrix) -> bool:
    """Whether a matrix (3, 3) is orthonormal, up to a calibration file's rounding."""
    return bool(np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-2))


def _checked(raw: StereoCalibration, names: str, is_posed: bool) -> StereoCalibration:
    """The calibration with a flat T, which cv2 gives as a column. is_posed: whether R and T are used.

    ValueError names what is wrong.
    """
    for camera, distortion in zip(raw.cameras, raw.distortions, strict=True):
        _check_matrix(camera, (3, 3), "a camera matrix", names)
        if np.size(distortion) not in (0, *DISTORTION_COUNTS):
            raise ValueError(
                f"{names}: expected 4, 5, 8, 12 or 14 distortion coefficients, got {np.size(distortion)}"
            )
        if min(camera[0, 0], camera[1, 1]) <= 0 or not np.isfinite(distortion).all():
            raise ValueError(
                f"{names}: expected focal lengths above 0 and finite distortion coefficients; "
                "did the calibration fail?"
            )
    translation = np.ravel(raw.translation)
    _check_matrix(raw.rotation, (3, 3), "a rotation R", names)
    _check_matrix(translation, (3,), "a translation T", names)
    if is_posed:
        _check_rotation(raw.rotation, "R", names)
    if is_posed and not translation.any():
        raise ValueError(f"{names}: expected two cameras apart from each other, got a T of 0")
    return raw._replace(translation=translation)


def _check_rotation(matrix: Matrix, what: str, names: str) -> None:
    _check_matrix(matrix, (3, 3), f"a rotation {what}", names)
    if not is_rotation(matrix):
        raise ValueError(f"{names}: expected a rotation {what}, got another matrix")


def _check_matrix(matrix: Matrix, shape: tuple[int, ...], what: str, names: str) -> None:
    if matrix.shape != shape or not np.isfinite(matrix).all():
        raise ValueError(f"{names}: expected {what} {shape} of finite numbers, got {matrix.shape}")


def _rectify(raw: StereoCalibration, size: Size) -> RectifyingTransforms:
    """Bouguet's rotations by OpenCV, and one camera matrix for both cameras.

    The matrix has the mean focal length, and the principal point that keeps the mean optical axis in place.
    The camera matrix of cv2.stereoRectify isn't used: it depends on the undistorted image corners, which may
    be anywhere, because distortion coefficients are valid only where the calibration board was seen.
    """
    (left, right), (left_distortion, right_distortion) = raw.cameras, raw.distortions
    transforms = cv2.stereoRectify(
        left,
        left_distortion,
        right,
        right_distortion,
        size,
        raw.rotation,
        raw.translation[:, None],
        flags=_ZERO_DISPARITY,
    )
    first, second = (np.asarray(rotation, np.float64) for rotation in transforms[:2])
    focal = float(np.mean([camera[[0, 1], [0, 1]] for camera in raw.cameras]))
    axes = [r[:2, 2] / r[2, 2] for r in (first, second)]  # where the optical axis (0, 0, 1) is rotated to
    center = np.mean(
        [camera[:2, 2] - focal * axis for camera, axis in zip(raw.cameras, axes, strict=True)], 0
    )
    left_projection = np.array([[focal, 0, center[0], 0], [0, focal, center[1], 0], [0, 0, 1, 0]])
    right_projection = left_projection.copy()
    right_projection[:2, 3] = focal * (second @ raw.translation)[:2]
    return RectifyingTransforms((first, second), (left_projection, right_projection))


class _CalibrationFiles(NamedTuple):
    """OpenCV files that together hold the calibration of a stereo rig."""

    files: Sequence[OpenCVFile]
    names: str

    def raw(self, posed: bool) -> StereoCalibration:
        """The raw cameras. posed: whether R and T are required."""
        cameras, distortions = self.pair(_CAMERA_KEYS), self.pair(NUMBERED_DISTORTION_KEYS)
        rotation, translation = self._first(("R", "rotation")), self._first(("T", "translation"))
        there = {"M1 and M2": cameras is not None, "D1 and D2": distortions is not None}
        if posed:
            there |= {"R": rotation is not None, "T": translation is not None}
        if missing := [name for name, found in there.items() if not found]:
            raise ValueError(
                f"{self.names}: expected M1, D1, M2, D2 of the raw cameras and R, T between them, as "
                f"cv2.stereoCalibrate gives them; found no {' and no '.join(missing)}"
            )
        assert cameras
        assert distortions
        if rotation is None or translation is None:
            return StereoCalibration(cameras, distortions, np.eye(3), np.zeros(3))
        rotation = np.asarray(cv2.Rodrigues(rotation)[0]) if rotation.size == 3 else rotation
        return StereoCalibration(cameras, distortions, rotation, translation)

    def rectified(self) -> RectifyingTransforms | None:
        """R1, R2, P1 and P2; None unless all four are there."""
        rotations, projections = self.pair(("R{}",)), self.pair(("P{}",))
        if rotations is None or projections is None:
            return None
        for rotation in rotations:
            _check_rotation(rotation, "R1, R2", self.names)
        return RectifyingTransforms(rotations, projections)

    def pair(self, patterns: Sequence[str]) -> tuple[Matrix, Matrix] | None:
        """The left and right matrix for the first key pattern of which the files have both, or None."""
        for pattern in patterns:
            left, right = (self._first((pattern.format(number),)) for number in (1, 2))
            if left is not None and right is not None:
                return left, right
        return None

    def size(self, size: Size | None) -> Size:
        """The raw images' size, from the files or as given; ValueError without one, or for different ones."""
        for file in self.files:
            size = image_size(file.size(), size, file.path)
        if size is None:
            raise ValueError(
                f"{self.names}: the file doesn't hold the image's size; pass size=(width, height)"
            )
        return size

    def _first(self, keys: Sequence[str]) -> Matrix | None:
        found = (file.matrix(key) for file in self.files for key in keys)
        return next((matrix for matrix in found if matrix is not None), None)
