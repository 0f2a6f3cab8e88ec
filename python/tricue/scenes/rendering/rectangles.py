# SPDX-License-Identifier: MIT
"""Textured upright rectangles: walls, boards and posters in rooms in front of a stereo pair."""

import numpy as np
from numpy.typing import NDArray

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.stereo_camera import TexturedRectangle

TEXELS_PER_METER = 250.0  # texels per meter


def make_upright_rectangle(
    center: Array, half: Array, yaw: float, texture: list[Picture]
) -> TexturedRectangle:
    """A rectangle around ``center`` (3,), rotated about the vertical by ``yaw``.

    half: (2,) half its width and height, meters.
    """
    along = 2 * half[0] * np.array([np.cos(yaw), 0, np.sin(yaw)])
    down = np.array([0, 2 * half[1], 0])
    return TexturedRectangle(center - (along + down) / 2, along, down, texture)


def make_rectangle_texture(
    kind: str, size: Array, color: NDArray[np.float64], rng: np.random.Generator
) -> list[Picture]:
    """A texture pyramid for a rectangle of this width and height (2,), meters.

    kind: one of textures.SURFACE_KINDS. color: its mean (3,), BGR.
    """
    columns, rows = (size * TEXELS_PER_METER).astype(int).clip(16, 320).tolist()
    return textures.build_pyramid(textures.make_surface(kind, (rows, columns), color, rng))
