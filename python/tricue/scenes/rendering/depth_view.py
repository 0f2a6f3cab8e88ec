# SPDX-License-Identifier: MIT
"""Exact z-buffers of ellipsoids and of a room, by ray casting.

Rays go through the pixel centers, and a ray's depth is its length along z. The level frame is the camera's
frame without its pitch: x right, y straight down, z forward, meters.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.rendering.depth_room import Furniture, Room
from tricue.scenes.rendering.ellipsoids import Ellipsoids


class DepthWindow(NamedTuple):
    """A z-buffer (h, w) of the part of the image that begins at (left, top); infinite where it is empty.

    It may reach beyond the image.
    """

    left: int
    top: int
    depth: Array

    def inside(self, width: int, height: int) -> tuple[tuple[slice, slice], Array]:
        """The part inside an image of this size: its slices of rows and columns, and its depths."""
        rows, columns = self.depth.shape
        left, right = max(self.left, 0), max(min(self.left + columns, width), 0)
        top, bottom = max(self.top, 0), max(min(self.top + rows, height), 0)
        part = self.depth[
            max(top - self.top, 0) : bottom - self.top, max(left - self.left, 0) : right - self.left
        ]
        if left >= right or top >= bottom:
            part = part[:0, :0]
        return (slice(top, top + part.shape[0]), slice(left, left + part.shape[1])), part


class MountedCamera(NamedTuple):
    """A camera ``height`` meters above the floor, looking down by ``pitch`` radians."""

    intrinsics: Intrinsics
    height: float
    pitch: float

    @property
    def rotation(self) -> Array:
        """The rotation (3, 3) from the level frame to the camera frame."""
        cos, sin = math.cos(self.pitch), math.sin(self.pitch)
        return np.array([[1.0, 0, 0], [0, cos, -sin], [0, sin, cos]])

    def ellipsoid_boxes(self, bodies: Ellipsoids) -> Array:
        """The bounding box (n, 4) of each ellipsoid: left, top, right, bottom, pixels.

        bodies: in the camera frame. The boxes are exact, not rounded to pixels: the outline's dual conic is
        S - c c^T (Hartley and Zisserman, 2004, section 8.3). ValueError for an ellipsoid that isn't wholly
        in front of the camera.
        """
        centers, shapes = bodies
        dual = shapes - centers[:, :, None] * centers[:, None, :]
        scale = dual[:, 2, 2]
        if not np.all((scale < 0) & (centers[:, 2] > 0)):
            raise ValueError(
                "bodies: expected ellipsoids in front of the camera, got one beside or behind it"
            )
        middle = dual[:, :2, 2] / scale[:, None]
        half = np.sqrt(middle**2 - dual[:, [0, 1], [0, 1]] / scale[:, None])
        focal, principal = self._focal_and_principal
        corners = np.stack([middle - half, middle + half], axis=1) * focal + principal + 0.5
        return corners.reshape(-1, 4)

    def bounding_box(self, bodies: Ellipsoids) -> Box:
        """The bounding box of all ellipsoids, pixels; it may reach beyond the image."""
        sides = self.ellipsoid_boxes(bodies)
        return Box.from_xyxy(*sides[:, :2].min(axis=0).tolist(), *sides[:, 2:].max(axis=0).tolist())

    def render(self, bodies: Ellipsoids) -> DepthWindow:
        """The z-buffer of ellipsoids in the camera frame, over their bounding box."""
        sides = self.ellipsoid_boxes(bodies) - 0.5
        first, last = np.ceil(sides[:, :2]).astype(int), np.floor(sides[:, 2:]).astype(int) + 1
        left, top = first.min(axis=0).tolist()
        right, bottom = last.max(axis=0).tolist()
        depth = np.full((bottom - top, right - left), np.inf)
        for center, inverse, start, stop in zip(
            bodies.centers, np.linalg.inv(bodies.shapes), first.tolist(), last.tolist(), strict=True
        ):
            x, y = self._rays(range(start[0], stop[0]), range(start[1], stop[1]))
            part = depth[start[1] - top : stop[1] - top, start[0] - left : stop[0] - left]
            np.minimum(part, _first_hit(center, inverse, x, y), out=part)
        return DepthWindow(left, top, depth)

    def render_room(self, room: Room) -> Array:
        """The z-buffer (H, W) of a room; each ray hits a wall, the floor or the ceiling."""
        x, y = self._rays(range(self.intrinsics.width), range(self.intrinsics.height))
        rays = np.stack(np.broadcast_arrays(x[None, :], y[:, None], 1.0), axis=-1) @ self.rotation
        low = np.array([-room.side, self.height - room.height, -np.inf])
        high = np.array([room.side, self.height, room.wall])
        with np.errstate(divide="ignore"):
            depth = _fold(np.minimum, np.where(rays > 0, high, low) / rays)
        for piece in room.furniture:
            depth = np.minimum(depth, self._render_furniture(piece, rays))
        return depth

    def surface_points(self, window: DepthWindow) -> Array:
        """The surface points (n, 3) of a z-buffer, meters in the camera frame."""
        rows, columns = np.nonzero(np.isfinite(window.depth))
        return self.intrinsics.back_project(
            columns + window.left, rows + window.top, window.depth[rows, columns]
        )

    def _render_furniture(self, piece: Furniture, rays: Array) -> Array:
        """The depth (H, W) at which rays enter a box: the last of the entries between opposite faces."""
        cos, sin = math.cos(piece.yaw), math.sin(piece.yaw)
        rotation = np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]])
        half = np.array([piece.width, piece.height, piece.depth]) / 2
        center = rotation @ np.array([piece.x, self.height - half[1], piece.z])
        with np.errstate(divide="ignore", invalid="ignore"):
            directions = rays @ rotation.T
            low, high = (center - half) / directions, (center + half) / directions
        enter, leave = _fold(np.maximum, np.minimum(low, high)), _fold(np.minimum, np.maximum(low, high))
        return np.where((enter <= leave) & (enter > 0), enter, np.inf)

    @property
    def _focal_and_principal(self) -> tuple[Array, Array]:
        camera = self.intrinsics
        return np.array([camera.fx, camera.fy]), np.array([camera.cx, camera.cy])

    def _rays(self, columns: range, rows: range) -> tuple[Array, Array]:
        """x (w,) and y (h,) of the rays (x, y, 1) through these columns and rows of pixels."""
        (fx, fy), (cx, cy) = self._focal_and_principal
        return (np.array(columns) - cx) / fx, (np.array(rows) - cy) / fy


def _fold(smaller_or_larger: np.ufunc, values: Array) -> Array:
    """The smallest or largest of each three values (h, w, 3); NumPy is slow at reducing so few."""
    x, y, z = np.moveaxis(values, -1, 0)
    return np.asarray(smaller_or_larger(smaller_or_larger(x, y), z))


def _first_hit(center: Array, inverse: Array, x: Array, y: Array) -> Array:
    """The depth (h, w) at which the rays (x, y, 1) enter an ellipsoid; infinite where they miss it.

    (z d - c)^T S^-1 (z d - c) = 1 is a z^2 - 2 b z + k = 0 with a = d^T S^-1 d, b = d^T S^-1 c and
    k = c^T S^-1 c - 1; its nearer root without cancellation is k / (b + sqrt(b^2 - a k)).
    """
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = inverse.tolist()
    toward = inverse @ center
    k = float(center @ toward) - 1
    a = (xx * x * x + 2 * xz * x + zz) + (yy * y * y + 2 * yz * y)[:, None] + np.multiply.outer(2 * xy * y, x)
    b = (toward[0] * x + toward[2]) + (toward[1] * y)[:, None]
    discriminant = b * b - k * a
    depth: Array = k / (b + np.sqrt(np.maximum(discriminant, 0)))
    depth[discriminant < 0] = np.inf
    return depth
