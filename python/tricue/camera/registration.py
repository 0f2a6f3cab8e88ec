# SPDX-License-Identifier: MIT
"""Registration: maps color images to the depth camera's pixels, and depth images to the color camera's."""

import math
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics

_OUTSIDE_IMAGE = -2.0  # a pixel coordinate outside any image
_FAR_OUTSIDE = 1 << 20  # pixels
# A depth pixel covers at most _MAX_COVERED color pixels along a row or column; more, if needed for surfaces
# that are 1 / _NEARER as far from the color camera as from the depth camera.
_MAX_COVERED = 16
_NEARER = 2.0


class Extrinsics(NamedTuple):
    """Depth to color camera: x_color = rotation @ x_depth + translation; (3, 3), and (3,) in meters."""

    rotation: NDArray[np.float64] = np.eye(3)
    translation: NDArray[np.float64] = np.zeros(3)


def color_in_depth(
    color: NDArray[np.uint8],
    depth: ArrayLike,
    depth_camera: Intrinsics,
    color_camera: Intrinsics,
    extrinsics: Extrinsics | None = None,
) -> NDArray[np.uint8]:
    """The color (h, w, 3) at the 3D point of each pixel of a depth image (h, w).

    The color is black where the point isn't in the color image (H, W, 3). Occlusion isn't handled: a point
    that the color camera can't see gets the color of the surface that hides it.

    depth: meters, NaN or 0 where nothing was measured; such a pixel is assumed to be infinitely far away.
    extrinsics: by default the cameras are assumed to share one center and orientation, so that they differ
        in their intrinsics alone. An actual baseline of b meters then shifts the color by fx b / z pixels.
    ValueError if an image's size isn't its camera's, TypeError if depth isn't of floats.
    """
    points = _meters(depth, depth_camera).astype(np.float64)
    _check("color", color.shape, color_camera)
    u, v = np.meshgrid(np.arange(depth_camera.width), np.arange(depth_camera.height))
    measured = np.isfinite(points) & (points > 0)
    in_color_frame = depth_camera.back_project(u, v, np.where(measured, points, 1.0))
    if extrinsics is not None:
        in_color_frame = (
            in_color_frame @ np.asarray(extrinsics.rotation).T + measured[..., None] * extrinsics.translation
        )
    pixels = np.nan_to_num(color_camera.project(in_color_frame), nan=_OUTSIDE_IMAGE).astype(np.float32)
    columns, rows = (np.ascontiguousarray(pixels[..., axis]) for axis in (0, 1))
    return imgproc.remap(np.ascontiguousarray(color), columns, rows)


