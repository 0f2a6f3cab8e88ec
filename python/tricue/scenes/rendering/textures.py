# SPDX-License-Identifier: MIT
"""Random textures: skin, hair, cloth, wood, walls. BGR levels of 255 under light of gain 1, float32.

Noise whose amplitude falls with the frequency has the statistics of real surfaces: its power falls about as
1 / frequency^2 (Field, 1987, "Relations between the statistics of natural images", J. Opt. Soc. Am. A 4).
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.scenes.arrays import Picture

# sRGB colors as BGR: skin from light to dark, hair from black to gray. Our own choice.
SKIN_TONES = np.array(
    [[172, 190, 228], [140, 165, 212], [106, 140, 196], [74, 100, 155], [48, 66, 104]], float
)
HAIR_TONES = np.array(
    [[22, 22, 26], [36, 48, 66], [44, 66, 100], [92, 140, 180], [40, 74, 140], [140, 142, 148]], float
)
MIN_LEVEL_SIDE = 4  # texels, of a pyramid's level
HEAD_TEXTURE_SHAPE = (256, 512)  # rows of latitude, columns of longitude
PLAIN_SURFACE, WOOD_SURFACE, STRIPED_SURFACE, BLOTCHED_SURFACE, CLUTTERED_SURFACE = SURFACE_KINDS = (
    "plain",
    "wood",
    "stripes",
    "blotches",
    "things",
)


class Looks(NamedTuple):
    """A person's colors, BGR (3,), and haircut."""

    skin: NDArray[np.float64]
    hair: NDArray[np.float64]
    fringe: float  # latitude of the hairline on the forehead, degrees, below 0
    nape: float  # latitude of the hairline at the back, degrees
    beard: float  # opacity, 0 to 1

    @classmethod
    def sample(cls, rng: np.random.Generator) -> "Looks":
        """The looks of a random adult; dark skin comes with dark hair."""
        tone = rng.uniform(0, len(SKIN_TONES) - 1)
        below = min(int(tone), len(SKIN_TONES) - 2)
        skin = SKIN_TONES[below] + (tone - below) * (SKIN_TONES[below + 1] - SKIN_TONES[below])
        hair = HAIR_TONES[rng.integers(2 if tone > 2.5 else len(HAIR_TONES))]
        beard = rng.uniform(0.3, 0.8) if rng.random() < 0.3 else 0.0
        varied = [color * rng.uniform(0.92, 1.08, 3) for color in (skin, hair)]
        return cls(varied[0], varied[1], rng.uniform(-42, -24), rng.uniform(25, 75), beard)


def make_noise(
    height: int, width: int, slope: float, rng: np.random.Generator, stretch: tuple[float, float] = (1.0, 1.0)
) -> Picture:
    """Periodic noise (height, width) of mean 0 and deviation 1.

    Its amplitude falls as 1 / frequency^slope. stretch: factors by which structures are stretched along v and
    u.
    """
    spectrum = np.ascontiguousarray(np.fft.rfft2(rng.standard_normal((height, width))))
    parts = spectrum.view(np.float64)  # multiplying complex numbers would take three times as long
    parts *= _amplitudes(height, width, slope, stretch)
    values = np.fft.irfft2(spectrum, s=(height, width))
    values /= values.std()
    return np.asarray(values, np.float32)


@lru_cache(maxsize=32)
def _amplitudes(height: int, width: int, slope: float, stretch: tuple[float, float]) -> NDArray[np.float64]:
    """1 / frequency^slope, 0 at 0, for both parts of each coefficient: (height, 2 * (width // 2 + 1))."""
    v = np.fft.fftfreq(height)[:, None] * stretch[0]
    u = np.fft.rfftfreq(width)[None, :] * stretch[1]
    frequency = np.hypot(v, u)
    frequency[0, 0] = np.inf
    amplitudes = np.repeat(1 / frequency**slope, 2, axis=1)
    amplitudes.setflags(write=False)
    return amplitudes


def make_skin(shape: tuple[int, int], color: NDArray[np.float64], rng: np.random.Generator) -> Picture:
    """Skin (*shape, 3): reddish blotches, and pores."""
    blood, pores = make_noise(*shape, 1.2, rng), make_noise(*shape, 0.3, rng)
    red = np.multiply.outer(blood, np.array([-0.05, -0.05, -0.01], np.float32))
    return np.asarray(color * (1 + red + 0.035 * pores[..., None]), np.float32)


