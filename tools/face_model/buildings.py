# SPDX-License-Identifier: MIT
"""Walls with windows and doors, towers, and wheels: upright or round and symmetric, with parts in pairs."""

from typing import NamedTuple

import numpy as np
from tricue.arrays import Floats

from tools.face_model.painting import Random, any_color, ellipse, noise, polygon, rectangle

COURSES = 3, 9  # pixels, heights of a wall's courses of bricks or boards


class Opening(NamedTuple):
    """What the windows or doors of one wall have in common.

    radii: half of the sides, pixels. arch: its height over half of the width. bars: how many, upright and
    across. reveal: shares of the radii by which the wall's thickness covers the left or right and upper edge.
    """

    radii: Floats
    arch: float
    frame: float
    frame_color: Floats
    pane: Floats
    bars: list[int]
    bar_width: float
    panels: bool
    reveal: Floats
    sill: float
    shutters: Floats | None


def random_opening(rng: Random, width: float) -> Opening:
    """width: half of it, pixels."""
    height = width * rng.uniform(0.8, 2.2)
    return Opening(
        radii=np.array([width, height]),
        arch=rng.uniform(0.3, 1) if rng.uniform() < 0.3 else 0.0,
        frame=width * rng.uniform(0, 0.5),
        frame_color=any_color(rng, 0.1) * rng.uniform(1, 3),
        pane=any_color(rng, 0.15) * rng.uniform(0.1, 1),
        bars=rng.integers(0, 4, 2).tolist(),
        bar_width=rng.uniform(0.4, 1.5),
        panels=rng.uniform() < 0.25,
        reveal=np.array([rng.uniform(-0.3, 0.3), rng.uniform(0, 0.3)]),
        sill=rng.uniform(0.05, 0.25) if rng.uniform() < 0.5 else 0.0,
        shutters=any_color(rng) if rng.uniform() < 0.2 else None,
    )


def building(rng: Random, side: int) -> Floats:
    """A wall with rows of windows, or a tower before the sky; sometimes wheels before it."""
    kind = rng.uniform()
    image = _tower(rng, side) if kind < 0.3 else _wall(rng, side)
    if kind > 0.6:
        for _ in range(rng.integers(1, 5)):
            _wheel(rng, image, rng.uniform(0, side, 2), rng.uniform(6, 30))
    return _textured(image, rng.uniform(0, 0.4) * noise(rng, image.shape[:2], side / 4))


def _masonry(rng: Random, side: int, color: Floats) -> Floats:
    """An even wall, or one with courses."""
    image = np.tile(color, (side, side, 1))
    if rng.uniform() < 0.5:
        course = rng.uniform(*COURSES)
        joints = np.arange(side) % course < 1
        image[joints] *= rng.uniform(0.5, 1.3)
    strength, grain = rng.uniform(0, 0.2), rng.uniform(1, 8)
    return _textured(image, strength * noise(rng, (side, side), grain))


def _textured(image: Floats, logs: Floats) -> Floats:
    return np.asarray(image * np.exp(logs)[..., np.newaxis])


def _wall(rng: Random, side: int) -> Floats:
    image = _masonry(rng, side, any_color(rng, 0.2) * rng.uniform(1, 3))
    opening = random_opening(rng, rng.uniform(4, 22))
    step = 2 * opening.radii * rng.uniform(1.2, 2.5, 2)
    start = rng.uniform(0, step)
    for y in np.arange(start[1], side + step[1], step[1]):
        for x in np.arange(start[0], side + step[0], step[0]):
            _open(rng, image, np.array([x, y]), opening)
        if rng.uniform() < 0.2:  # the next floor has others
            opening = random_opening(rng, opening.radii[0])
    return image


def _tower(rng: Random, side: int) -> Floats:
    """Storeys that get narrower, with openings, under a roof or a dome."""
    image = np.tile(any_color(rng, 0.15) * rng.uniform(1, 6), (side, side, 1))
    wall = _masonry(rng, side, any_color(rng, 0.2))
    x, y, half = rng.uniform(0.2, 0.8) * side, float(side), rng.uniform(0.06, 0.3) * side
    while half > 3 and y > 0:
        height = half * rng.uniform(0.4, 2)
        top, left, right = (int(max(each, 0)) for each in (y - height, x - half, x + half))
        image[top : int(y), left:right] = wall[top : int(y), left:right] * rng.uniform(0.6, 1.4)
        count = int(rng.integers(0, 4))
        opening = random_opening(rng, half / (count + 1) * rng.uniform(0.2, 0.7))
        opening = opening._replace(radii=np.minimum(opening.radii, height * 0.45))
        for place in np.arange(count) - (count - 1) / 2:
            _open(rng, image, np.array([x + place * 2 * half / count, y - height / 2]), opening)
        if rng.uniform() < 0.5:
            cornice = np.array([half * rng.uniform(1, 1.2), height * rng.uniform(0.02, 0.1)])
            rectangle(image, np.array([x, y - height]), cornice, any_color(rng, 0.1))
        y, half = y - height, half * rng.uniform(0.55, 1)
        if rng.uniform() < 0.3:
            break
    if rng.uniform() < 0.5:
        ellipse(image, (x, y), half * np.array([1, rng.uniform(0.5, 1.4)]), any_color(rng))
    else:
        roof = [[x - half, y], [x + half, y], [x, y - half * rng.uniform(1, 4)]]
        polygon(image, roof, any_color(rng))
    return image


