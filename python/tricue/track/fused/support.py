# SPDX-License-Identifier: MIT
"""The plane that a target stands on, lies on or leans against: it is as far away, and not the target."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.depth_sources import Grid

SUPPORT_TOLERANCE = 0.015  # of the target's depth, of a point on the plane
MAX_SUPPORT_DEPTH = 2.0  # of the target's depth; what is farther away isn't looked at
TARGET_SHARE = 1.05  # of the box's sides: pixels of the target, which don't vote for a plane
INNER_SHARE = 0.8  # of the box's sides: the part that mustn't be the plane itself
MAX_PLANE_SHARE = 0.5  # of that part; a target with more is as flat as the plane
MIN_SUPPORT_SHARE = 0.15  # of the pixels around the target, that a plane has to hold
MIN_SUPPORT_PIXELS = 60  # measured around the target
THINNING = 2  # every so many-th pixel votes
TRIALS = 64  # planes tried
UP, ANY_DIRECTION = np.array([0.0, -1.0, 0.0]), -1.0


def find_support(
    k: Kernels, depths: Plane, grid: Grid, size: tuple[float, float], z: float, camera: Intrinsics
) -> NDArray[np.bool_] | None:
    """The pixels of a target's surround, and of its box, that lie on one plane.

    depths: (n, n) meters, NaN where nothing was measured, around a target at depth z. grid: where they are in
    the image. size: the target's width and height in pixels of the grid.
    None where no plane holds enough of what is around the target, or it holds the target itself. By random
    samples (Fischler and Bolles 1981), the same for the same frame.
    """
    x, y, step = grid
    offsets = np.arange(len(depths), dtype=np.float64) + 0.5 - len(depths) / 2
    depths = np.where(depths < MAX_SUPPORT_DEPTH * z, depths, np.float32(np.nan))
    around = depths.copy()
    around[_inside(offsets, size, TARGET_SHARE)] = np.nan
    thin = np.ascontiguousarray(around[::THINNING, ::THINNING])
    measured = np.flatnonzero(np.isfinite(thin))
    if len(measured) < MIN_SUPPORT_PIXELS:
        return None
    triples = measured[np.random.default_rng(0).integers(len(measured), size=(TRIALS, 3))]
    lens = np.array([camera.fx / step, camera.fy / step, (camera.cx - x) / step, (camera.cy - y) / step])
    tolerance = SUPPORT_TOLERANCE * z
    plane = k.floor_plane(thin, lens / THINNING, triples, tolerance, UP, ANY_DIRECTION)
    if plane[4] < MIN_SUPPORT_SHARE:
        return None
    pixels = np.arange(len(depths))
    right, down = (pixels - lens[2]) / lens[0], (pixels - lens[3])[:, None] / lens[1]
    heights = (plane[0] * right + plane[1] * down + plane[2]) * depths + plane[3]
    on_plane: NDArray[np.bool_] = np.abs(heights) < tolerance
    inner = _inside(offsets, size, INNER_SHARE)
    known = np.isfinite(depths[inner])
    if known.any() and on_plane[inner][known].mean() > MAX_PLANE_SHARE:
        return None
    return on_plane


def _inside(offsets: Floats, size: tuple[float, float], share: float) -> tuple[slice, slice]:
    """The rows and columns of a part of a box of that size around the middle, at least two of each."""
    width, height = (max(share * length / 2, 1.0) for length in size)
    rows, columns = np.flatnonzero(np.abs(offsets) < height), np.flatnonzero(np.abs(offsets) < width)
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