@dataclass(frozen=True)
class Registration:
    """Maps depth images to a color camera's pixels.

    Both cameras are assumed to share one center and orientation. An actual baseline of b meters shifts the
    depth by fx b / z pixels.
    depth, color: the intrinsics of the two cameras.
    """

    depth: Intrinsics
    color: Intrinsics

    def __call__(self, meters: NDArray[Any]) -> NDArray[np.float32]:
        """The depth (H, W) of each pixel of the color image, from a depth image (h, w); both in meters.

        Each color pixel gets the depth of the nearest depth pixel, as a mean across an edge would be the
        depth of no surface; NaN outside the depth image. As the cameras share one center and orientation, z
        stays the same, columns map to columns, and rows to rows. ValueError if the depth image's size isn't
        its camera's, TypeError if it isn't of floats.
        """
        image = _meters(meters, self.depth).astype(np.float32)
        color, depth = self.color, self.depth
        columns = _nearest(
            (np.arange(color.width) - color.cx) * (depth.fx / color.fx) + depth.cx, depth.width
        )
        rows = _nearest((np.arange(color.height) - color.cy) * (depth.fy / color.fy) + depth.cy, depth.height)
        return np.pad(image, 1, constant_values=np.nan)[np.ix_(rows, columns)]

    def boxes(self, in_depth: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert boxes (N, 4), x, y, width, height, from depth pixels to color pixels; NaN stays NaN."""
        color, depth = self.color, self.depth
        scale = np.array([color.fx / depth.fx, color.fy / depth.fy])
        depth_center, color_center = (
            np.array([each.cx, each.cy]) + 0.5 for each in (depth, color)
        )  # in box coordinates
        return np.hstack([(in_depth[:, :2] - depth_center) * scale + color_center, in_depth[:, 2:] * scale])


@dataclass(frozen=True)
class Reprojection:
    """Maps depth images to the pixels of a color camera in another place.

    depth, color: the intrinsics of the two cameras. extrinsics: depth to color camera.
    """

    depth: Intrinsics
    color: Intrinsics
    extrinsics: Extrinsics

    def __call__(self, meters: NDArray[Any]) -> NDArray[np.float32]:
        """The depth (H, W) of each pixel of the color image, from a depth image (h, w); both in meters.

        A depth pixel covers the area between the projections of its four corners, so that a finer or rotated
        color image has no gaps. If several cover one color pixel, it gets the nearest surface; if none does,
        beside edges and outside the depth image, NaN. ValueError if the depth image's size isn't its
        camera's, TypeError if it isn't of floats.
        """
        image = _meters(meters, self.depth).astype(np.float32)
        with np.errstate(invalid="ignore"):
            z = np.where((image > 0) & np.isfinite(image), image, np.float32(np.nan))
        corners = [self._project(corner, z) for corner in self._corners]
        columns, rows = (_covered([corner[axis] for corner in corners]) for axis in (0, 1))
        depth = z * self._middle[..., 2] + np.float32(self.extrinsics.translation[2])
        return self._nearest_of(depth, columns, rows)

    @cached_property
    def _corners(self) -> list[NDArray[np.float32]]:
        """The directions of the rays through each pixel's corners, in the color camera's frame."""
        return [self._rays(right, down) for right in (-0.5, 0.5) for down in (-0.5, 0.5)]

    @cached_property
    def _middle(self) -> NDArray[np.float32]:
        return self._rays(0.0, 0.0)

    def _rays(self, right: float, down: float) -> NDArray[np.float32]:
        """(h, w, 3): the point of each pixel at a depth of 1 m, rotated into the color camera's frame.

        right, down: pixels from the pixel's center.
        """
        u, v = np.meshgrid(np.arange(self.depth.width), np.arange(self.depth.height))
        points = self.depth.back_project(u + right, v + down, 1.0)
        rays: NDArray[np.float32] = (points @ np.asarray(self.extrinsics.rotation).T).astype(np.float32)
        return rays

    def _project(self, rays: NDArray[np.float32], z: NDArray[np.float32]) -> list[NDArray[np.float32]]:
        """Columns and rows (h, w) in the color image; NaN without depth, or behind the camera."""
        x, y, forward = (
            z * rays[..., axis] + np.float32(self.extrinsics.translation[axis]) for axis in range(3)
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            inverse = np.where(forward > 0, 1 / forward, np.float32(np.nan))
        camera = self.color
        return [
            np.float32(camera.fx) * x * inverse + np.float32(camera.cx),
            np.float32(camera.fy) * y * inverse + np.float32(camera.cy),
        ]

    def _nearest_of(
        self,
        depth: NDArray[np.float32],
        columns: tuple[NDArray[np.intp], NDArray[np.intp]],
        rows: tuple[NDArray[np.intp], NDArray[np.intp]],
    ) -> NDArray[np.float32]:
        height, width = self.color.height, self.color.width
        nearest = np.full(height * width, np.inf, np.float32)
        (left, across), (top, down) = columns, rows
        finer = max(self.color.fx / self.depth.fx, self.color.fy / self.depth.fy)
        most = max(_MAX_COVERED, math.ceil(_NEARER * finer))
        across, down = (np.minimum(count, most) for count in (across, down))
        for dy in range(int(down.max(initial=0))):
            for dx in range(int(across.max(initial=0))):
                x, y = left + dx, top + dy
                hit = (dx < across) & (dy < down) & (x >= 0) & (x < width) & (y >= 0) & (y < height)
                np.minimum.at(nearest, y[hit] * width + x[hit], depth[hit])
        nearest[np.isinf(nearest)] = np.nan
        return nearest.reshape(height, width)


def _covered(corners: list[NDArray[np.float32]]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The first pixel whose center is between the corners, and how many are; 0 where a corner is NaN."""
    low, high = reduce(np.minimum, corners), reduce(np.maximum, corners)
    known = np.isfinite(low) & np.isfinite(high)
    first = np.ceil(np.where(known, low, 0)).clip(-_FAR_OUTSIDE, _FAR_OUTSIDE).astype(np.intp)
    behind = np.ceil(np.where(known, high, 0)).clip(-_FAR_OUTSIDE, _FAR_OUTSIDE).astype(np.intp)
    return first, behind - first


def _nearest(coordinates: NDArray[np.floating[Any]], length: int) -> NDArray[np.intp]:
    """The index, from 1, of the nearest pixel in a row of ``length``; 0 or length + 1 outside the row."""
    nearest: NDArray[np.intp] = np.clip(np.rint(coordinates) + 1, 0, length + 1).astype(np.intp)
    return nearest


def _meters(depth: ArrayLike, camera: Intrinsics) -> NDArray[np.floating[Any]]:
    """The depth image (h, w), checked. Integers aren't meters, and would make a baseline vanish."""
    image = np.asarray(depth)
    if image.dtype.kind != "f":
        hint = "; 0.001 * depth for millimeters" if image.dtype.kind in "iu" else ""
        raise TypeError(f"depth: expected floats, meters, got {image.dtype} {image.shape}{hint}")
    if image.ndim != 2:
        raise ValueError(f"depth: expected one value a pixel, (H, W), got {image.dtype} {image.shape}")
    _check("depth", image.shape, camera)
    return image


def _check(name: str, shape: tuple[int, ...], camera: Intrinsics) -> None:
    if shape[:2] != (camera.height, camera.width):
        height, width = shape[:2]
        raise ValueError(
            f"{name}: expected its camera's size, {camera.width}x{camera.height}, got {width}x{height}"
        )
