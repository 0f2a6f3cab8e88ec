# SPDX-License-Identifier: MIT
"""Flat textured cards before a pinhole camera, drawn from far to near by homographies.

One geometry gives color, depth and who is seen where, so that they agree to a fraction of a pixel, and takes
a millisecond a card. Frame: the camera's, x right, y down, z forward, metres.
"""

from collections.abc import Sequence
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.scenes.body import Array
from tricue.scenes.depth_camera import Mask
from tricue.scenes.paste import Picture
from tricue.scenes.textures import at_detail, pyramid

NOBODY = 0  # the number of what has no name in an image of names
NEAREST = 0.2  # metres
FINE = 4  # parts of a texel's side in which outlines are filled


class Card(NamedTuple):
    """A flat thing: its picture, what part of it is there, and its size."""

    levels: Sequence[Picture]  # a pyramid (h, w, 4): BGR times opacity, and opacity in [0, 1]
    outline: Array  # (n, 2) corners of the part that is there, in [0, 1] of width and height
    size: tuple[float, float]  # metres, width and height

    @classmethod
    def cut(cls, picture: NDArray[np.uint8] | Picture, outline: Array, size: tuple[float, float]) -> "Card":
        """A picture (h, w, 3) cut along an outline."""
        share = _opacity(outline, *picture.shape[:2])[..., None]
        cut = np.empty((*picture.shape[:2], 4), np.float32)
        np.multiply(picture, share, out=cut[..., :3])
        cut[..., 3:] = share
        return cls(pyramid(cut), outline, size)


class Pose(NamedTuple):
    """Where a card is: its middle (3,), and the unit vectors (3,) along its rows and down its columns."""

    center: Array
    along: Array
    down: Array

    def sides(self, card: Card) -> tuple[Array, Array, Array]:
        """Its first corner, and the vectors along its upper and down its left side, metres."""
        along, down = self.along * card.size[0], self.down * card.size[1]
        return self.center - (along + down) / 2, along, down

    def turned(self, rotation: Array) -> "Pose":
        """The same after a rotation (3, 3) about the origin."""
        return Pose(rotation @ self.center, rotation @ self.along, rotation @ self.down)

    def points(self, card: Card) -> Array:
        """The outline's corners (n, 3), metres."""
        corner, along, down = self.sides(card)
        return np.asarray(corner + card.outline @ np.stack([along, down]))


class Canvas(NamedTuple):
    """What is in each pixel: color (H, W, 3), depth z (H, W) in metres, and the name (H, W) of the card."""

    color: Picture
    depth: Picture
    names: NDArray[np.uint8]

    @classmethod
    def empty(cls, camera: Intrinsics) -> "Canvas":
        shape = camera.height, camera.width
        return cls(
            np.zeros((*shape, 3), np.float32), np.full(shape, np.inf, np.float32), np.zeros(shape, np.uint8)
        )

    def copy(self) -> "Canvas":
        return Canvas(self.color.copy(), self.depth.copy(), self.names.copy())


