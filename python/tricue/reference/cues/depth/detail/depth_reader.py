# SPDX-License-Identifier: MIT
"""The depths in a rectangle, in levels relative to the rectangle's depth: shared by kernels of rectangles."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import has_depth


def read(depth: Depth, rectangle: Floats, pattern: Floats) -> NDArray[np.float32]:
    """The measured depths at the pattern's places, of those inside the image.

    pattern: (N, 2) u, v from the rectangle's center, in halves of its width and height.
    """
    x, y, width, height, _ = rectangle
    columns, rows = np.floor(x + width / 2 * pattern[:, 0]), np.floor(y + height / 2 * pattern[:, 1])
    inside = (rows >= 0) & (rows < depth.shape[0]) & (columns >= 0) & (columns < depth.shape[1])
    seen = depth[rows[inside].astype(np.intp), columns[inside].astype(np.intp)]
    measured: NDArray[np.float32] = seen[has_depth(seen)]
    return measured


def count(seen: NDArray[np.float32], z: float, levels: int, reach: float) -> NDArray[np.intp]:
    """(levels,) the number of depths in each level of [-reach, reach) around z."""
    level = np.floor((seen - np.float32(z - reach)) * np.float32(levels / (2 * reach)))
    level = level[(level >= 0) & (level < levels)]
    return np.bincount(level.astype(np.intp), minlength=levels)


def require(pattern: Floats, reach: float) -> None:
    """Refuse a pattern that is empty or isn't finite, and a reach that isn't above 0."""
    require_shape("pattern", pattern, (len(pattern), 2))
    if len(pattern) < 1:
        refuse("pattern", "at least one place", "none")
    require_finite("pattern", pattern)
    if not 0 < reach < np.inf:
        refuse("reach", "a finite number above 0", float(reach))
