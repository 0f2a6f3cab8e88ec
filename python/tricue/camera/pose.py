# SPDX-License-Identifier: MIT
"""The pose of a camera: the transform from its coordinates to the world's."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tricue.arrays import Floats
from tricue.camera.numbers import MAX_ANGLE, finite, warn_of_degrees

MAX_SKEW = 1e-3
"""How much RᵀR may differ from the identity: enough for a rotation written with few digits."""


@dataclass(frozen=True, slots=True, init=False)
class Pose:
    """A camera in the world: p_world = R p_camera + t, with the camera frame x right, y down, z forward.

    rotation: R, (3, 3), in row-major order. translation: t, (3,) meters: the camera's position in the world.
    The world frame can be any right-handed one. A rounded rotation matrix is made orthogonal. TypeError or
    ValueError says what is wrong.
    """

    rotation: tuple[tuple[float, float, float], ...]
    translation: tuple[float, float, float]

    def __init__(self, rotation: ArrayLike, translation: ArrayLike = (0.0, 0.0, 0.0)) -> None:
        turn = _orthogonal(_numbers(rotation, "rotation", (3, 3)))
        assign = object.__setattr__  # the dataclass is frozen
        assign(self, "rotation", tuple(map(tuple, turn.tolist())))
        assign(self, "translation", tuple(_numbers(translation, "translation", (3,)).tolist()))

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> "Pose":
        """From a (4, 4) matrix [R t; 0 0 0 1], or its first three rows."""
        rows = _numbers(matrix, "pose", (4, 4), (3, 4))
        if len(rows) == 4 and not np.allclose(rows[3], [0, 0, 0, 1]):
            raise ValueError(f"pose: expected the last row 0, 0, 0, 1, got {rows[3].tolist()}")
        return cls(rows[:3, :3], rows[:3, 3])

    @classmethod
    def from_pan_tilt(cls, pan: float, tilt: float, translation: ArrayLike = (0.0, 0.0, 0.0)) -> "Pose":
        """Of a camera on a pan-tilt head: the world's axes are the camera's where both angles are 0.

        pan, tilt: the head's angles as in :class:`tricue.PanTilt`, radians: pan to the right, then tilt
        upward. The axes are assumed to meet at the camera's center, which is at ``translation``. Warns
        (UserWarning) of an angle beyond a whole turn, which looks like degrees.
        """
        about_y, about_x = finite(pan, "pan", "radians"), finite(tilt, "tilt", "radians")
        for angle, name in ((about_y, "pan"), (about_x, "tilt")):
            if abs(angle) > MAX_ANGLE:
                warn_of_degrees(angle, name, "radians")
        cos, sin = math.cos(about_y), math.sin(about_y)
        turn = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
        cos, sin = math.cos(about_x), math.sin(about_x)
        return cls(turn @ [[1, 0, 0], [0, cos, -sin], [0, sin, cos]], translation)

    @property
    def matrix(self) -> Floats:
        """(4, 4) [R t; 0 0 0 1]."""
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = self.rotation, self.translation
        return matrix

    @property
    def inverse(self) -> "Pose":
        """The inverse transform, from the world's frame to the camera's."""
        back = np.array(self.rotation).T
        return Pose(back, -back @ np.array(self.translation))

    def to_world(self, points: ArrayLike) -> Floats:
        """Transform points (..., 3), meters, from the camera's frame to the world's."""
        array = _stacked(points, "points", (3,))
        return np.asarray(array @ np.array(self.rotation).T + self.translation)

    def covariance_to_world(self, covariance: ArrayLike) -> Floats:
        """Rotate covariances C (..., 3, 3), square meters, into the world's frame: R C Rᵀ."""
        turn = np.array(self.rotation)
        return np.asarray(turn @ _stacked(covariance, "covariance", (3, 3)) @ turn.T)


def as_pose(value: Any) -> Pose | None:
    """A pose or None unchanged, or the pose of a (4, 4) matrix; TypeError or ValueError for anything else."""
    return value if value is None or isinstance(value, Pose) else Pose.from_matrix(value)


def _numbers(value: ArrayLike, name: str, shape: tuple[int, ...], *others: tuple[int, ...]) -> Floats:
    """An array of finite numbers with the shape, or one of the other shapes."""
    expected = f"{name}: expected numbers of shape {shape}"
    array = _array(value, expected)
    if array.shape not in (shape, *others):
        raise ValueError(f"{expected}, got shape {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: expected finite numbers, got {array.tolist()}")
    return array


def _stacked(value: ArrayLike, name: str, shape: tuple[int, ...]) -> Floats:
    """An array of numbers whose last axes have the shape."""
    expected = f"{name}: expected numbers of shape (..., {', '.join(map(str, shape))})"
    array = _array(value, expected)
    if array.shape[-len(shape) :] != shape:
        raise ValueError(f"{expected}, got shape {array.shape}")
    return array


def _array(value: ArrayLike, expected: str) -> Floats:
    try:
        return np.asarray(value, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{expected}, got {value!r:.80}") from None


def _orthogonal(turn: Floats) -> Floats:
    """The rotation nearest to a matrix; ValueError if the matrix isn't close to a rotation."""
    if not np.allclose(turn.T @ turn, np.eye(3), rtol=0, atol=MAX_SKEW):
        raise ValueError(f"rotation: expected a rotation matrix, got {turn.tolist()}")
    if np.linalg.det(turn) < 0:
        raise ValueError("rotation: expected a right-handed rotation, got a reflection, of determinant -1")
    left, _, right = np.linalg.svd(turn)
    nearest = left @ right
    return turn if np.allclose(nearest, turn, rtol=0, atol=1e-15) else np.asarray(nearest)
