# SPDX-License-Identifier: MIT
"""What all renders are painted with: colors as linear RGB, soft shapes, and noise."""

import cv2
import numpy as np
from numpy.typing import ArrayLike
from tricue.arrays import Floats

Random = np.random.Generator

FAIR, DARK = np.log([0.72, 0.47, 0.36]), np.log([0.13, 0.065, 0.04])  # albedo of skin
BLACK_HAIR = np.array([0.05, 0.035, 0.025])
TYPICAL, SPREAD = -1.6, 1.0  # log of an object's albedo


def skin_color(rng: Random) -> Floats:
    """An albedo between those of the fairest and the darkest people; dark ones are rarer than fair ones."""
    darkness = rng.uniform() ** 1.3
    return np.asarray(np.exp(FAIR + darkness * (DARK - FAIR) + rng.normal(0, [0.03, 0.06, 0.06])))


def any_color(rng: Random, saturation: float = 0.27) -> Floats:
    """An albedo of any thing. saturation: deviation of the channels' logs."""
    return np.exp(rng.normal(TYPICAL, SPREAD) + rng.normal(0, saturation, 3))


def hair_color(rng: Random) -> Floats:
    """Mostly black or brown; else blond, gray or red."""
    kind = rng.uniform()
    if kind < 0.2:
        return np.array([0.35, 0.22, 0.10]) * rng.uniform(0.4, 1.2)
    if kind < 0.3:
        return np.array([0.30, 0.28, 0.27]) * rng.uniform(0.5, 1.3)
    if kind < 0.4:
        return np.array([0.18, 0.07, 0.03]) * rng.uniform(0.5, 1.2)
    return BLACK_HAIR * rng.uniform(0.2, 1.5)


def ramp(values: Floats, start: Floats | float, end: Floats | float) -> Floats:
    """From 0 at start to 1 at end, smoothly."""
    share = np.clip((values - start) / (end - start), 0, 1)
    return np.asarray(share * share * (3 - 2 * share))


def bell(x: Floats, y: Floats, at: tuple[float, float], size: tuple[float, float]) -> Floats:
    """A Gaussian with its peak of 1 at (x, y), and these deviations along x and y."""
    return np.asarray(np.exp(-0.5 * (((x - at[0]) / size[0]) ** 2 + ((y - at[1]) / size[1]) ** 2)))


def line(distance: Floats, width: float) -> Floats:
    """A soft line where the distance is 0. width: its deviation."""
    return np.asarray(np.exp(-0.5 * (distance / width) ** 2))


def disc(x: Floats, y: Floats, radii: tuple[float, float], softness: float) -> Floats:
    """1 inside the ellipse around the origin, and less outside, by how soft its edge is."""
    beyond = (x / radii[0]) ** 2 + (y / radii[1]) ** 2 - 1
    return np.asarray(np.exp(-np.maximum(beyond, 0) / softness))


def noise(rng: Random, shape: tuple[int, ...], grain: float) -> Floats:
    """Normal noise of deviation 1 on a grid as coarse as its grain, pixels, interpolated."""
    rows, columns = (max(2, round(size / grain) + 1) for size in shape)
    coarse = rng.standard_normal((rows, columns))
    return np.asarray(cv2.resize(coarse, (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC), np.float64)


def polygon(image: Floats, corners: ArrayLike, color: ArrayLike) -> None:
    """Fill a convex polygon."""
    whole = np.asarray(np.rint(corners), np.int32)
    cv2.fillConvexPoly(image, whole, np.asarray(color, float).tolist())


def ellipse(image: Floats, at: ArrayLike, radii: ArrayLike, color: ArrayLike, turn: float = 0) -> None:
    """Fill an ellipse. turn: degrees."""
    center, axes = (np.asarray(each, int).tolist() for each in (at, radii))
    cv2.ellipse(image, center, axes, turn, 0, 360, np.asarray(color, float).tolist(), -1)


def rectangle(image: Floats, at: Floats, radii: Floats, color: ArrayLike) -> None:
    """Fill an upright rectangle. radii: half of its sides."""
    polygon(image, at + radii * [[-1, -1], [1, -1], [1, 1], [-1, 1]], color)
