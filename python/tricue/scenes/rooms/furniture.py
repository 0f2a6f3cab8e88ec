# SPDX-License-Identifier: MIT
"""The still part of a room: floor, walls, a table, and what stands on it."""

import numpy as np

from tricue.scenes.arrays import Array
from tricue.scenes.rendering.stereo_camera import WhiteLamp
from tricue.scenes.rooms import looks
from tricue.scenes.rooms.solids import Placement, Solid, make_box
from tricue.scenes.rooms.things import TARGET_SHAPES, Thing, make_thing

TABLE_HEIGHT, TABLE_THICKNESS = 0.73, 0.03  # meters
WALL_HEIGHT, ROOM_WIDTH = 3.0, 6.0
MIN_CLEARANCE = 0.04  # meters between things on a table


def make_shell(floor: float, back: float, front: float, rng: np.random.Generator) -> list[Thing]:
    """A floor at y = ``floor``, and walls behind, left and right, from z = ``front`` to ``back``, as boxes,
    with windows or screens.
    """
    deep, thick = back - front, 0.1
    middle = (front + back) / 2
    wall, ground = looks.furniture_cover(256, 512, rng), looks.furniture_cover(384, 512, rng)
    shell = [
        (np.array([ROOM_WIDTH, thick, deep]), np.array([0, floor + thick, middle]), ground),
        (np.array([ROOM_WIDTH, WALL_HEIGHT, thick]), np.array([0, floor, back + thick / 2]), wall),
    ]
    for side in (-1, 1):
        at = np.array([side * (ROOM_WIDTH + thick) / 2, floor, middle])
        shell.append((np.array([thick, WALL_HEIGHT, deep]), at, wall))
    walls = [Thing(make_box(size, [cover]).placed(Placement.at(at)), size) for size, at, cover in shell]
    return walls + [_make_panel(floor, back, rng) for _ in range(int(rng.integers(1, 4)))]


def _make_panel(floor: float, back: float, rng: np.random.Generator) -> Thing:
    """A window, a screen or a shiny picture on the back wall."""
    size = np.array([rng.uniform(0.4, 1.5), rng.uniform(0.4, 1.2), 0.01])
    at = np.array([rng.uniform(-2.0, 2.0), floor - rng.uniform(0.5, 1.6), back - 0.01])
    cover = looks.cover(looks.THING_KINDS[:1], 64, 96, rng) * np.float32(rng.choice([0.25, 1.0]))
    return Thing(make_box(size, [cover]).placed(Placement.at(at)), size, shiny=True)


def make_table(width: float, depth: float, rng: np.random.Generator) -> list[Thing]:
    """A table, a plate and four legs, whose top is at y = 0 with its center at the origin."""
    plate = np.array([width, TABLE_THICKNESS, depth])
    top = make_box(plate, [looks.furniture_cover(256, 384, rng)]).placed(
        Placement.at(np.array([0, TABLE_THICKNESS, 0]))
    )
    leg = np.array([0.05, TABLE_HEIGHT - TABLE_THICKNESS, 0.05])
    cover = looks.furniture_cover(64, 16, rng)
    corners = [(x * (width / 2 - 0.06), z * (depth / 2 - 0.06)) for x in (-1, 1) for z in (-1, 1)]
    legs = [make_box(leg, [cover]).placed(Placement.at(np.array([x, TABLE_HEIGHT, z]))) for x, z in corners]
    shiny = bool(rng.random() < 0.2)
    return [Thing(top, plate, shiny), *(Thing(each, leg) for each in legs)]


def scatter_things(
    count: int, free: Array, area: Array, lamp: WhiteLamp, rng: np.random.Generator
) -> list[Thing]:
    """Things on the plane y = 0: boxes, cans, figures, flat papers and thin rods.

    free: (n, 3) x, z and radius, meters, of the places that stay free. area: half the width and depth (2,) of
    the area, meters.
    """
    made: list[Thing] = []
    taken = free
    for _ in range(6 * count):
        if len(made) == count:
            break
        thing = _make_clutter(lamp, rng)
        radius = float(np.hypot(*thing.size[[0, 2]])) / 2
        place = rng.uniform(-1, 1, 2) * (area - radius).clip(0)
        if (np.hypot(*(taken[:, :2] - place).T) < taken[:, 2] + radius + MIN_CLEARANCE).any():
            continue
        taken = np.vstack([taken, [*place, radius]])
        pose = Placement.at(np.array([place[0], 0, place[1]]), yaw=rng.uniform(-np.pi, np.pi))
        made.append(thing._replace(solid=thing.solid.placed(pose)))
    return made


def _make_clutter(lamp: WhiteLamp, rng: np.random.Generator) -> Thing:
    """A thing to stand beside the target."""
    kind = rng.random()
    if kind < 0.25:  # paper or a magazine
        size = np.array([rng.uniform(0.12, 0.3), rng.uniform(0.002, 0.012), rng.uniform(0.15, 0.3)])
        return Thing(_printed(size, rng), size)
    if kind < 0.4:  # a rod: a lamp's foot, a bottle's neck
        width = rng.uniform(0.006, 0.02)
        size = np.array([width, rng.uniform(0.15, 0.45), width])
        return Thing(make_box(size, [looks.cover(looks.THING_KINDS[:1], 32, 8, rng)]), size)
    shape = TARGET_SHAPES[rng.integers(len(TARGET_SHAPES))]
    return make_thing(shape, rng.uniform(0.06, 0.22), lamp, rng)


def _printed(size: Array, rng: np.random.Generator) -> Solid:
    return make_box(size, [looks.print_picture(float(size[0] / size[2]), rng)])
