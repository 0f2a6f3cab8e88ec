# SPDX-License-Identifier: MIT
"""Where in an ellipse, and round it, pixels are read: places (u, v) in semi-axes, (0, 0) the center."""

import numpy as np
from numpy.typing import NDArray

GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


def grid(rows: int, columns: int, reach: float = 1.0) -> NDArray[np.float64]:
    """(rows x columns, 2): the centers of a regular grid over [-reach, reach]², the ellipse's box where reach
    is 1.
    """
    v = ((np.arange(rows) + 0.5) * 2 / rows - 1) * reach
    u = ((np.arange(columns) + 0.5) * 2 / columns - 1) * reach
    return np.stack([np.tile(u, rows), np.repeat(v, columns)], axis=1)


def ring(count: int, inner: float, outer: float) -> NDArray[np.float64]:
    """(count, 2): a sunflower of evenly dense places between the radii inner and outer; 0 gives the whole
    disk.
    """
    index = np.arange(count)
    radius = np.sqrt(inner**2 + (outer**2 - inner**2) * (index + 0.5) / count)
    angle = index * GOLDEN_ANGLE
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
