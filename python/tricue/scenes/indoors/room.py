# SPDX-License-Identifier: MIT
"""A cluttered room behind a person: wall, table, shelves with books, boxes and vases, lit with shadows.

Some things have nearly the color of the person's skin: wood, cardboard, clay, a curtain.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.scenes.arrays import Array, Picture
from tricue.scenes.indoors.paint import sample_periodic
from tricue.scenes.indoors.picture import CAMERA, ColoredLamp, blur
from tricue.scenes.indoors.surface import Integers
from tricue.scenes.rendering import textures

RAYS = 2  # per pixel, along each axis
SHADOW_SAMPLES = 4
LAMP_SIZE = 0.12  # standard deviation of the unit vector toward the lamp
TEXTURES = 12
TEXTURE_METERS = 0.6
DEFOCUS = 0.8  # pixels
MIN_RAY = 1e-4  # meters


class Things(NamedTuple):
    """Boxes and ellipsoids whose axes are parallel to the camera's."""

    low: Array  # (n, 3) meters
    high: Array  # (n, 3)
    colors: Array  # (n, 3) BGR
    textures: Integers  # (n,)
    round: NDArray[np.bool_]  # (n,): whether it is the ellipsoid inscribed in the box


class _List:
    """Collects things."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.rows: list[tuple[Array, Array, Array, int, bool]] = []

    def add(
        self,
        low: ArrayLike,
        high: ArrayLike,
        color: Array,
        texture: int | None = None,
        is_round: bool = False,
    ) -> None:
        chosen = int(self.rng.integers(TEXTURES)) if texture is None else texture
        self.rows.append((np.asarray(low, float), np.asarray(high, float), color, chosen, is_round))

    def things(self) -> Things:
        low, high, colors, chosen, is_round = (np.array(each) for each in zip(*self.rows, strict=True))
        return Things(low, high, colors, chosen, is_round)


def render_room(skin: Array, lamp: ColoredLamp, near: float, rng: np.random.Generator) -> Picture:
    """The room (H, W, 3) behind a person with this skin color (3,), who is up to ``near`` meters away."""
    things = _furnish(skin, near, rng)
    pictures = [
        textures.make_surface(kind, (128, 128), np.full(3, 128.0), rng) / np.float32(128)
        for kind in (["plain"] * 4 + ["wood"] * 4 + ["blotches"] * 4)
    ]
    rows, columns = (np.arange(size * RAYS) for size in (CAMERA.height, CAMERA.width))
    x = ((columns + 0.5) / RAYS - 0.5 - CAMERA.cx) / CAMERA.fx
    y = ((rows + 0.5) / RAYS - 0.5 - CAMERA.cy) / CAMERA.fy
    rays = np.stack(np.broadcast_arrays(x[None], y[:, None], 1.0), axis=-1).astype(np.float32)
    depth, hit = _cast_camera(things, rays)
    points, hit = (rays * depth[..., None]).reshape(-1, 3), hit.ravel()
    normals = _normals(things, points, hit)
    colors = things.colors[hit].astype(np.float32) * _texture(things, pictures, points, normals, hit)
    # The shadows are soft, so one ray per pixel is enough.
    at = np.arange(len(points)).reshape(len(y), len(x))[::RAYS, ::RAYS]
    start = points[at.ravel()] + np.float32(2e-3) * normals[at.ravel()]
    open_lamp: Picture = np.zeros(at.shape, np.float32)
    for _ in range(SHADOW_SAMPLES):
        toward = (lamp.direction + LAMP_SIZE * rng.standard_normal(3)).astype(np.float32)
        open_lamp += np.float32(1 / SHADOW_SAMPLES) * ~_blocked(things, start, toward).reshape(at.shape)
    open_lamp = blur(open_lamp, 1.0).repeat(RAYS, axis=0).repeat(RAYS, axis=1).ravel()
    facing = np.clip(normals @ lamp.direction.astype(np.float32), 0, 1) * open_lamp
    gains = np.outer(facing, lamp.direct) + np.outer(0.8 - 0.2 * normals[:, 1], lamp.ambient)
    lit = (colors * gains.astype(np.float32)).reshape(CAMERA.height, RAYS, CAMERA.width, RAYS, 3)
    return blur(lit.mean(axis=(1, 3), dtype=np.float32), DEFOCUS)


def _furnish(skin: Array, near: float, rng: np.random.Generator) -> Things:
    """Random furniture between ``near`` and the wall."""
    room, wall = _List(rng), near + rng.uniform(1.0, 1.6)
    wide, tall = wall * CAMERA.width / CAMERA.fx / 2, wall * CAMERA.height / CAMERA.fy / 2
    paint = np.array([190.0, 200, 205]) * rng.uniform(0.6, 1.0) * rng.uniform(0.9, 1.1, 3)
    room.add([-9, -9, wall], [9, 9, wall + 0.1], paint, int(rng.integers(4)))
    _add_curtain(room, wall, wide, tall, skin)
    for up in rng.uniform(-0.75, -0.35, 1).tolist() + rng.uniform(0.0, 0.35, 1).tolist():
        left = rng.uniform(-1.0, -0.5) * wide
        _add_shelf(room, left, left + rng.uniform(0.9, 1.4) * wide, up * tall, wall, skin)
    top = rng.uniform(0.62, 0.8) * tall * (wall - 0.3) / wall
    wood = np.array([70.0, 115, 165]) * rng.uniform(0.7, 1.1, 3)
    room.add([-2 * wide, top, wall - 0.75], [2 * wide, top + 0.04, wall], wood, 4)
    for x in np.arange(-0.9, 0.95, 0.28) * wide + rng.uniform(-0.08, 0.08, 7) * wide:
        _add_thing(room, x, top, wall - rng.uniform(0.15, 0.6), skin)
    for _ in range(3):
        center = rng.uniform([-0.8 * wide, -0.8 * tall], [0.8 * wide, 0.3 * tall])
        half = rng.uniform(0.08, 0.2, 2)
        room.add([*(center - half), wall - 0.02], [*(center + half), wall], np.array([60.0, 90, 130]), 5)
        inner = 0.85 * half
        color = _near_skin(skin, rng) if rng.random() < 0.5 else textures.random_color(rng)
        room.add(
            [*(center - inner), wall - 0.025], [*(center + inner), wall], color, 8 + int(rng.integers(4))
        )
    return room.things()


def _near_skin(skin: Array, rng: np.random.Generator) -> Array:
    return np.asarray(skin * rng.uniform(0.75, 1.05) * rng.uniform(0.93, 1.07, 3))


def _add_curtain(room: _List, wall: float, wide: float, tall: float, skin: Array) -> None:
    """Add a pleated curtain at one side, in a color near the skin's."""
    rng = room.rng
    left = rng.choice([-1.0, 1.0]) * rng.uniform(0.75, 0.95) * wide - 0.18 * wide
    color = _near_skin(skin, rng) * rng.uniform(0.85, 1.05)
    for fold in range(7):
        x = left + 0.06 * fold * wide
        room.add([x, -2 * tall, wall - 0.10], [x + 0.065 * wide, 2 * tall, wall], color, 2, is_round=True)