def make_hair(shape: tuple[int, int], color: NDArray[np.float64], rng: np.random.Generator) -> Picture:
    """Hair (*shape, 3): strands along the columns, and locks."""
    strands, locks = (
        make_noise(*shape, 0.7, rng, stretch=(8.0, 1.0)),
        make_noise(*shape, 1.2, rng, stretch=(2.0, 1.0)),
    )
    hair = _colored(1 + 0.16 * strands + 0.12 * locks, color)
    return np.maximum(hair, 6, out=hair)


def make_head(looks: Looks, rng: np.random.Generator) -> Picture:
    """The texture of a head, (*HEAD_TEXTURE_SHAPE, 3).

    Columns are the longitude from -180 to 180 degrees, with the face at 0; rows are the latitude from -90,
    the crown, to 90.
    """
    rows, columns = HEAD_TEXTURE_SHAPE
    latitude = np.linspace(-90, 90, 2 * rows + 1, dtype=np.float32)[1::2, None]
    longitude = np.linspace(-180, 180, 2 * columns + 1, dtype=np.float32)[None, 1::2]
    face = _paint_face(make_skin(HEAD_TEXTURE_SHAPE, looks.skin, rng), looks, latitude, longitude, rng)
    # The hairline: across the forehead, down in front of the ears, and behind them to the nape.
    turns = np.array([0.0, 38, 58, 74, 88, 100, 118, 180])
    lines = np.array([0, 2, 14, 34, 34, 40, 46, 0]) + looks.fringe
    lines[-3:] = [max(lines[-3], 0.6 * looks.nape), looks.nape, looks.nape]
    line = np.interp(np.abs(longitude), turns, lines) + 4 * make_noise(rows, columns, 1.2, rng)
    covered = np.clip((line - latitude) / 5 + 0.5, 0, 1)[..., None]
    return np.asarray(face + covered * (make_hair(HEAD_TEXTURE_SHAPE, looks.hair, rng) - face), np.float32)


def _paint_face(
    face: Picture, looks: Looks, latitude: Picture, longitude: Picture, rng: np.random.Generator
) -> Picture:
    """Paint eyes, brows, nose, mouth, cheeks, beard and ears on skin."""
    eyes, wide, brow, mouth = rng.uniform([1, 20, -11, 31], [5, 24, -8, 36]).tolist()
    darker, lips = looks.skin * 0.62, looks.skin * rng.uniform([0.6, 0.55, 0.75], [0.8, 0.75, 0.95])
    jaw = np.clip((latitude - 22) / 8, 0, 1) * np.clip((80 - np.abs(longitude)) / 10, 0, 1)
    face = _blend(face, looks.hair * 1.1, np.asarray(looks.beard * jaw, np.float32))
    for side in (-1, 1):
        spots = [
            (looks.skin * 0.72, side * wide, eyes, 11, 7, 0.8),  # the socket's shade
            (np.array([215.0, 220, 225]), side * wide, eyes + 1, 6, 2.4, 0.9),
            (np.array([30.0, 35, 45]), side * wide, eyes + 1, 2.6, 2.6, 0.95),
            (looks.hair * 0.9, side * wide, brow, 9, 2.2, 0.85),
            (looks.skin * [0.85, 0.88, 1.04], side * 34, 20, 12, 9, 0.6),
            (darker, side * 7, 17, 3.5, 9, 0.5),  # beside the nose
            (darker, side * 4, 22, 2.5, 1.8, 0.8),  # nostrils
            (darker, side * 91, 8, 3, 13, 0.7),  # the rim of the ear
        ]
        for color, lon, lat, half_width, half_height, opacity in spots:
            spot = _spot(longitude, latitude, lon, lat, half_width, half_height)
            face = _blend(face, color, opacity * spot)
    face = _blend(face, np.minimum(looks.skin * 1.12, 250), 0.6 * _spot(longitude, latitude, 0, 11, 3.5, 11))
    return _blend(face, lips, 0.85 * _spot(longitude, latitude, 0, mouth, 14, 3.2))


def _spot(u: Picture, v: Picture, center_u: float, center_v: float, half_u: float, half_v: float) -> Picture:
    """The opacity of an ellipse with a soft edge: 1 inside, one half on the edge."""
    square = ((u - center_u) / half_u) ** 2 + ((v - center_v) / half_v) ** 2
    return np.asarray(1 / (1 + square * square * square), np.float32)


def _blend(picture: Picture, color: NDArray[np.float64], opacity: Picture) -> Picture:
    blended = color.astype(np.float32) - picture
    blended *= opacity[..., None]
    blended += picture
    return np.asarray(blended, np.float32)


