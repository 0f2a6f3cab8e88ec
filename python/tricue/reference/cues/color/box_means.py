# SPDX-License-Identifier: MIT
"""What a map has in boxes around a place, and so along their edges: where a target ends."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_finite, require_shape

Floats = NDArray[np.float64]


def box_means(plane: NDArray[np.float32], x: float, y: float, widths: Floats, heights: Floats) -> Floats:
    """Multiplies the map by the parts of its rows and columns that each box covers."""
    if plane.size < 1:
        refuse("plane", "at least one pixel", "none")
    for name, place in (("x", x), ("y", y)):
        if not np.isfinite(place):
            refuse(name, "a finite number", place)
    _require_lengths("widths", widths)
    require_shape("heights", heights, widths.shape)
    _require_lengths("heights", heights)
    require_finite("plane", plane.astype(np.float64))
    rows, columns = plane.shape
    down, across = covered(rows, y, heights), covered(columns, x, widths)
    sums: Floats = ((down @ plane.astype(np.float64)) * across).sum(axis=1)
    return sums / (widths * heights)


def covered(size: int, centers: Floats | float, lengths: Floats | float) -> Floats:
    """(N, size): how much of each pixel lengths around N centers cover."""
    low, high = np.atleast_1d(centers - lengths / 2), np.atleast_1d(centers + lengths / 2)
    pixel = np.arange(size)
    overlap: Floats = np.minimum(high[:, None], pixel + 1) - np.maximum(low[:, None], pixel)
    return np.clip(overlap, 0, 1)


def _require_lengths(name: str, lengths: Floats) -> None:
    require_finite(name, lengths)
    if not (lengths > 0).all():
        refuse(name, "numbers above 0", float(lengths[lengths <= 0][0]))
