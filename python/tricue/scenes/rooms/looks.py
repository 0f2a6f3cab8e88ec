# SPDX-License-Identifier: MIT
"""The looks of things in rooms: printed packages, plain and patterned surfaces."""

import numpy as np

from tricue import imgproc
from tricue.scenes.arrays import Picture
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.photographs import load_photograph

PRINTS = ("astronaut", "coffee", "cat", "motorcycle", "immunohistochemistry", "rocket")
PRINT_TEXELS = 128  # of a print's longer side
TILED_SHARE, TEXTURELESS_SHARE = 0.2, 0.4  # of walls, floors and tables
FAINT_CONTRAST = 0.1  # of textureless surfaces, relative to textured ones
FURNITURE_KINDS = (textures.PLAIN_SURFACE, textures.PLAIN_SURFACE, textures.WOOD_SURFACE)
THING_KINDS = (
    textures.PLAIN_SURFACE,
    textures.STRIPED_SURFACE,
    textures.BLOTCHED_SURFACE,
    textures.CLUTTERED_SURFACE,
)


def print_picture(aspect: float, rng: np.random.Generator) -> Picture:
    """A random part of a photograph with this ratio of width to height, as printed on a package."""
    picture = load_photograph(PRINTS[rng.integers(len(PRINTS))])
    largest = min(picture.shape[0], picture.shape[1] / aspect)
    height = largest * rng.uniform(0.35, 0.9)
    rows, columns = max(int(height), 8), max(int(height * aspect), 8)
    top, left = (rng.random(2) * (np.array(picture.shape[:2]) - [rows, columns]).clip(0)).astype(int)
    part = picture[top : top + rows, left : left + columns]
    width, height = round(PRINT_TEXELS * min(aspect, 1.0)), round(PRINT_TEXELS * min(1 / aspect, 1.0))
    return imgproc.resize(part, max(height, 8), max(width, 8), "area").astype(np.float32)


def cover(kinds: tuple[str, ...], rows: int, columns: int, rng: np.random.Generator) -> Picture:
    """A surface of a random one of these kinds, seldom dark or vivid."""
    color = textures.random_color(rng)
    return textures.make_surface(kinds[rng.integers(len(kinds))], (rows, columns), color, rng)


def furniture_cover(rows: int, columns: int, rng: np.random.Generator) -> Picture:
    """The surface of a wall, a floor or a table: plain or wood; a fifth is tiled, two fifths textureless."""
    draw = rng.random()
    if draw < TILED_SHARE:
        return tiles(rows, columns, rng)
    color = 0.5 * textures.random_color(rng) + rng.uniform(20, 120)
    structure = FURNITURE_KINDS[rng.integers(len(FURNITURE_KINDS))]
    surface = textures.make_surface(structure, (rows, columns), color, rng)
    contrast = FAINT_CONTRAST if draw < TILED_SHARE + TEXTURELESS_SHARE else 1.0
    return np.asarray(color + np.float32(contrast) * (surface - color), np.float32)


def tiles(rows: int, columns: int, rng: np.random.Generator) -> Picture:
    """A repeating pattern: squares in two colors, or lines between equal squares."""
    pitch = int(rng.integers(max(columns // 40, 6), max(columns // 12, 8)))
    v, u = np.indices((rows, columns)) // pitch
    colors = [0.6 * textures.random_color(rng) + 60 for _ in range(2)]
    second = (u + v) % 2 == 1
    if rng.random() < 0.5:
        joint = max(pitch // 10, 1)
        second = (np.indices((rows, columns)) % pitch < joint).any(axis=0)
    return np.where(second[..., None], colors[1], colors[0]).clip(4, 250).astype(np.float32)
