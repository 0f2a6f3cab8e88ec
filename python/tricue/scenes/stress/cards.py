# SPDX-License-Identifier: MIT
"""Flat textured cards in front of a pinhole camera, drawn from far to near by homographies.

Color, depth and labels come from one geometry, so that they agree to a fraction of a pixel. Camera frame: x
right, y down, z forward, meters.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.rendering.textures import build_pyramid, select_level

NO_CARD = 0  # the label of pixels without a labeled card
MIN_CARD_DEPTH = 0.2  # meters; nearer cards aren't drawn
OUTLINE_SAMPLES = 4  # along each side of a texel, by which outlines are antialiased


class Card(NamedTuple):
    """A flat textured thing: its texture, its outline, and its size."""

    levels: Sequence[Picture]  # a pyramid (h, w, 4): BGR times opacity, and opacity, 0 to 1
    outline: Array  # (n, 2) corners of the opaque part, in [0, 1] of width and height
    size: tuple[float, float]  # meters, width and height

    @classmethod
    def from_outline(
        cls, picture: NDArray[np.uint8] | Picture, outline: Array, size: tuple[float, float]
    ) -> "Card":
        """A card of an image (h, w, 3), cut along an outline."""
        share = _opacity(outline, *picture.shape[:2])
        cut = np.dstack([picture * share[..., None], share]).astype(np.float32, copy=False)
        return cls(build_pyramid(cut), outline, size)


class CardPose(NamedTuple):
    """The pose of a card: its center (3,), and unit vectors (3,) along its rows and down its columns."""

    center: Array
    along: Array
    down: Array

    def edges(self, card: Card) -> tuple[Array, Array, Array]:
        """The card's upper left corner, and the vectors (3,) of its upper and its left edge, meters."""
        along, down = self.along * card.size[0], self.down * card.size[1]
        return self.center - (along + down) / 2, along, down

    def rotated(self, rotation: Array) -> "CardPose":
        """The pose after a rotation (3, 3) about the origin."""
        return CardPose(rotation @ self.center, rotation @ self.along, rotation @ self.down)

    def points(self, card: Card) -> Array:
        """The corners (n, 3) of a card's outline, meters."""
        corner, along, down = self.edges(card)
        return np.asarray(corner + card.outline @ np.stack([along, down]))


class CardImage(NamedTuple):
    """An image: color (H, W, 3), depth z (H, W) in meters, and the label (H, W) of the card in each pixel."""

    color: Picture
    depth: Picture
    labels: NDArray[np.uint8]

    @classmethod
    def empty(cls, camera: Intrinsics) -> "CardImage":
        shape = camera.height, camera.width
        return cls(
            np.zeros((*shape, 3), np.float32), np.full(shape, np.inf, np.float32), np.zeros(shape, np.uint8)
        )

    def copy(self) -> "CardImage":
        return CardImage(self.color.copy(), self.depth.copy(), self.labels.copy())


