# SPDX-License-Identifier: MIT
"""A room behind somebody who walks before a stereo pair: wall, floor, and things at all depths."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.boards import board_texture, upright
from tricue.scenes.rendering.stereo_camera import Board, Canvas, Eye, Lamp, Solid

APART = 0.35  # metres that a thing is behind the head, where it is on the same line of sight
HEAD = 0.16  # metres, radius of what has to stay free round the head's centre
THINGS, TRIES = 12, 60


class Room(NamedTuple):
    """All that doesn't move."""

    boards: list[Board]
    solids: list[Solid]


def furnish(
    rig: StereoRig, path: Array, floor: float, skin: NDArray[np.float64] | None, rng: np.random.Generator
) -> Room:
    """A room for a head that walks along ``path`` (M, 3).

    Wherever things stand, the head is before them. skin: a color (3,) that some things have, on the lines of
    sight to the path; None for none.
    """
    wall = float(path[:, 2].max()) + rng.uniform(1.0, 2.5)
    boards = [_wall(wall, rng), _floor(floor, wall, rng)]
    slope = (
        np.array([rig.intrinsics.width / rig.intrinsics.fx, rig.intrinsics.height / rig.intrinsics.fy]) / 2
    )
    for _ in range(TRIES):
        if len(boards) == THINGS:
            break
        depth = wall - (wall - 0.8) * rng.random() ** 2 * 0.95
        half = rng.uniform(0.1, 0.5, 2) * min(depth / 3, 1)
        center = np.append(rng.uniform(-1.1, 1.1, 2) * slope, 1.0) * depth
        if is_clear(center, float(np.hypot(*half)), path):
            texture = board_texture(
                str(rng.choice(textures.SURFACES)), 2 * half, textures.any_color(rng), rng
            )
            boards.append(upright(center, half, rng.uniform(-0.5, 0.5), texture))
    if skin is None:
        return Room(boards, [])
    mimics = _mimics(path, wall, skin, rng)
    return Room(boards + mimics.boards, mimics.solids)


def draw(eye: Eye, room: Room, lamp: Lamp) -> Canvas:
    """The room as a camera's rays see it."""
    shape = eye.intrinsics.height, eye.intrinsics.width
    canvas = Canvas(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))
    for board in room.boards:
        eye.draw_board(canvas, board)
    eye.draw_solids(canvas, room.solids, lamp)
    return canvas


def is_clear(center: Array, radius: float, path: Array) -> bool:
    """Whether the head is before a thing, with room to spare, wherever it is on its lines of sight."""
    apart = np.hypot(*(path[:, :2] / path[:, 2:] - center[:2] / center[2]).T)
    meets = apart < HEAD / path[:, 2] + radius / center[2] + 0.05  # parallax of the right camera
    return bool(np.all(center[2] - radius > path[meets, 2] + APART))


def _mimics(path: Array, wall: float, skin: NDArray[np.float64], rng: np.random.Generator) -> Room:
    """Things of the color of skin behind the path: a door or a box, and some of a head's size."""
    room = Room([], [])
    for index in range(4):
        on_path = path[rng.integers(len(path))]
        depth = rng.uniform(on_path[2] + 0.6, max(min(on_path[2] + 1.8, wall - 0.25), on_path[2] + 0.65))
        center = on_path / on_path[2] * depth + np.append(rng.uniform(-0.2, 0.2, 2), 0)
        color = skin * rng.uniform(0.85, 1.05) * rng.uniform(0.95, 1.05, 3)
        half = rng.uniform([0.15, 0.25], [0.4, 0.6]) if index == 0 else rng.uniform(0.07, 0.14, 2)
        if not is_clear(center, 0.2, path):
            continue
        if index == 0:
            kind = str(rng.choice([textures.PLAIN, textures.WOOD]))
            room.boards.append(
                upright(center, half, rng.uniform(-0.4, 0.4), board_texture(kind, 2 * half, color, rng))
            )
        else:
            unit = np.diag(1 / np.array([*half, half.mean()]))
            room.solids.append(Solid(center, unit, textures.pyramid(textures.skin((128, 256), color, rng))))
    return room


def _wall(depth: float, rng: np.random.Generator) -> Board:
    """The back wall, which isn't quite parallel to the images."""
    kind = str(rng.choice([textures.PLAIN, textures.BLOTCHES, textures.WOOD]))
    color = 0.5 * textures.any_color(rng) + rng.uniform(40, 90)
    texture = textures.pyramid(textures.surface(kind, (512, 1024), color, rng))
    return upright(np.array([0, 0, depth]), np.array([8.0, 4.5]), rng.uniform(-0.15, 0.15), texture)


def _floor(below: float, depth: float, rng: np.random.Generator) -> Board:
    kind = str(rng.choice([textures.PLAIN, textures.WOOD, textures.STRIPES, textures.BLOTCHES]))
    texture = textures.pyramid(textures.surface(kind, (512, 512), textures.any_color(rng), rng))
    size = 2 * depth
    return Board(np.array([-depth, below, 0.1]), np.array([size, 0, 0]), np.array([0, 0, size]), texture)
