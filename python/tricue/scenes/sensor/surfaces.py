# SPDX-License-Identifier: MIT
"""How a depth camera distorts surfaces: edges are ragged and smeared, thin things are lost."""

from typing import NamedTuple

import numpy as np

from tricue import imgproc
from tricue.scenes.arrays import Array
from tricue.scenes.rendering.depth_sensor import add_flying_pixels, find_depth_edges

RAGGED_GRAIN = 2.0  # pixels, the sigma of the field by which edges are displaced
MIN_THIN_STEP = 0.05  # between a thin thing and what is behind it, as a share of its depth


class SurfaceFaults(NamedTuple):
    """How a depth camera distorts surfaces; lengths in pixels.

    thin: near things up to this width are lost. ragged: standard deviation of the edges' displacement. smear:
    sigma of a blur across edges. flying: share of the pixels at edges that measure a depth between both
    surfaces.
    """

    thin: int
    ragged: float
    smear: float
    flying: float

    def apply(self, depth: Array, rng: np.random.Generator) -> Array:
        """The measured surfaces (H, W), from an exact z-buffer of finite depths."""
        seen = _lose_thin_things(depth, self.thin)
        seen = _displace(seen, self.ragged, rng)
        if self.smear > 0:
            seen = imgproc.gaussian_blur(seen, self.smear)
        return add_flying_pixels(seen, find_depth_edges(seen), self.flying, rng)


def smooth_noise(shape: tuple[int, ...], grain: float, rng: np.random.Generator) -> Array:
    """Gaussian noise (H, W) of mean 0 and deviation 1, blurred by a sigma of ``grain`` pixels."""
    noise = imgproc.gaussian_blur(rng.standard_normal(shape), grain)
    return np.asarray(noise / noise.std())


def _lose_thin_things(depth: Array, width: int) -> Array:
    """A morphological closing: narrow near things get the depth of what is behind them."""
    # The second anchor mirrors the first; otherwise an even square would shift everything.
    anchors = [(width + odd) // 2 for odd in (1, 0)]
    closed = imgproc.erode(imgproc.dilate(depth, width + 1, anchors[0]), width + 1, anchors[1])
    return np.where(closed - depth > MIN_THIN_STEP * depth, closed, depth)


def _displace(depth: Array, deviation: float, rng: np.random.Generator) -> Array:
    """The depth at randomly displaced pixels, nearest neighbors."""
    v, u = np.indices(depth.shape)
    away = [deviation * smooth_noise(depth.shape, RAGGED_GRAIN, rng) for _ in range(2)]
    rows, columns = (np.rint(at + by).astype(int) for at, by in zip((v, u), away, strict=True))
    height, width = depth.shape
    return np.asarray(depth[rows.clip(0, height - 1), columns.clip(0, width - 1)])
