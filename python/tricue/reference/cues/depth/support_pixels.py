# SPDX-License-Identifier: MIT
"""The pixels around a target, and in its box, that lie on the plane that supports it."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import MAX_GRID_SIDE, refuse, require_count, require_shape
from tricue.reference.base.depth_pixels import has_depth, require_camera
from tricue.reference.cues.depth.floor_plane import floor_plane

Mask = NDArray[np.uint8]

MAX_DEPTH = 2.0  # of the target's depth; farther pixels are ignored
TARGET_SHARE = 1.05  # of the box's sides: the part whose pixels may be the target's, so they don't vote
INNER_SHARE = 0.8  # of the box's sides: the part that mustn't be on the plane
MAX_PLANE_SHARE = 0.5  # of that part's pixels; a target with more on the plane is as flat as the plane
MIN_SUPPORT_SHARE = 0.15  # of the votes, that a plane needs
MIN_VOTES = 60  # pixels
THINNING = 2  # every second row and column votes
UP, ANY_DIRECTION = np.array([0.0, -1.0, 0.0]), -1.0


def support_pixels(
    depth: Depth,
    x0: float,
    y0: float,
    step: float,
    side: int,
    width: float,
    height: float,
    z: float,
    camera: Floats,
    draws: Floats,
    tolerance: float,
) -> Mask:
    """Finds the plane of the surround by floor_plane, and compares all depths with it."""
    _require_arguments(x0, y0, step, side, width, height, z, camera, draws, tolerance)
    nowhere = np.zeros((side, side), np.uint8)
    depths = _read_grid(depth, x0, y0, step, side)
    depths[~(has_depth(depths) & (depths < np.float32(MAX_DEPTH * z)))] = np.nan
    surround = depths.copy()
    surround[_middle(side, width, height, TARGET_SHARE)] = np.nan
    thin = np.ascontiguousarray(surround[::THINNING, ::THINNING])
    votes = np.flatnonzero(has_depth(thin))
    if len(votes) < MIN_VOTES:
        return nowhere
    triples = votes[np.minimum((draws * len(votes)).astype(int), len(votes) - 1)]
    fx, fy, cx, cy = camera
    lens = np.array([fx / step, fy / step, (cx - x0) / step, (cy - y0) / step])
    nx, ny, nz, d, share, _ = floor_plane(thin, lens / THINNING, triples, tolerance, UP, ANY_DIRECTION)
    if share < MIN_SUPPORT_SHARE:
        return nowhere
    squares = np.arange(side)
    x, y = (squares - lens[2]) / lens[0], ((squares - lens[3]) / lens[1])[:, None]
    heights = (nx * x + ny * y + nz) * depths + d
    on_plane = np.abs(heights) < tolerance
    inner = _middle(side, width, height, INNER_SHARE)
    known = has_depth(depths[inner])
    if on_plane[inner][known].sum() > MAX_PLANE_SHARE * known.sum():
        return nowhere
    mask: Mask = on_plane.astype(np.uint8)
    return mask


def _read_grid(depth: Depth, x0: float, y0: float, step: float, side: int) -> Depth:
    """The depths under the squares' centers, one at a time; NaN outside the image."""
    depths = np.full((side, side), np.nan, np.float32)
    for i, j in np.ndindex(side, side):
        x, y = x0 + (j + 0.5) * step, y0 + (i + 0.5) * step
        if 0 <= x < depth.shape[1] and 0 <= y < depth.shape[0]:
            depths[i, j] = depth[int(y), int(x)]
    return depths


def _middle(side: int, width: float, height: float, share: float) -> tuple[slice, slice]:
    """The rows and columns of a box around the middle; share: of its sides.

    Half a side is at least one square, so that there is at least one of each.
    """
    offsets = np.abs(np.arange(side) + 0.5 - side / 2)
    rows, columns = (np.flatnonzero(offsets < max(share * length / 2, 1.0)) for length in (height, width))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _require_arguments(
    x0: float,
    y0: float,
    step: float,
    side: int,
    width: float,
    height: float,
    z: float,
    camera: Floats,
    draws: Floats,
    tolerance: float,
) -> None:
    for name, number in (("x0", x0), ("y0", y0)):
        if not np.isfinite(number):
            refuse(name, "a finite number", float(number))
    require_count("side", side, 2, MAX_GRID_SIDE)
    positive = (("step", step), ("width", width), ("height", height), ("z", z), ("tolerance", tolerance))
    for name, number in positive:
        if not 0 < number < np.inf:
            refuse(name, "a finite number above 0", float(number))
    require_shape("draws", draws, (len(draws), 3))
    strange = draws[~((draws >= 0) & (draws < 1))]
    if strange.size:
        refuse("draws", "numbers in [0, 1)", float(strange[0]))
    require_camera(camera)
