# SPDX-License-Identifier: MIT
"""A hall behind walkers in front of a panning stereo pair: walls, a floor, textured things at all depths."""

import math
from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.rectangles import make_rectangle_texture, make_upright_rectangle
from tricue.scenes.rendering.stereo_camera import RayCamera, RayImage, TexturedRectangle

HALL_RECTANGLES = 16
MIN_GAP_BEHIND_WALKERS = 1.4  # meters behind the farthest path
HALL_HALF_WIDTH = 7.0  # meters
WALL_HEIGHT, MAX_HANGING_HEIGHT = 5.0, 3.2  # meters above the floor, of walls and of things on them
RECTANGLE_OVERLAP = 0.01  # meters, so that no ray passes between two rectangles
FLOOR_STRIP_DEPTHS = np.array([3.0, 4.8, 5.8, 7.0, 8.6, 11.0])  # meters, z of the floor's strips


class Hall(NamedTuple):
    """The static things of a scene, in the level frame (see tricue.scenes.overtakings.pan)."""

    rectangles: list[TexturedRectangle]

    def render(self, camera: RayCamera, to_camera: Array, shift: Array | None = None) -> RayImage:
        """Render the hall for a camera.

        to_camera, shift: rotation (3, 3) from the level frame to the camera's, and the translation added
        after it, (3,) meters.
        """
        moved = np.zeros(3) if shift is None else shift
        shape = camera.intrinsics.height, camera.intrinsics.width
        canvas = RayImage(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))
        for corner, along, down, texture in self.rectangles:
            camera.draw_rectangle(
                canvas,
                TexturedRectangle(to_camera @ corner + moved, to_camera @ along, to_camera @ down, texture),
            )
        return canvas

    def at_detail(self, focal: float) -> "Hall":
        """The hall with the texture levels that fit a camera of this focal length, pixels."""
        return Hall([_in_detail(rectangle, focal) for rectangle in self.rectangles])


def furnish_hall(
    floor: float, farthest: float, angles: tuple[float, float], rng: np.random.Generator
) -> Hall:
    """A random hall with its floor at y = ``floor``, meters.

    farthest: the largest distance of a path from the cameras, meters. angles: the leftmost and rightmost that
    the cameras see, radians.
    """
    wall = farthest + rng.uniform(3.5, 6.0)
    rectangles = [*_walls(wall, floor, rng), *_floor(wall, floor, rng)]
    low, high = (float(np.clip(angle, -1.0, 1.0)) for angle in angles)
    for place in rng.permutation(HALL_RECTANGLES).tolist():
        # One thing in each of as many sectors, so that there are things in all directions.
        angle = low + (place + rng.random()) / HALL_RECTANGLES * (high - low)
        deepest = min(wall / math.cos(angle), HALL_HALF_WIDTH / max(abs(math.sin(angle)), 1e-6)) - 0.3
        near = farthest + MIN_GAP_BEHIND_WALKERS
        depth = near + max(deepest - near, 0.0) * rng.random()
        rectangles.append(_thing(angle, depth, floor, rng))
    return Hall(rectangles)


def _walls(depth: float, floor: float, rng: np.random.Generator) -> list[TexturedRectangle]:
    """Walls behind and at both sides, higher than the images show."""
    kind = str(rng.choice([textures.PLAIN_SURFACE, textures.BLOTCHED_SURFACE, textures.WOOD_SURFACE]))
    color = 0.5 * textures.random_color(rng) + rng.uniform(50, 100)
    top, high = floor - WALL_HEIGHT, np.array([0, WALL_HEIGHT + RECTANGLE_OVERLAP, 0])
    walls = [
        (
            np.array([-HALL_HALF_WIDTH - RECTANGLE_OVERLAP, top, depth]),
            np.array([2 * (HALL_HALF_WIDTH + RECTANGLE_OVERLAP), 0, 0]),
        ),
        (np.array([-HALL_HALF_WIDTH, top, 0]), np.array([0, 0, depth])),
        (np.array([HALL_HALF_WIDTH, top, depth]), np.array([0, 0, -depth])),
    ]
    return [
        TexturedRectangle(
            corner, along, high, textures.build_pyramid(textures.make_surface(kind, (512, 1280), color, rng))
        )
        for corner, along in walls
    ]


def _floor(depth: float, floor: float, rng: np.random.Generator) -> list[TexturedRectangle]:
    """The floor in strips by depth, so that each strip has the texture level of its distance."""
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
    color = 0.6 * textures.random_color(rng) + 40
    texture = textures.make_surface(kind, (800, 1280), color, rng)
    edges = np.append(FLOOR_STRIP_DEPTHS[depth - 0.5 > FLOOR_STRIP_DEPTHS], depth)
    rows = np.rint((edges - edges[0]) / (edges[-1] - edges[0]) * len(texture)).astype(int)
    return [
        TexturedRectangle(
            np.array([-HALL_HALF_WIDTH - RECTANGLE_OVERLAP, floor, start]),
            np.array([2 * (HALL_HALF_WIDTH + RECTANGLE_OVERLAP), 0, 0]),
            np.array([0, 0, stop - start + RECTANGLE_OVERLAP]),
            textures.build_pyramid(np.ascontiguousarray(texture[first:last])),
        )
        for start, stop, first, last in zip(edges[:-1], edges[1:], rows[:-1], rows[1:], strict=True)
    ]


def _thing(angle: float, depth: float, floor: float, rng: np.random.Generator) -> TexturedRectangle:
    """A thing on the floor or hanging, that roughly faces the cameras."""
    half = rng.uniform([0.25, 0.3], [0.7, 1.0])
    stands = rng.random() < 0.6
    y = floor - half[1] if stands else floor - rng.uniform(half[1] + 0.2, MAX_HANGING_HEIGHT - half[1])
    center = np.array([math.sin(angle) * depth, y, math.cos(angle) * depth])
    kind = str(
        rng.choice(
            [
                textures.WOOD_SURFACE,
                textures.STRIPED_SURFACE,
                textures.BLOTCHED_SURFACE,
                textures.CLUTTERED_SURFACE,
            ]
        )
    )
    texture = make_rectangle_texture(kind, 2 * half, textures.random_color(rng), rng)
    return make_upright_rectangle(center, half, rng.uniform(-0.5, 0.5) - angle, texture)


def _in_detail(rectangle: TexturedRectangle, focal: float) -> TexturedRectangle:
    middle = rectangle.corner + (rectangle.along + rectangle.down) / 2
    texels = (
        rectangle.texture[0].shape[1]
        / float(np.linalg.norm(rectangle.along))
        * float(np.hypot(*middle[[0, 2]]))
    )
    return rectangle._replace(texture=textures.select_level(rectangle.texture, texels / focal))