def _add_shelf(room: _List, left: float, right: float, height: float, wall: float, skin: Array) -> None:
    """Add a board with books and a few other things on it."""
    rng = room.rng
    room.add([left, height, wall - 0.26], [right, height + 0.025, wall], np.array([80.0, 125, 170]), 6)
    x = left + 0.02
    while x < right - 0.1:
        if rng.random() < 0.25:
            _add_thing(room, x + 0.06, height, wall - 0.13, skin)
            x += 0.16
            continue
        thick, tall = rng.uniform(0.02, 0.05), rng.uniform(0.17, 0.26)
        front = wall - rng.uniform(0.17, 0.22)
        room.add([x, height - tall, front], [x + thick, height, wall - 0.02], textures.random_color(rng))
        band = height - tall * rng.uniform(0.5, 0.8)
        room.add([x, band, front - 0.001], [x + thick, band + 0.03, wall - 0.02], textures.random_color(rng))
        x += thick + 0.002


def _add_thing(room: _List, x: float, floor: float, z: float, skin: Array) -> None:
    """Add a vase, a ball, a bottle or a box that stands on ``floor``; half of them are skin-colored."""
    rng = room.rng
    color = _near_skin(skin, rng) if rng.random() < 0.5 else textures.random_color(rng)
    kind = rng.integers(4)
    if kind == 0:
        half = rng.uniform(0.04, 0.08)
        room.add([x - half, floor - rng.uniform(0.1, 0.22), z], [x + half, floor, z + 2 * half], color)
    elif kind == 1:
        half = rng.uniform(0.035, 0.06)
        room.add([x - half, floor - 2 * half, z], [x + half, floor, z + 2 * half], color, is_round=True)
    else:
        half, tall = rng.uniform(0.035, 0.06), rng.uniform(0.12, 0.24)
        room.add([x - half, floor - tall, z], [x + half, floor, z + 2 * half], color, is_round=True)
        neck = [x - 0.4 * half, floor - 1.25 * tall, z + 0.6 * half]
        room.add(neck, [x + 0.4 * half, floor - 0.5 * tall, z + 1.4 * half], color, is_round=True)


