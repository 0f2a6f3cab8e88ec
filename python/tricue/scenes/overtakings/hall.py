# SPDX-License-Identifier: MIT
"""A hall behind people who walk past a stereo pair that turns: walls, a floor, and things at all depths."""

import math
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.boards import board_texture, upright
from tricue.scenes.rendering.stereo_camera import Board, Canvas, Eye

THINGS = 16
CLEAR = 1.4  # metres that things stay behind who walks farthest away
SIDE = 7.0  # metres to the walls at the sides
TOP, REACH = 5.0, 3.2  # metres above the floor: of the walls, and of what hangs on them
LAP = 0.01  # metres that boards reach over each other, so that no ray passes between them
FLOOR = np.array([3.0, 4.8, 5.8, 7.0, 8.6, 11.0])  # metres, z of the floor's strips


class Hall(NamedTuple):
    """All that doesn't move, in the level frame."""

    boards: list[Board]

    def draw(self, eye: Eye, to_camera: Array) -> Canvas:
        """The hall as a camera's rays see it that has turned."""
        shape = eye.intrinsics.height, eye.intrinsics.width
        canvas = Canvas(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))
        for corner, along, down, texture in self.boards:
            eye.draw_board(canvas, Board(to_camera @ corner, to_camera @ along, to_camera @ down, texture))
        return canvas

    def seen_at(self, focal: float) -> "Hall":
        """The same with textures as detailed as a camera of this focal length (pixels) sees them."""
        return Hall([_in_detail(board, focal) for board in self.boards])


def furnish(floor: float, farthest: float, angles: tuple[float, float], rng: np.random.Generator) -> Hall:
    """A hall whose floor is at the height y = ``floor``.

    farthest: metres from the cameras up to which people walk; angles: what the cameras see, radians.
    """
    wall = farthest + rng.uniform(3.5, 6.0)
    boards = [*_walls(wall, floor, rng), *_floor(wall, floor, rng)]
    low, high = (float(np.clip(angle, -1.0, 1.0)) for angle in angles)
    for place in rng.permutation(THINGS).tolist():
        # One in each of as many sectors, so that there is something everywhere.
        angle = low + (place + rng.random()) / THINGS * (high - low)
        deepest = min(wall / math.cos(angle), SIDE / max(abs(math.sin(angle)), 1e-6)) - 0.3
        near = farthest + CLEAR
        depth = near + max(deepest - near, 0.0) * rng.random()
        boards.append(_thing(angle, depth, floor, rng))
    return Hall(boards)


def _walls(depth: float, floor: float, rng: np.random.Generator) -> list[Board]:
    """Behind and at both sides, higher than the images reach."""
    kind = str(rng.choice([textures.PLAIN, textures.BLOTCHES, textures.WOOD]))
    color = 0.5 * textures.any_color(rng) + rng.uniform(50, 100)
    top, high = floor - TOP, np.array([0, TOP + LAP, 0])
    walls = [
        (np.array([-SIDE - LAP, top, depth]), np.array([2 * (SIDE + LAP), 0, 0])),
        (np.array([-SIDE, top, 0]), np.array([0, 0, depth])),
        (np.array([SIDE, top, depth]), np.array([0, 0, -depth])),
    ]
    return [
        Board(corner, along, high, textures.pyramid(textures.surface(kind, (512, 1280), color, rng)))
        for corner, along in walls
    ]


def _floor(depth: float, floor: float, rng: np.random.Generator) -> list[Board]:
    """In strips, as no one level of its texture suits what is near and what is far."""
    kind = str(rng.choice([textures.PLAIN, textures.WOOD, textures.STRIPES, textures.BLOTCHES]))
    color = 0.6 * textures.any_color(rng) + 40
    texture = textures.surface(kind, (800, 1280), color, rng)
    edges = np.append(FLOOR[depth - 0.5 > FLOOR], depth)
    rows = np.rint((edges - edges[0]) / (edges[-1] - edges[0]) * len(texture)).astype(int)
    return [
        Board(
            np.array([-SIDE - LAP, floor, start]),
            np.array([2 * (SIDE + LAP), 0, 0]),
            np.array([0, 0, stop - start + LAP]),
            textures.pyramid(np.ascontiguousarray(texture[first:last])),
        )
        for start, stop, first, last in zip(edges[:-1], edges[1:], rows[:-1], rows[1:], strict=True)
    ]


def _thing(angle: float, depth: float, floor: float, rng: np.random.Generator) -> Board:
    """A cupboard on the floor, or something on a wall or a stand; it faces the cameras, more or less."""
    half = rng.uniform([0.25, 0.3], [0.7, 1.0])
    stands = rng.random() < 0.6
    y = floor - half[1] if stands else floor - rng.uniform(half[1] + 0.2, REACH - half[1])
    center = np.array([math.sin(angle) * depth, y, math.cos(angle) * depth])
    kind = str(rng.choice([textures.WOOD, textures.STRIPES, textures.BLOTCHES, textures.THINGS]))
    texture = board_texture(kind, 2 * half, textures.any_color(rng), rng)
    return upright(center, half, rng.uniform(-0.5, 0.5) - angle, texture)


def _in_detail(board: Board, focal: float) -> Board:
    middle = board.corner + (board.along + board.down) / 2
    texels = board.texture[0].shape[1] / float(np.linalg.norm(board.along)) * float(np.hypot(*middle[[0, 2]]))
    return board._replace(texture=textures.at_detail(board.texture, texels / focal))