class Eye(NamedTuple):
    """A camera that stands at (offset, 0, 0)."""

    camera: Intrinsics
    offset: float = 0.0

    def draw(self, canvas: Canvas, card: Card, pose: Pose, name: int = NOBODY) -> None:
        """Lay a card over what is there, so that cards have to come from far to near.

        A pixel's depth and name are those of the card that covers half of it or more; its color is mixed.
        """
        place = self._place(pose.points(card))
        if place is None:
            return
        rows, columns = place
        warped = self._warp(card, pose, columns, rows)
        seen = self._cover(canvas, warped, place)
        np.copyto(canvas.depth[place], self._depth(pose, columns, rows), where=seen)
        canvas.names[place][seen] = name

    def mask(self, card: Card, pose: Pose) -> Mask:
        """The pixels (H, W) that a card covers where nothing is before it."""
        mask = np.zeros((self.camera.height, self.camera.width), bool)
        place = self._place(pose.points(card))
        if place is not None:
            mask[place] = self._warp(card, pose, place[1], place[0])[..., 3] > 0.5
        return mask

    def outline(self, card: Card, pose: Pose) -> Array:
        """The outline in the image (n, 2); as in a Box (0, 0) is the first pixel's corner, not its centre."""
        return self.camera.project(pose.points(card) - [self.offset, 0, 0]) + 0.5

    def _cover(self, canvas: Canvas, warped: Picture, place: tuple[slice, slice]) -> Mask:
        opacity = warped[..., 3:]
        part = canvas.color[place]
        part *= 1 - opacity
        part += warped[..., :3]
        return np.asarray(opacity[..., 0] > 0.5)

    def _warp(self, card: Card, pose: Pose, columns: slice, rows: slice) -> Picture:
        """The card's picture in a part of the image, (h, w, 4)."""
        distance = max(float(pose.center[2]), NEAREST)
        texels = card.levels[0].shape[1] / card.size[0] * distance / self.camera.fx
        (level,) = at_detail(card.levels, texels)
        height, width = level.shape[:2]
        # A texel's centre is at (its number + 1/2) / count of the side.
        to_unit = np.array([[1 / width, 0, 0.5 / width], [0, 1 / height, 0.5 / height], [0, 0, 1]])
        corner, along, down = pose.sides(card)
        to_ray = np.stack([along, down, corner - [self.offset, 0, 0]], axis=1)
        to_part = np.array([[1, 0, -columns.start], [0, 1, -rows.start], [0, 0, 1]])
        size = columns.stop - columns.start, rows.stop - rows.start
        return np.asarray(cv2.warpPerspective(level, to_part @ self.camera.matrix @ to_ray @ to_unit, size))

    def _depth(self, pose: Pose, columns: slice, rows: slice) -> Picture:
        """The depth (h, w) of the card's plane: n . (z ray) = n . center."""
        normal = np.cross(pose.along, pose.down)
        x = (np.arange(columns.start, columns.stop) - self.camera.cx) / self.camera.fx
        y = (np.arange(rows.start, rows.stop) - self.camera.cy) / self.camera.fy
        share = (normal[0] * x + normal[2])[None, :] + (normal[1] * y)[:, None]
        return np.asarray(normal @ (pose.center - [self.offset, 0, 0]) / share, np.float32)

    def _place(self, points: Array) -> tuple[slice, slice] | None:
        """The rows and columns that a card of these corners may cover; None for none."""
        if points[:, 2].min() < NEAREST:
            return None
        x, y = self.camera.project(points - [self.offset, 0, 0]).T
        left, right = (int(np.clip(side, 0, self.camera.width)) for side in (x.min() - 1, x.max() + 2))
        top, bottom = (int(np.clip(side, 0, self.camera.height)) for side in (y.min() - 1, y.max() + 2))
        return None if left >= right or top >= bottom else (slice(top, bottom), slice(left, right))


def rectangle() -> Array:
    """The outline of a whole picture."""
    return np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])


def rounded(power: float) -> Array:
    """A superellipse that fills the picture: 2 is an ellipse, more are rectangles with round corners."""
    angle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    cos, sin = np.cos(angle), np.sin(angle)
    return 0.5 + 0.5 * np.stack([np.sign(v) * np.abs(v) ** (2 / power) for v in (cos, sin)], axis=1)


def facing(center: Array, roll: float, yaw: float) -> Pose:
    """A card that faces the camera but for a roll in the image and a turn about its upright, radians."""
    cos, sin = np.cos(roll), np.sin(roll)
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    return Pose(center, turn @ [cos, sin, 0], turn @ [-sin, cos, 0])


def _opacity(outline: Array, height: int, width: int) -> Picture:
    """The share of each texel (height, width) within an outline."""
    if np.array_equal(outline, rectangle()):
        return np.ones((height, width), np.float32)
    fine = np.zeros((height * FINE, width * FINE), np.float32)
    cv2.fillPoly(fine, [np.rint(outline * [width * FINE, height * FINE] - 0.5).astype(np.int32)], 1.0)
    return np.asarray(cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA), np.float32)
