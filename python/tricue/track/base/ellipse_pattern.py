# SPDX-License-Identifier: MIT
"""Sampling patterns inside and around an ellipse: points (u, v) in units of its semi-axes, center (0, 0)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


class EllipsePattern(NamedTuple):
    """Where an ellipse, (n, 2), and its surround, (m, 2), are sampled."""

    inside: NDArray[np.float64]
    around: NDArray[np.float64]


def grid(rows: int, columns: int, extent: float = 1.0) -> NDArray[np.float64]:
    """(rows x columns, 2): the cell centers of a regular grid over [-extent, extent]².

    An extent of 1 covers the ellipse's bounding box.
    """
    v = ((np.arange(rows) + 0.5) * 2 / rows - 1) * extent
    u = ((np.arange(columns) + 0.5) * 2 / columns - 1) * extent
    return np.stack([np.tile(u, rows), np.repeat(v, columns)], axis=1)


def ring(count: int, inner: float, outer: float) -> NDArray[np.float64]:
    """(count, 2): points of even density between two radii, in a sunflower pattern.

    An inner radius of 0 fills the whole disk.
    """
    index = np.arange(count)
    radius = np.sqrt(inner**2 + (outer**2 - inner**2) * (index + 0.5) / count)
    angle = index * GOLDEN_ANGLE
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
