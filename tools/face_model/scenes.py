# SPDX-License-Identifier: MIT
"""Pictures without faces.

Leaves of all sizes, 1/f noise, strokes, shaded bodies, made things, buildings, and people.
"""

from collections.abc import Callable

import cv2
import numpy as np
from tricue.arrays import Floats, Image

from tools.face_model.bodies import Ellipsoid, Person, Sun
from tools.face_model.buildings import building
from tools.face_model.camera import photograph
from tools.face_model.painting import (
    Random,
    any_color,
    ellipse,
    noise,
    polygon,
    rectangle,
    skin_color,
)

SIDE = 160  # pixels
LETTERS = list("abcdefgHKXOo8BEm=+-:;")


def scene(rng: Random) -> Image:
    """A BGR image without a face."""
    grounds = (_forest, _clouds, _strokes, _bodies, _things, _buildings)
    image = grounds[rng.choice(6, p=[0.33, 0.08, 0.12, 0.14, 0.16, 0.17])](rng)
    if rng.uniform() < 0.6:
        for _ in range(rng.integers(1, 7)):
            Person(rng, image, rng.uniform(0, SIDE, 2), rng.uniform(8, 80)).draw()
    if rng.uniform() < 0.35:  # all of it like skin
        image *= np.array([1.5, 0.95, 0.7]) ** rng.uniform()
    if rng.uniform() < 0.2:  # symmetric
        mirrored = image[:, ::-1]
        left = (np.arange(SIDE) < SIDE / 2)[:, np.newaxis]
        image = np.maximum(image, mirrored) if rng.uniform() < 0.5 else np.where(left, image, mirrored)
    return photograph(rng, np.maximum(image, 1e-3))


def leaves(rng: Random, side: int) -> Floats:
    """Dead leaves: ellipses, rectangles and triangles of all sizes that cover each other."""
    image = np.tile(any_color(rng), (side, side, 1))
    for _ in range(rng.integers(0, 40)):
        _leaf(rng, image, side * min(0.06 * rng.pareto(1.2) + 0.04, 0.7))
    if rng.uniform() < 0.6:
        texture = rng.uniform(0, 0.3) * noise(rng, image.shape[:2], rng.uniform(1, 6))
        image *= np.exp(texture)[..., np.newaxis]
    return image


def _leaf(rng: Random, image: Floats, radius: float) -> None:
    at = rng.uniform(-5, len(image) + 5, 2)
    radii = np.array([radius, radius * rng.uniform(0.2, 1)])
    turn = rng.choice([0, 90, rng.uniform(0, 180)])
    kind = rng.integers(3)
    if kind == 0:
        ellipse(image, at, radii + 1, any_color(rng), turn)
    elif kind == 1:
        polygon(image, cv2.boxPoints((at.tolist(), (2 * radii).tolist(), turn)), any_color(rng))
    else:
        polygon(image, at + rng.normal(0, radius, (3, 2)), any_color(rng))