def _cast_camera(things: Things, rays: Picture) -> tuple[Picture, Integers]:
    """The distance (h, w) to the first thing along rays (h, w, 3) from the camera, and that thing's index."""
    height, width = rays.shape[:2]
    depth, hit = np.full((height, width), np.inf, np.float32), np.zeros((height, width), np.int64)
    origin = np.zeros(3, np.float32)
    for index, (low, high, is_round) in enumerate(zip(things.low, things.high, things.round, strict=True)):
        corners = np.stack([low[:2] / low[2], high[:2] / low[2], low[:2] / high[2], high[:2] / high[2]])
        (left, top), (right, bottom) = corners.min(axis=0), corners.max(axis=0)
        place = (
            slice(*np.searchsorted(rays[:, 0, 1], [top, bottom]).tolist()),
            slice(*np.searchsorted(rays[0, :, 0], [left, right]).tolist()),
        )
        part = rays[place]
        first = _first_hit(low, high, is_round, origin, part.reshape(-1, 3)).reshape(part.shape[:2])
        nearer = first < depth[place]
        depth[place][nearer], hit[place][nearer] = first[nearer], index
    return depth, hit


def _blocked(things: Things, points: Picture, toward: Picture) -> NDArray[np.bool_]:
    """Whether a thing shades each of the points (m, 3) from the lamp in direction ``toward`` (3,)."""
    blocked = np.zeros(len(points), bool)
    for low, high, is_round in zip(things.low[1:], things.high[1:], things.round[1:], strict=True):
        free = np.flatnonzero(~blocked)
        first = _first_hit(low, high, is_round, points[free], toward[None])
        blocked[free[np.isfinite(first)]] = True
    return blocked


def _first_hit(low: Array, high: Array, is_round: bool, origin: Picture, rays: Picture) -> Picture:
    """The distance (m,) along rays to a box or its inscribed ellipsoid; infinite for a miss."""
    a, b = np.float32(low), np.float32(high)
    with np.errstate(divide="ignore", invalid="ignore"):
        if is_round:
            # One axis at a time: NumPy is slow at sums over an axis of length 3.
            axes, middle = (b - a) / 2, (a + b) / 2
            away = [(origin[..., i] - middle[i]) / axes[i] for i in range(3)]
            along = [rays[..., i] / axes[i] for i in range(3)]
            square = along[0] ** 2 + along[1] ** 2 + along[2] ** 2
            product = along[0] * away[0] + along[1] * away[1] + along[2] * away[2]
            gap = away[0] ** 2 + away[1] ** 2 + away[2] ** 2 - 1
            first = (-product - np.sqrt(product * product - square * gap)) / square
            return np.asarray(np.where(first > MIN_RAY, first, np.inf), np.float32)  # a miss is NaN
        enter, leave = -np.inf, np.inf
        for i in range(3):
            inverse = 1 / rays[..., i]
            one, two = (a[i] - origin[..., i]) * inverse, (b[i] - origin[..., i]) * inverse
            enter = np.maximum(enter, np.minimum(one, two))
            leave = np.minimum(leave, np.maximum(one, two))
    return np.asarray(np.where((enter <= leave) & (enter > MIN_RAY), enter, np.inf), np.float32)


def _normals(things: Things, points: Picture, hit: Integers) -> Picture:
    center, axes = (things.low + things.high) / 2, (things.high - things.low) / 2
    local = (points - center[hit]) / axes[hit]
    face = np.zeros_like(local)
    axis = np.abs(local).argmax(axis=1)
    rows = np.arange(len(points))
    face[rows, axis] = np.sign(local[rows, axis])
    normals = np.where(things.round[hit][:, None], local / axes[hit], face)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.asarray(normals, np.float32)


def _texture(
    things: Things, pictures: list[Picture], points: Picture, normals: Picture, hit: Integers
) -> Picture:
    """The gains (m, 3) of the textures, which are mapped to each face along the axes that it spans."""
    axis = np.abs(normals).argmax(axis=1)
    u = np.where(axis == 0, points[:, 2], points[:, 0]) + hit * 0.137
    v = np.where(axis == 1, points[:, 2], points[:, 1]) + hit * 0.071
    gains = np.ones((len(points), 3), np.float32)
    for number, picture in enumerate(pictures):
        chosen = things.textures[hit] == number
        gains[chosen] = sample_periodic(
            picture,
            (v[chosen] / TEXTURE_METERS).astype(np.float32),
            (u[chosen] / TEXTURE_METERS).astype(np.float32),
        )
    return gains
