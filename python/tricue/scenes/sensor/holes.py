# SPDX-License-Identifier: MIT
"""A depth camera's holes, in patches: on dark and shiny surfaces, along edges, and on slanted surfaces."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.rendering.depth_sensor import find_depth_edges
from tricue.scenes.sensor.surfaces import smooth_noise

MAX_DARK, MIN_BRIGHT = 60, 200  # levels of 255
SLANT_STEP = 3  # pixels over which the slope of a surface is measured
MIN_SLANT, MAX_SLANT = 4.0, 12.0  # tangents of the slant at which holes begin, and at which all is lost
LASTING = 0.7  # share of the patches' variance that is kept from frame to frame


class HoleShares(NamedTuple):
    """The shares of pixels without depth, by surface, and near depth edges.

    reach: how many pixels from an edge count as near it. grain: sigma of the patches, pixels.
    """

    dark: float
    medium: float
    bright: float
    shiny: float
    edge: float
    reach: int
    grain: float


class HoleField:
    """The patches of one scene; they change slowly from frame to frame."""

    def __init__(self, shape: tuple[int, int], shares: HoleShares, rng: np.random.Generator) -> None:
        self._shares, self._rng = shares, rng
        self._lasting = smooth_noise(shape, shares.grain, rng)

    def next_holes(self, depth: Array, gray: NDArray[np.uint8], shiny: Mask, intrinsics: Intrinsics) -> Mask:
        """The next frame's holes (H, W).

        depth: an exact z-buffer of finite depths. gray: its brightness. shiny: the shiny pixels.
        """
        shares = self._shares
        chance = np.select(
            [shiny, gray < MAX_DARK, gray > MIN_BRIGHT],
            [shares.shiny, shares.dark, shares.bright],
            shares.medium,
        )
        beside = imgproc.dilate(find_depth_edges(depth).astype(np.uint8), 2 * shares.reach + 1) > 0
        chance[beside] = np.maximum(chance[beside], shares.edge)
        slant = (_slant(depth, intrinsics) - MIN_SLANT) / (MAX_SLANT - MIN_SLANT)
        chance = np.maximum(chance, np.clip(slant, 0, 1))
        fresh = smooth_noise(gray.shape, shares.grain, self._rng)
        field = np.sqrt(LASTING) * self._lasting + np.sqrt(1 - LASTING) * fresh
        return np.asarray(_ranks(field) < chance)


def _ranks(field: Array) -> Array:
    """For each value, the share of values that are smaller."""
    ranks = np.empty(field.size)
    ranks[np.argsort(field, axis=None)] = np.arange(field.size) / field.size
    return ranks.reshape(field.shape)


def _slant(depth: Array, camera: Intrinsics) -> Array:
    """The slope (H, W) of the surface: change of depth per meter across the line of sight; 0 at depth steps.

    A step is on one side of a pixel, a slope on both, so the smaller of the two differences counts.
    """
    slopes = []
    for axis, focal in ((1, camera.fx), (0, camera.fy)):
        before, after = (np.abs(depth - _shifted(depth, by, axis)) for by in (SLANT_STEP, -SLANT_STEP))
        slopes.append(np.minimum(before, after) * focal / (SLANT_STEP * depth))
    return imgproc.box_blur(np.hypot(*slopes), 3)


def _shifted(values: Array, by: int, axis: int) -> Array:
    """The values ``by`` pixels before, with the image's border replicated."""
    index = np.clip(np.arange(values.shape[axis]) - by, 0, values.shape[axis] - 1)
    return np.take(values, index, axis)