class CardCamera(NamedTuple):
    """A camera at (offset, 0, 0)."""

    intrinsics: Intrinsics
    offset: float = 0.0

    def draw(self, canvas: CardImage, card: Card, pose: CardPose, label: int = NO_CARD) -> None:
        """Draw a card over what is there; cards must be drawn from far to near.

        A pixel gets the depth and the label of the card that covers at least half of it; colors are blended.
        """
        place = self._place(pose.points(card))
        if place is None:
            return
        rows, columns = place
        warped = self._warp(card, pose, columns, rows)
        seen = self._cover(canvas, warped, place)
        np.copyto(canvas.depth[place], self._depth(pose, columns, rows), where=seen)
        canvas.labels[place][seen] = label

    def mask(self, card: Card, pose: CardPose) -> Mask:
        """The pixels (H, W) that a card would cover if nothing hid it."""
        mask = np.zeros((self.intrinsics.height, self.intrinsics.width), bool)
        place = self._place(pose.points(card))
        if place is not None:
            mask[place] = self._warp(card, pose, place[1], place[0])[..., 3] > 0.5
        return mask

    def outline(self, card: Card, pose: CardPose) -> Array:
        """A card's outline (n, 2) in the image; as in a Box, (0, 0) is the first pixel's corner."""
        return self.intrinsics.project(pose.points(card) - [self.offset, 0, 0]) + 0.5

    def _cover(self, canvas: CardImage, warped: Picture, place: tuple[slice, slice]) -> Mask:
        opacity = warped[..., 3:]
        part = canvas.color[place]
        part *= 1 - opacity
        part += warped[..., :3]
        return np.asarray(opacity[..., 0] > 0.5)

    def _warp(self, card: Card, pose: CardPose, columns: slice, rows: slice) -> Picture:
        """A card's color and opacity (h, w, 4) in a part of the image."""
        distance = max(float(pose.center[2]), MIN_CARD_DEPTH)
        texels = card.levels[0].shape[1] / card.size[0] * distance / self.intrinsics.fx
        (level,) = select_level(card.levels, texels)
        height, width = level.shape[:2]
        # Texel i of n has its center at (i + 1/2) / n.
        to_unit = np.array([[1 / width, 0, 0.5 / width], [0, 1 / height, 0.5 / height], [0, 0, 1]])
        corner, along, down = pose.edges(card)
        to_ray = np.stack([along, down, corner - [self.offset, 0, 0]], axis=1)
        to_part = np.array([[1, 0, -columns.start], [0, 1, -rows.start], [0, 0, 1]])
        homography = to_part @ self.intrinsics.matrix @ to_ray @ to_unit
        size = rows.stop - rows.start, columns.stop - columns.start
        return imgproc.warp_perspective(level, homography, *size)

    def _depth(self, pose: CardPose, columns: slice, rows: slice) -> Picture:
        """The depth (h, w) of a card's plane: n . (z ray) = n . center."""
        normal = np.cross(pose.along, pose.down)
        x = (np.arange(columns.start, columns.stop) - self.intrinsics.cx) / self.intrinsics.fx
        y = (np.arange(rows.start, rows.stop) - self.intrinsics.cy) / self.intrinsics.fy
        share = (normal[0] * x + normal[2])[None, :] + (normal[1] * y)[:, None]
        return np.asarray(normal @ (pose.center - [self.offset, 0, 0]) / share, np.float32)

    def _place(self, points: Array) -> tuple[slice, slice] | None:
        """The rows and columns that a card with these corners may cover; None if there are none."""
        if points[:, 2].min() < MIN_CARD_DEPTH:
            return None
        x, y = self.intrinsics.project(points - [self.offset, 0, 0]).T
        left, right = (int(np.clip(side, 0, self.intrinsics.width)) for side in (x.min() - 1, x.max() + 2))
        top, bottom = (int(np.clip(side, 0, self.intrinsics.height)) for side in (y.min() - 1, y.max() + 2))
        return None if left >= right or top >= bottom else (slice(top, bottom), slice(left, right))


def rectangle_outline() -> Array:
    """The outline of a whole rectangle."""
    return np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])


def superellipse(power: float) -> Array:
    """The outline of a superellipse: power 2 is an ellipse, larger ones approach a rectangle."""
    angle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    cos, sin = np.cos(angle), np.sin(angle)
    return 0.5 + 0.5 * np.stack([np.sign(v) * np.abs(v) ** (2 / power) for v in (cos, sin)], axis=1)


def face_camera(center: Array, roll: float, yaw: float) -> CardPose:
    """The pose of a card that faces the camera except for a roll in the image and a yaw, radians."""
    cos, sin = np.cos(roll), np.sin(roll)
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    return CardPose(center, turn @ [cos, sin, 0], turn @ [-sin, cos, 0])


def _opacity(outline: Array, height: int, width: int) -> Picture:
    """The share (height, width) of each texel that is inside an outline."""
    if np.array_equal(outline, rectangle_outline()):
        return np.ones((height, width), np.float32)
    fine = height * OUTLINE_SAMPLES, width * OUTLINE_SAMPLES
    corners = np.rint(outline * fine[::-1] - 0.5).astype(np.int32)
    return imgproc.resize(imgproc.fill_polygon(corners, *fine), height, width, "area")
