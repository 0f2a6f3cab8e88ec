# SPDX-License-Identifier: MIT
"""The mean gradient along an ellipse's outline (Birchfield 1998, equation (2))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import Floats, refuse, require_finite, require_shape
from tricue.reference.cues.color.detail.ellipse_shape import require_ellipses
from tricue.reference.cues.color.detail.search_grid import Grid, places, require_grid


def ellipse_gradient(gray: NDArray[np.uint8], ellipse: Floats, grid: Grid, pattern: Floats) -> Floats:
    """Averages |n . grad I| over the outline's points inside the image, place by place."""
    require_shape("ellipse", ellipse, (4,))
    require_ellipses("ellipse", ellipse[None], 1.0)
    require_grid(grid)
    _require_pattern(pattern)

    height, width = gray.shape
    padded = np.pad(gray.astype(np.float64), 1, "edge") if gray.size else np.zeros((2, 2))
    right = (padded[1:-1, 2:] - padded[1:-1, :-2]) / 2
    down = (padded[2:, 1:-1] - padded[:-2, 1:-1]) / 2
    normals = pattern / ellipse[2:]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)

    found = np.zeros(grid[:2])
    for place in np.ndindex(*grid[:2]):
        x, y, minor, major = places(ellipse, grid)[place]
        columns = np.floor(x) + np.floor(x - np.floor(x) + minor * pattern[:, 0])
        rows = np.floor(y) + np.floor(y - np.floor(y) + major * pattern[:, 1])
        inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
        if inside.any():
            pixels = rows[inside].astype(int), columns[inside].astype(int)
            along = normals[inside, 0] * right[pixels] + normals[inside, 1] * down[pixels]
            found[place] = np.abs(along).mean()
    return found


def _require_pattern(pattern: Floats) -> None:
    require_shape("pattern", pattern, (len(pattern), 2))
    if len(pattern) == 0:
        refuse("pattern", "at least one place", "none")
    require_finite("pattern", pattern)
    for radius in np.hypot(*pattern.T):
        if not abs(radius**2 - 1) <= 1e-6:
            refuse("pattern", "places on the unit circle", float(radius))