def _open(rng: Random, image: Floats, at: Floats, opening: Opening) -> None:
    """Draw an opening around a pixel."""
    radii, frame = opening.radii, opening.frame
    if opening.shutters is not None:
        for side in (-1.5, 1.5):
            shutter = at + [side * (radii[0] + frame), 0]
            rectangle(image, shutter, radii * [0.5, 1], opening.shutters)
    _arched(image, at, radii + frame, opening.arch, opening.frame_color)
    pane = opening.pane * np.exp(rng.normal(0, 0.3))
    _arched(image, at, radii, opening.arch, pane)
    if rng.uniform() < 0.4:  # a reflection, a curtain or a blind
        part = radii * rng.uniform(0.3, 1, 2)
        rectangle(image, at + rng.choice([-1, 0, 1], 2) * (radii - part), part, any_color(rng, 0.1))
    _bars(image, at, opening)
    if opening.panels:
        for x, y in ((-0.5, -0.5), (-0.5, 0.45), (0.5, -0.5), (0.5, 0.45)):
            rectangle(image, at + radii * [x, y], radii * 0.35, pane * 0.6)
    across, down = opening.reveal * radii
    rectangle(image, at - [0, radii[1] - down / 2], np.array([radii[0], down / 2]), pane * 0.3)
    edge = at - [np.sign(across) * radii[0] - across / 2, 0]
    rectangle(image, edge, np.array([abs(across) / 2, radii[1]]), pane * 0.4)
    if opening.sill:
        size = np.array([radii[0] + frame, radii[1] * opening.sill])
        rectangle(image, at + [0, radii[1] + frame], size, opening.frame_color * 1.2)


def _bars(image: Floats, at: Floats, opening: Opening) -> None:
    for axis in (0, 1):
        count = opening.bars[axis]
        for place in (np.arange(count) + 1) / (count + 1) * 2 - 1:
            radii, center = opening.radii.copy(), at.copy()
            radii[axis] = opening.bar_width
            center[axis] += place * opening.radii[axis]
            rectangle(image, center, radii, opening.frame_color)


def _arched(image: Floats, at: Floats, radii: Floats, arch: float, color: Floats) -> None:
    rectangle(image, at, radii, color)
    if arch:
        ellipse(image, at - [0, radii[1]], radii[0] * np.array([1, arch]), color)


def _wheel(rng: Random, image: Floats, at: Floats, radius: float) -> None:
    """In a car's body or a frame, with rim, spokes and hub."""
    radii = radius * np.array([rng.uniform(0.6, 1), 1])
    if rng.uniform() < 0.6:
        body = radii * rng.uniform([1.5, 0.8], [4, 1.5])
        rectangle(image, at - [0, radius], body, any_color(rng, 0.3))
        ellipse(image, at, radii * rng.uniform(1.05, 1.25), any_color(rng, 0.05) * 0.2)
    ellipse(image, at, radii, any_color(rng, 0.05) * 0.4)
    inner = rng.uniform(0.55, 0.9)
    ellipse(image, at, radii * inner, any_color(rng, 0.05) * rng.uniform(1, 3))
    if rng.uniform() < 0.3:
        ellipse(image, at, radii * inner * 0.9, any_color(rng, 0.1))
    count, start = int(rng.integers(3, 12)), rng.uniform(0, np.pi)
    color, width = any_color(rng, 0.05), rng.uniform(0.04, 0.25)
    for angle in start + 2 * np.pi * np.arange(count) / count:
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        from_hub = np.array([0.15, 0.15, inner, inner])[:, np.newaxis] * along
        beside = width * np.array([-0.5, 0.5, 0.5, -0.5])[:, np.newaxis] * across
        polygon(image, at + radii * (from_hub + beside), color)
    ellipse(image, at, radii * rng.uniform(0.1, 0.3), any_color(rng, 0.05))