def _forest(rng: Random) -> Floats:
    """Leaves, with patches of other leaves, and small ones on top."""
    image = leaves(rng, SIDE)
    for _ in range(rng.integers(0, 3)):
        tiles = np.kron(rng.uniform(size=(5, 5)) < 0.3, np.ones((SIDE // 5,) * 2, bool))
        image[tiles] = leaves(rng, SIDE)[tiles]
    for _ in range(rng.integers(0, 150)):
        _leaf(rng, image, min(3 * rng.pareto(1.5) + 2, 40))
    return image


def _clouds(rng: Random) -> Floats:
    """1/f noise of brightness and of colors."""
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(SIDE), np.fft.rfftfreq(SIDE), indexing="ij"))
    frequency[0, 0] = 1
    white = np.fft.rfft2(rng.standard_normal((4, SIDE, SIDE)))
    fields = np.fft.irfft2(white / frequency ** rng.uniform(0.7, 1.6))
    light, *colors = fields / fields.std(axis=(1, 2), keepdims=True)
    logs = rng.uniform(0.3, 1) * light[..., np.newaxis] + 0.25 * np.stack(colors, axis=-1)
    return np.asarray(np.exp(logs + rng.normal(0, 0.3, 3)))


def _strokes(rng: Random) -> Floats:
    """Lines, letters, frames and arcs."""
    image = np.tile(any_color(rng), (SIDE, SIDE, 1))
    for _ in range(rng.integers(20, 200)):
        color = any_color(rng).tolist()
        start = rng.integers(0, SIDE, 2)
        width = int(rng.choice([-1, 1, 2, 3]))
        kind = rng.integers(4)
        if kind == 0:
            text = "".join(rng.choice(LETTERS, 6))
            size, font = rng.uniform(0.2, 1.2), int(rng.integers(0, 6))
            mask = np.zeros((SIDE, SIDE), np.uint8)  # letters can't be drawn on other types
            cv2.putText(mask, text, start.tolist(), font, size, 1, abs(width))
            image[mask > 0] = color
        elif kind == 1:
            end = start + rng.normal(0, 25, 2).astype(int)
            cv2.line(image, start.tolist(), end.tolist(), color, abs(width))
        elif kind == 2:
            cv2.rectangle(image, start.tolist(), (start + rng.integers(5, 40, 2)).tolist(), color, width)
        else:
            radii = rng.integers(2, 25, 2).tolist()
            cv2.ellipse(
                image, start.tolist(), radii, rng.uniform(0, 180), 0, rng.uniform(90, 360), color, width
            )
    return image


def _bodies(rng: Random) -> Floats:
    """Shaded ellipsoids with bumps, more than half of them like skin."""
    image = leaves(rng, SIDE)
    for _ in range(rng.integers(3, 14)):
        color = skin_color(rng) if rng.uniform() < 0.6 else any_color(rng)
        bumps = rng.uniform(0, 2) * noise(rng, image.shape[:2], 6)
        body = Ellipsoid(rng.uniform(0, SIDE, 2), rng.uniform(5, 30, 2), rng.uniform(0, np.pi))
        body.draw(image, color, Sun(rng), bumps)
    return image


def _things(rng: Random) -> Floats:
    """What people make, like windows, doors, wheels and cars."""
    image = leaves(rng, SIDE)
    for _ in range(rng.integers(2, 12)):
        _thing(rng, image, rng.uniform(0, SIDE, 2), rng.uniform(6, 35) * rng.uniform(0.6, 1, 2))
    return np.asarray(image * np.exp(0.2 * noise(rng, image.shape[:2], SIDE / 4))[..., np.newaxis])


def _buildings(rng: Random) -> Floats:
    return building(rng, SIDE)


def _thing(rng: Random, image: Floats, at: Floats, radii: Floats) -> None:
    """Nested outlines, sometimes spokes, and pairs of mirrored parts."""
    shape = _any_shape(rng)
    for share in (1, *np.sort(rng.uniform(0.2, 1, rng.integers(0, 4)))[::-1]):
        shape(image, at, radii * share, any_color(rng))
    if rng.uniform() < 0.3:
        _spokes(rng, image, at, radii * rng.uniform(0.5, 1))
    for _ in range(rng.integers(0, 5)):
        x, y = rng.uniform(0, 0.8, 2) * radii * np.array([1, rng.choice([-1, 1])])
        size, color, shape = rng.uniform(0.05, 0.35, 2) * radii, any_color(rng), _any_shape(rng)
        for side in (-1, 1):
            shape(image, at + [side * x, y], size, color)


def _any_shape(rng: Random) -> Callable[[Floats, Floats, Floats, Floats], None]:
    return ellipse if rng.uniform() < 0.5 else rectangle


def _spokes(rng: Random, image: Floats, at: Floats, radii: Floats) -> None:
    count = int(rng.integers(3, 13))
    angles = rng.uniform(0, np.pi) + 2 * np.pi * np.arange(count) / count
    color, width = any_color(rng).tolist(), int(rng.integers(1, 4))
    for tip in radii * np.stack([np.cos(angles), np.sin(angles)], axis=1):
        cv2.line(image, at.astype(int).tolist(), (at + tip).astype(int).tolist(), color, width)