def make_surface(
    kind: str, shape: tuple[int, int], color: NDArray[np.float64], rng: np.random.Generator
) -> Picture:
    """A surface (*shape, 3) with a mean color (3,). kind: one of SURFACE_KINDS."""
    uneven = make_noise(*shape, 1.0, rng)
    if kind == WOOD_SURFACE:
        uneven = 0.4 * uneven + make_noise(*shape, 1.0, rng, stretch=(1.0, 12.0))
    picture = _colored(1 + 0.07 * uneven, color)
    if kind == STRIPED_SURFACE:
        count = rng.integers(3, 14)
        phase = np.arange(shape[1]) / shape[1] * count % 1 < rng.uniform(0.3, 0.7)
        picture[:, phase] *= np.float32(rng.uniform(0.5, 1.4, 3))
    elif kind == BLOTCHED_SURFACE:
        coarse = (max(shape[0] // 4, 4), max(shape[1] // 4, 4))
        tones = rng.uniform(0.03, 0.15) * np.stack([make_noise(*coarse, 1.2, rng) for _ in range(3)], axis=-1)
        tones += np.float32(0.22) * make_noise(*coarse, 1.2, rng)[..., None]
        picture *= imgproc.resize(np.exp(tones), *shape, "linear")
    elif kind == CLUTTERED_SURFACE:
        _add_clutter(picture, rng)
    return np.clip(picture, 4, 250, out=picture)


def _colored(brightness: Picture, color: NDArray[np.float64]) -> Picture:
    """The picture (h, w, 3) of a brightness (h, w) times a color (3,), computed in double precision."""
    picture = np.empty((*brightness.shape, 3), np.float32)
    for channel, level in enumerate(color):
        np.multiply(brightness, level, out=picture[..., channel], dtype=np.float64, casting="same_kind")
    return picture


def _add_clutter(picture: Picture, rng: np.random.Generator) -> None:
    """Add random rectangles, such as books, posters and tiles, in place."""
    height, width = picture.shape[:2]
    for _ in range(int(rng.integers(8, 25))):
        rows, columns = (np.array([height, width]) * rng.uniform(0.06, 0.35, 2)).astype(int) + 1
        top, left = (rng.random(2) * (height - rows, width - columns)).astype(int)
        part = picture[top : top + rows, left : left + columns]
        part[:] = random_color(rng) * (part / part.mean())
        if rng.random() < 0.5:  # a title or a picture
            inner = part[rows // 4 : rows // 2, columns // 5 : 4 * columns // 5]
            inner[:] = random_color(rng)


def random_color(rng: np.random.Generator) -> NDArray[np.float64]:
    """A random BGR color (3,) like those of indoor things: seldom vivid, half of the time warm."""
    warm = rng.random() < 0.5
    hue = rng.normal(0.55, 0.25) if warm else rng.uniform(0, 2 * np.pi)  # radians; 0 is red, 1 is yellow
    vivid, level = rng.beta(1.5, 3.5), 220 * rng.beta(2.0, 2.0) + 20
    wave = np.cos(hue - np.array([4.0, 2, 0]) * np.pi / 3)  # blue, green, red
    return np.asarray(level * (1 + 0.9 * vivid * (wave - 1) / 2))


def build_pyramid(texture: Picture) -> list[Picture]:
    """An image pyramid of a texture, whose levels halve in size."""
    levels = [texture]
    while min(levels[-1].shape[:2]) >= 2 * MIN_LEVEL_SIDE:
        height, width = levels[-1].shape[:2]
        levels.append(imgproc.resize(levels[-1], height // 2, width // 2, "area"))
    return levels


def select_level(levels: Sequence[Picture], texels: float) -> list[Picture]:
    """The one level for samples that span ``texels`` texels of the finest level, as a pyramid of one level.

    Sampling from it keeps the level fixed while the distance changes; a switch would be visible.
    """
    return [levels[min(max(round(math.log2(max(texels, 1.0))), 0), len(levels) - 1)]]


def sample_texture(levels: Sequence[Picture], u: Picture, v: Picture, texels: float) -> Picture:
    """The colors (h, w, 3) of a texture at u, v (h, w), in [0, 1] of its width and height, bilinearly.

    texels: how many texels of the finest level a sample spans. The texture is periodic along u.
    """
    (level,) = select_level(levels, texels)
    height, width = level.shape[:2]
    columns, rows = u * np.float32(width) - np.float32(0.5), v * np.float32(height) - np.float32(0.5)
    np.clip(rows, 0, height - 1, out=rows)
    return imgproc.remap(level, columns, rows, "wrap")
