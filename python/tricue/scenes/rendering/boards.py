# SPDX-License-Identifier: MIT
"""Textured upright rectangles: walls, boards and posters in rooms before a stereo pair."""

import numpy as np
from numpy.typing import NDArray

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.stereo_camera import Board

FINEST = 250.0  # texels a metre


def upright(center: Array, half: Array, yaw: float, texture: list[Picture]) -> Board:
    """A board round ``center`` (3,), half its width and height (2,), turned about the vertical by ``yaw``."""
    along = 2 * half[0] * np.array([np.cos(yaw), 0, np.sin(yaw)])
    down = np.array([0, 2 * half[1], 0])
    return Board(center - (along + down) / 2, along, down, texture)


def board_texture(
    kind: str, size: Array, color: NDArray[np.float64], rng: np.random.Generator
) -> list[Picture]:
    """One of textures.SURFACES for a board of this width and height (2,), metres, about a color (3,)."""
    columns, rows = (size * FINEST).astype(int).clip(16, 320).tolist()
    return textures.pyramid(textures.surface(kind, (rows, columns), color, rng))
