# SPDX-License-Identifier: MIT
"""The depth histogram of a rectangle (Sabeti, Parvizi, Wu 2008, H of equation (38))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.depth.detail import depth_reader


def rectangle_histogram(
    depth: NDArray[np.float32], rectangle: Floats, levels: int, pattern: Floats, reach: float
) -> Floats:
    """Counts the levels at the places of the pattern."""
    require_shape("rectangle", rectangle, (5,))
    require_finite("rectangle", rectangle)
    if not 1 <= levels <= 65536:
        refuse("levels", "1 to 65536", levels)
    depth_reader.require(pattern, reach)
    counts = depth_reader.count(depth_reader.read(depth, rectangle, pattern), rectangle[4], levels, reach)
    return counts / max(int(counts.sum()), 1)
