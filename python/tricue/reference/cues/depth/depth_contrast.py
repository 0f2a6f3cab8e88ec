# SPDX-License-Identifier: MIT
"""The depths in and around rectangles in meters (Sabeti, Parvizi, Wu 2008, equation (38))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import require_camera
from tricue.reference.cues.depth.depth_distance import ReferenceHistogram, depth_distance

RectanglePattern = tuple[int, int, float, int]  # rows, columns, margin, along

MAX_PLACES = 64
OUTSIDE = np.array([-1.0, -1.0, 0.0, 0.0])  # a rectangle of no pixels


def depth_contrast(
    depth: NDArray[np.float32],
    camera: Floats,
    states: Floats,
    model: ReferenceHistogram,
    places: RectanglePattern,
    occluder_margin: float,
) -> Floats:
    """Calls depth_distance for the projected rectangles, and for the rings around them."""
    _require(camera, states, places)
    rows, columns, margin, along = places
    only_shares = np.zeros(1), model[1]
    with np.errstate(over="ignore", invalid="ignore"):
        rectangles = _seen_by(camera, states)
        inside = depth_distance(depth, rectangles, model, grid_pattern(rows, columns), occluder_margin)
        around = depth_distance(depth, rectangles, only_shares, _ring(margin, along), occluder_margin)
    return np.column_stack([inside, around[:, 1]])


def _seen_by(camera: Floats, states: Floats) -> Floats:
    """(N, 5): the projected rectangles: center x, y, width, height, pixels, and Z, meters."""
    fx, fy, cx, cy = camera
    x, y, z, width, height = states.T
    per_x, per_y = fx / z, fy / z
    seen = np.column_stack([x * per_x + (cx + 0.5), y * per_y + (cy + 0.5), width * per_x, height * per_y, z])
    seen[~np.isfinite(seen).all(axis=1), :4] = OUTSIDE
    return seen


def _middles(n: int) -> Floats:
    """The middles of n equal parts of [-1, 1]."""
    return (2 * np.arange(n) + 1) / n - 1


def grid_pattern(rows: int, columns: int) -> Floats:
    """(rows x columns, 2): the middles of equal parts of [-1, 1] x [-1, 1], row by row."""
    v, u = np.meshgrid(_middles(rows), _middles(columns), indexing="ij")
    return np.column_stack([u.ravel(), v.ravel()])


def _ring(margin: float, along: int) -> Floats:
    middles, off = _middles(along), np.full(along, margin)
    sides = (-off, middles), (off, middles), (middles, -off), (middles, off)
    return np.concatenate([np.column_stack(side) for side in sides])


def _require(camera: Floats, states: Floats, places: RectanglePattern) -> None:
    rows, columns, margin, along = places
    require_camera(camera)
    require_shape("states", states, (len(states), 5))
    require_finite("states", states)
    if (states[:, 2] <= 0).any():
        refuse("states", "Z above 0", float(states[states[:, 2] <= 0, 2][0]))
    for name, number in (("rows", rows), ("columns", columns), ("along", along)):
        if not 1 <= number <= MAX_PLACES:
            refuse(name, f"1 to {MAX_PLACES}", number)
    if not 1 <= margin < np.inf:
        refuse("margin", "a finite number of at least 1", float(margin))
