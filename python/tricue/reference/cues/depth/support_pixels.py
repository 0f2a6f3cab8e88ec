# SPDX-License-Identifier: MIT
"""The pixels around a target, and in its box, that lie on the plane that supports it."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.base.depth_pixels import has_depth, require_camera
from tricue.reference.cues.depth.detail.sample_grid import SampleGrid, require_grid
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
    grid: SampleGrid,
    target: tuple[float, float, float],
    camera: Floats,
    draws: Floats,
    tolerance: float,
) -> Mask:
    """Finds the plane of the surround by floor_plane, and compares all depths with it."""
    (x0, y0, step, rows, columns), (width, height, z) = grid, target
    require_grid(grid)
    _require_arguments(width, height, z, camera, draws, tolerance)
    nowhere = np.zeros((rows, columns), np.uint8)
    depths = _read_grid(depth, grid)
    depths[~(has_depth(depths) & (depths < np.float32(MAX_DEPTH * z)))] = np.nan
    surround = depths.copy()
    surround[_middle(rows, height, TARGET_SHARE), _middle(columns, width, TARGET_SHARE)] = np.nan
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
    x, y = (np.arange(columns) - lens[2]) / lens[0], ((np.arange(rows) - lens[3]) / lens[1])[:, None]
    heights = (nx * x + ny * y + nz) * depths + d
    on_plane = np.abs(heights) < tolerance
    inner = _middle(rows, height, INNER_SHARE), _middle(columns, width, INNER_SHARE)
    known = has_depth(depths[inner])
    if on_plane[inner][known].sum() > MAX_PLANE_SHARE * known.sum():
        return nowhere
    mask: Mask = on_plane.astype(np.uint8)
    return mask


def _read_grid(depth: Depth, grid: SampleGrid) -> Depth:
    """The depths under the squares' centers, one at a time; NaN outside the image."""
    x0, y0, step, rows, columns = grid
    depths = np.full((rows, columns), np.nan, np.float32)
    for i, j in np.ndindex(rows, columns):
        x, y = x0 + (j + 0.5) * step, y0 + (i + 0.5) * step
        if 0 <= x < depth.shape[1] and 0 <= y < depth.shape[0]:
            depths[i, j] = depth[int(y), int(x)]
    return depths


def _middle(count: int, length: float, share: float) -> slice:
    """The rows or columns of a box around the middle of so many; share: of its side.

    Half a side is at least one square, so that there is at least one.
    """
    offsets = np.abs(np.arange(count) + 0.5 - count / 2)
    squares = np.flatnonzero(offsets < max(share * length / 2, 1.0))
    return slice(squares[0], squares[-1] + 1)


def _require_arguments(
    width: float, height: float, z: float, camera: Floats, draws: Floats, tolerance: float
) -> None:
    for name, number in (("width", width), ("height", height), ("z", z), ("tolerance", tolerance)):
        if not 0 < number < np.inf:
            refuse(name, "a finite number above 0", float(number))
    require_shape("draws", draws, (len(draws), 3))
    strange = draws[~((draws >= 0) & (draws < 1))]
    if strange.size:
        refuse("draws", "numbers in [0, 1)", float(strange[0]))
    require_camera(camera)
