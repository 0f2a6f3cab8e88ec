# SPDX-License-Identifier: MIT
"""Things in rooms: targets, clutter and hands."""

from typing import NamedTuple

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.ellipsoids import OrientedEllipsoids
from tricue.scenes.rendering.stereo_camera import WhiteLamp
from tricue.scenes.rooms import looks
from tricue.scenes.rooms.solids import Solid, make_box, make_can, make_figure

TARGET_SHAPES = ("box", "can", "figure", "low")
SHINY_SHARE = 0.25  # of things


class Thing(NamedTuple):
    """A thing that stands on y = 0. size: its width, height and depth (3,), meters."""

    solid: Solid
    size: Array
    shiny: bool = False


def make_thing(shape: str, side: float, lamp: WhiteLamp, rng: np.random.Generator) -> Thing:
    """A random thing. shape: one of TARGET_SHAPES. side: √(width · height), meters."""
    shiny = bool(rng.random() < SHINY_SHARE)
    if shape == "can":
        aspect = rng.uniform(0.5, 1.0)
        width, height = side * aspect**0.5, side / aspect**0.5
        around, lid = (
            looks.print_picture(np.pi * aspect, rng),
            looks.cover(looks.THING_KINDS[:1], 32, 32, rng),
        )
        return Thing(make_can(width / 2, height, around, lid, lamp), np.array([width, height, width]), shiny)
    if shape == "figure":
        return _make_figure(side, rng)
    aspect = rng.uniform(1.6, 2.6) if shape == "low" else rng.uniform(0.55, 1.4)
    width, height = side * aspect**0.5, side / aspect**0.5
    size = np.array([width, height, width * rng.uniform(0.3, 1.0)])
    fronts = [
        looks.print_picture(across / high, rng)
        for across, high in ((width, height), (size[2], height), (size[2], height), (width, size[2]))
    ]
    return Thing(make_box(size, fronts), size, shiny)


def make_hand(forearm: Array, clasped: Array, length: float, rng: np.random.Generator) -> Solid:
    """A hand with its arm that holds a thing centered at the origin.

    forearm: unit vector (3,) from the thing along the arm, mostly sideways. clasped: the thing's width,
    height and depth (3,), meters. length: of the sleeve, meters. The palm is at the thing's side, the fingers
    reach around its front.
    """
    tone = textures.SKIN_TONES[rng.integers(len(textures.SKIN_TONES))]
    skin = textures.build_pyramid(textures.make_skin((64, 64), tone, rng))
    sleeve = textures.build_pyramid(looks.cover(looks.THING_KINDS[:2], 64, 64, rng))
    half = clasped / 2
    toward = np.array([float(np.sign(forearm[0])), 0, 0])
    palm = toward * (half[0] + 0.02)
    parts = [(palm, _along(forearm) * [0.04, 0.05, min(0.03, half[2] + 0.01)], skin)]
    for finger in range(4):
        tip = palm - toward * rng.uniform(0.035, 0.06) + [0, 0.024 * (finger - 1.5), -half[2] - 0.012]
        parts.append((tip, np.diag([0.045, 0.011, 0.012]), skin))
    parts.append((palm + forearm * 0.13, _along(forearm) * [0.033, 0.12, 0.03], skin))
    middle = palm + forearm * (0.22 + length / 2)
    parts.append((middle, _along(forearm) * [0.055, length / 2 + 0.06, 0.055], sleeve))
    centers, roots, skins = zip(*parts, strict=True)
    return Solid((), OrientedEllipsoids(np.stack(centers), np.stack(roots)), skins)


def _make_figure(side: float, rng: np.random.Generator) -> Thing:
    """A toy of four to six balls that touch each other, the lowest on the ground."""
    count = int(rng.integers(4, 7))
    up = np.sort(rng.uniform(0.12, 0.9, count))
    axes = rng.uniform([0.14, 0.12, 0.12], [0.34, 0.24, 0.28], (count, 3))
    up[0] = axes[0, 1]
    centers = np.column_stack([rng.uniform(-0.3, 0.3, count), -up, rng.uniform(-0.15, 0.15, count)])
    centers[0, 0] = 0
    skins = [
        textures.build_pyramid(looks.cover(looks.THING_KINDS[:3], 64, 64, rng))
        for _ in range(int(rng.integers(1, 3)))
    ]
    low, high = (centers - axes).min(axis=0), (centers + axes).max(axis=0)
    scale = side / np.sqrt((high - low)[0] * (high - low)[1])
    solid = make_figure(centers * scale, axes * scale, [skins[i % len(skins)] for i in range(count)])
    return Thing(solid, (high - low) * scale)


def _along(axis: Array) -> Array:
    """A rotation (3, 3) that takes y to a unit vector."""
    helper = np.array([0, 0, 1.0]) if abs(axis[2]) < 0.9 else np.array([1.0, 0, 0])
    x = np.cross(axis, helper)
    x /= np.linalg.norm(x)
    return np.stack([x, axis, np.cross(x, axis)], axis=1)
