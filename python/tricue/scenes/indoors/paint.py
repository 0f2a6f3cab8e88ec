# SPDX-License-Identifier: MIT
"""The colors of bodies: skin with creases and nails, a head's texture, cloth. BGR levels of 255."""

from copy import deepcopy
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.indoors.hand import (
    FINGER_PAINT,
    FINGERTIP_PAINT,
    HEAD_PAINT,
    SHIRT_PAINT,
    SKIN_PAINT,
    TROUSERS_PAINT,
)
from tricue.scenes.indoors.surface import Integers, Surface
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.textures import Looks

HEAD_AXES = np.array([0.078, 0.108, 0.095], np.float32)  # meters, of the textured ellipsoid
SKIN_PERIOD, CLOTH_PERIOD = 0.12, 0.5  # meters, of the textures along a limb
SKIN_PAINTS = (SKIN_PAINT, FINGER_PAINT, FINGERTIP_PAINT)
NAIL_HALF_ANGLE = 0.75  # radians


class HeadFrame(NamedTuple):
    """The pose of the head's texture."""

    middle: Array  # (3,) meters
    rotation: Array  # (3, 3)
    size: float


class Paints(NamedTuple):
    """A person's textures."""

    looks: Looks
    skin: Picture  # (h, w, 3)
    head: Picture  # (h, w, 4), the last channel 1 where it is skin, 0 where it is hair
    shirt: Picture
    trousers: Picture

    @classmethod
    def sample(cls, looks: Looks, rng: np.random.Generator) -> "Paints":
        """Random textures for a person of these looks."""
        kinds = (str(rng.choice(textures.SURFACE_KINDS[:4])), textures.PLAIN_SURFACE)
        cloths = [textures.make_surface(kind, (128, 256), textures.random_color(rng), rng) for kind in kinds]
        skin = textures.make_skin((128, 128), looks.skin, rng)
        # The same head in black and white shows where the hair is.
        marks = looks._replace(skin=np.full(3, 200.0), hair=np.zeros(3))
        marked = textures.make_head(marks, deepcopy(rng)).max(axis=2, keepdims=True) > 100
        head = np.concatenate([textures.make_head(looks, rng), marked.astype(np.float32)], axis=2)
        return cls(looks, skin, head, *cloths)

    def colors(
        self, points: Picture, surface: Surface, materials: Integers, lengths: Array, head: HeadFrame | None
    ) -> tuple[Picture, Picture]:
        """The colors (m, 3) of points on a surface, and shares of skin (m,). materials, lengths: per cone."""
        paints = materials[surface.parts]
        along = surface.shares * lengths[surface.parts].astype(np.float32)
        turn = surface.angles / np.float32(2 * np.pi) + np.float32(0.5)
        skin = np.isin(paints, SKIN_PAINTS).astype(np.float32)
        colors = sample_periodic(self.skin, along / np.float32(SKIN_PERIOD) + 0.37 * surface.parts, turn)
        for paint, mark in ((FINGER_PAINT, _creases), (FINGERTIP_PAINT, _nails)):
            chosen = paints == paint
            if chosen.any():
                colors[chosen] = mark(colors[chosen], surface.shares[chosen], surface.angles[chosen])
        for paint, cloth in ((SHIRT_PAINT, self.shirt), (TROUSERS_PAINT, self.trousers)):
            chosen = paints == paint
            colors[chosen] = sample_periodic(cloth, along[chosen] / np.float32(CLOTH_PERIOD), turn[chosen])
        chosen = paints == HEAD_PAINT
        if chosen.any() and head is not None:
            local = (points[chosen] - head.middle.astype(np.float32)) @ head.rotation.astype(np.float32)
            sampled = self._sample_head(local / np.float32(head.size))
            colors[chosen], skin[chosen] = sampled[:, :3], sampled[:, 3]
        return colors, skin

    def _sample_head(self, local: Picture) -> Picture:
        q = local / HEAD_AXES
        q /= np.maximum(np.linalg.norm(q, axis=1, keepdims=True), np.float32(1e-9))
        longitude, latitude = np.arctan2(q[:, 0], q[:, 2]), np.arcsin(np.clip(q[:, 1], -1, 1))
        rows = np.clip(latitude / np.float32(np.pi) + 0.5, 0.004, 0.996)
        return sample_periodic(self.head, rows, longitude / np.float32(2 * np.pi) + np.float32(0.5))


def sample_periodic(texture: Picture, v: Picture, u: Picture) -> Picture:
    """The colors (m, channels) of a periodic texture at v, u (m,), in its heights and widths, bilinearly."""
    height, width = texture.shape[:2]
    rows, columns = v * np.float32(height) - np.float32(0.5), u * np.float32(width) - np.float32(0.5)
    top, left = np.floor(rows), np.floor(columns)
    down, right = (rows - top)[:, None], (columns - left)[:, None]
    r0, c0 = top.astype(np.int64) % height, left.astype(np.int64) % width
    r1, c1 = (r0 + 1) % height, (c0 + 1) % width
    upper = texture[r0, c0] * (1 - right) + texture[r0, c1] * right
    lower = texture[r1, c0] * (1 - right) + texture[r1, c1] * right
    return np.asarray(upper * (1 - down) + lower * down, np.float32)


def _creases(colors: Picture, shares: Picture, angles: Picture) -> Picture:
    """Make the skin darker and redder at both joints of a bone."""
    fold = np.exp(-(((np.minimum(shares, 1 - shares)) / 0.09) ** 2))[:, None]
    return np.asarray(colors * (1 - fold * np.array([0.20, 0.17, 0.07], np.float32)), np.float32)


def _nails(colors: Picture, shares: Picture, angles: Picture) -> Picture:
    """Paint reddish fingertips, with a nail on the back."""
    red = (0.25 * shares)[:, None] * np.array([0.35, 0.30, 0.0], np.float32)
    colors = colors * (1 - red)
    across, along = angles / np.float32(NAIL_HALF_ANGLE), (shares - np.float32(0.78)) / np.float32(0.42)
    inside = np.clip(3 * (1 - across**2 - along**2) + 0.5, 0, 1)[:, None]
    nail = colors * np.array([1.12, 1.10, 1.08], np.float32) + np.float32(8)
    return np.asarray(colors * (1 - 0.7 * inside) + 0.7 * inside * nail, np.float32)
