# SPDX-License-Identifier: MIT
"""A room behind a person in front of a stereo pair: wall, floor, and textured things at all depths."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.rectangles import make_rectangle_texture, make_upright_rectangle
from tricue.scenes.rendering.stereo_camera import (
    RayCamera,
    RayImage,
    TexturedEllipsoid,
    TexturedRectangle,
    WhiteLamp,
)

MIN_GAP_BEHIND_HEAD = 0.35  # meters between a thing and the head on one line of sight
HEAD_RADIUS = 0.16  # meters, of the space around the head's center that stays free
MAX_RECTANGLES, MAX_RECTANGLE_TRIES = 12, 60


class StereoRoom(NamedTuple):
    """The static things of a scene, in the left camera's frame."""

    rectangles: list[TexturedRectangle]
    ellipsoids: list[TexturedEllipsoid]


def furnish_room(
    rig: StereoRig, path: Array, floor: float, skin: NDArray[np.float64] | None, rng: np.random.Generator
) -> StereoRoom:
    """A random room for a head that moves along ``path`` (M, 3), meters, always in front of all things.

    floor: its height y, meters. skin: a BGR color (3,) for some things on lines of sight to the path; None
    for no such things.
    """
    wall = float(path[:, 2].max()) + rng.uniform(1.0, 2.5)
    rectangles = [_wall(wall, rng), _floor(floor, wall, rng)]
    slope = (
        np.array([rig.intrinsics.width / rig.intrinsics.fx, rig.intrinsics.height / rig.intrinsics.fy]) / 2
    )
    for _ in range(MAX_RECTANGLE_TRIES):
        if len(rectangles) == MAX_RECTANGLES:
            break
        depth = wall - (wall - 0.8) * rng.random() ** 2 * 0.95
        half = rng.uniform(0.1, 0.5, 2) * min(depth / 3, 1)
        center = np.append(rng.uniform(-1.1, 1.1, 2) * slope, 1.0) * depth
        if is_clear(center, float(np.hypot(*half)), path):
            texture = make_rectangle_texture(
                str(rng.choice(textures.SURFACE_KINDS)), 2 * half, textures.random_color(rng), rng
            )
            rectangles.append(make_upright_rectangle(center, half, rng.uniform(-0.5, 0.5), texture))
    if skin is None:
        return StereoRoom(rectangles, [])
    skin_colored = _place_skin_colored_things(path, wall, skin, rng)
    return StereoRoom(rectangles + skin_colored.rectangles, skin_colored.ellipsoids)


def render_room(camera: RayCamera, room: StereoRoom, lamp: WhiteLamp) -> RayImage:
    """Render the room for a camera."""
    shape = camera.intrinsics.height, camera.intrinsics.width
    canvas = RayImage(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))
    for rectangle in room.rectangles:
        camera.draw_rectangle(canvas, rectangle)
    camera.draw_ellipsoids(canvas, room.ellipsoids, lamp)
    return canvas


def is_clear(center: Array, radius: float, path: Array) -> bool:
    """Whether the head stays in front of a thing, with a margin, wherever they share a line of sight.

    center, radius: the thing's, meters. path: (M, 3) of the head.
    """
    apart = np.hypot(*(path[:, :2] / path[:, 2:] - center[:2] / center[2]).T)
    meets = apart < HEAD_RADIUS / path[:, 2] + radius / center[2] + 0.05  # parallax of the right camera
    return bool(np.all(center[2] - radius > path[meets, 2] + MIN_GAP_BEHIND_HEAD))


def _place_skin_colored_things(
    path: Array, wall: float, skin: NDArray[np.float64], rng: np.random.Generator
) -> StereoRoom:
    """Skin-colored things behind the path: a large rectangle, and head-sized ellipsoids."""
    room = StereoRoom([], [])
    for index in range(4):
        on_path = path[rng.integers(len(path))]
        depth = rng.uniform(on_path[2] + 0.6, max(min(on_path[2] + 1.8, wall - 0.25), on_path[2] + 0.65))
        center = on_path / on_path[2] * depth + np.append(rng.uniform(-0.2, 0.2, 2), 0)
        color = skin * rng.uniform(0.85, 1.05) * rng.uniform(0.95, 1.05, 3)
        half = rng.uniform([0.15, 0.25], [0.4, 0.6]) if index == 0 else rng.uniform(0.07, 0.14, 2)
        if not is_clear(center, 0.2, path):
            continue
        if index == 0:
            kind = str(rng.choice([textures.PLAIN_SURFACE, textures.WOOD_SURFACE]))
            room.rectangles.append(
                make_upright_rectangle(
                    center, half, rng.uniform(-0.4, 0.4), make_rectangle_texture(kind, 2 * half, color, rng)
                )
            )
        else:
            unit = np.diag(1 / np.array([*half, half.mean()]))
            room.ellipsoids.append(
                TexturedEllipsoid(
                    center, unit, textures.build_pyramid(textures.make_skin((128, 256), color, rng))
                )
            )
    return room


def _wall(depth: float, rng: np.random.Generator) -> TexturedRectangle:
    """The back wall, not quite parallel to the image planes."""
    kind = str(rng.choice([textures.PLAIN_SURFACE, textures.BLOTCHED_SURFACE, textures.WOOD_SURFACE]))
    color = 0.5 * textures.random_color(rng) + rng.uniform(40, 90)
    texture = textures.build_pyramid(textures.make_surface(kind, (512, 1024), color, rng))
    return make_upright_rectangle(
        np.array([0, 0, depth]), np.array([8.0, 4.5]), rng.uniform(-0.15, 0.15), texture
    )


def _floor(below: float, depth: float, rng: np.random.Generator) -> TexturedRectangle:
    kind = str(
        rng.choice(
            [
                textures.PLAIN_SURFACE,
                textures.WOOD_SURFACE,
                textures.STRIPED_SURFACE,
                textures.BLOTCHED_SURFACE,
            ]
        )
    )
    texture = textures.build_pyramid(textures.make_surface(kind, (512, 512), textures.random_color(rng), rng))
    size = 2 * depth
    return TexturedRectangle(
        np.array([-depth, below, 0.1]), np.array([size, 0, 0]), np.array([0, 0, size]), texture
    )
