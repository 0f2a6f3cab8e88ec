# SPDX-License-Identifier: MIT
"""A color image in the pixels of a depth camera that stands beside the color camera, and the other way
round.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.rig import Intrinsics

_OUTSIDE = -2.0  # pixels; where no image is


class Extrinsics(NamedTuple):
    """How the cameras stand: x_color = rotation @ x_depth + translation, (3, 3) and (3,) metres."""

    rotation: NDArray[np.float64] = np.eye(3)
    translation: NDArray[np.float64] = np.zeros(3)


def color_in_depth(
    color: NDArray[np.uint8],
    depth: ArrayLike,
    depth_camera: Intrinsics,
    color_camera: Intrinsics,
    extrinsics: Extrinsics | None = None,
) -> NDArray[np.uint8]:
    """The color (h, w, 3) seen in each pixel of a depth image (h, w), by its point in space; black where that
    isn't in the color image (H, W, 3).

    depth: metres, NaN or 0 where nothing was measured; such a pixel is taken for infinitely far.
    extrinsics: without them both cameras are taken to stand in one place and to look the same way, so that
    they differ in their intrinsics alone: b metres between them that nobody told are fx b / z pixels.

    What the color camera doesn't see because something nearer is before it gets the color of that. ValueError
    where an image has another size than its camera.
    """
    points = np.asarray(depth, np.float64)
    _check("depth", points.shape, depth_camera)
    _check("color", color.shape, color_camera)
    u, v = np.meshgrid(np.arange(depth_camera.width), np.arange(depth_camera.height))
    measured = np.isfinite(points) & (points > 0)
    seen = depth_camera.back_project(u, v, np.where(measured, points, 1.0))
    if extrinsics is not None:
        seen = seen @ np.asarray(extrinsics.rotation).T + measured[..., None] * extrinsics.translation
    places = np.nan_to_num(color_camera.project(seen), nan=_OUTSIDE).astype(np.float32)
    found = cv2.remap(color, places[..., 0], places[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
    return np.asarray(found, np.uint8)


@dataclass(frozen=True)
class Registration:
    """Brings depth into a color camera's pixels. Both cameras are taken to stand in one place and to look the
    same way: b metres between them that nobody told are fx b / z pixels.

    depth, color: the two cameras.
    """

    depth: Intrinsics
    color: Intrinsics

    def __call__(self, metres: NDArray[Any]) -> NDArray[np.float32]:
        """The depth (H, W) in each pixel of the color image: that of the nearest pixel of the depth image
        (h, w), as the mean over an edge is the depth of nothing. NaN outside of the depth image.

        From one place both cameras see a point on the same ray, so that z stays, and a column of the one is a
        column of the other. ValueError where the depth image has another size than its camera.
        """
        image = np.asarray(metres, np.float32)
        _check("depth", image.shape, self.depth)
        to, of = self.color, self.depth
        columns = _nearest((np.arange(to.width) - to.cx) * (of.fx / to.fx) + of.cx, of.width)
        rows = _nearest((np.arange(to.height) - to.cy) * (of.fy / to.fy) + of.cy, of.height)
        return np.pad(image, 1, constant_values=np.nan)[np.ix_(rows, columns)]

    def boxes(self, found: NDArray[np.float64]) -> NDArray[np.float64]:
        """The depth image's boxes (N, 4), x, y, width, height, in the color image's pixels; NaN stays NaN."""
        to, of = self.color, self.depth
        scale = np.array([to.fx / of.fx, to.fy / of.fy])
        of_center, to_center = (np.array([each.cx, each.cy]) + 0.5 for each in (of, to))  # as boxes count
        return np.hstack([(found[:, :2] - of_center) * scale + to_center, found[:, 2:] * scale])


def _nearest(places: NDArray[np.floating[Any]], length: int) -> NDArray[np.intp]:
    """The nearest of so many pixels, counted from 1; 0 or length + 1 outside of them."""
    nearest: NDArray[np.intp] = np.clip(np.rint(places) + 1, 0, length + 1).astype(np.intp)
    return nearest


def _check(name: str, shape: tuple[int, ...], camera: Intrinsics) -> None:
    if shape[:2] != (camera.height, camera.width):
        height, width = shape[:2]
        raise ValueError(
            f"{name}: expected its camera's size, {camera.width}x{camera.height}, got {width}x{height}"
        )
