# SPDX-License-Identifier: MIT
"""Center-surround contrast: how much higher a map is in a box than around it, for every place of the box."""

import numpy as np

from tricue.reference.base.arrays import Floats, Plane
from tricue.reference.base.checks import refuse, require_finite


def box_contrast(plane: Plane, width: float, height: float, outer: float, around: float) -> Plane:
    """Multiplies the map by the fractions of its rows and columns that each box covers."""
    _require_arguments(plane, width, height, outer, around)
    rows, columns = plane.shape[0] // 2, plane.shape[1] // 2
    y, x = (count + 2.0 * (np.arange(count) - count // 2) for count in (rows, columns))
    values = plane.astype(np.float64)
    inner = _covered(2 * rows, y, height) @ values @ _covered(2 * columns, x, width).T
    whole = _covered(2 * rows, y, height * outer) @ values @ _covered(2 * columns, x, width * outer).T
    area = width * height
    contrast: Floats = inner / area - around * (whole - inner) / (area * (outer * outer - 1))
    return contrast.astype(np.float32)


def _covered(size: int, centers: Floats, length: float) -> Floats:
    """(N, size): the fraction of each pixel that an interval around each of N centers covers."""
    low, high, pixel = centers - length / 2, centers + length / 2, np.arange(size)
    overlap: Floats = np.minimum(high[:, None], pixel + 1) - np.maximum(low[:, None], pixel)
    return np.clip(overlap, 0, 1)


def _require_arguments(plane: Plane, width: float, height: float, outer: float, around: float) -> None:
    if min(plane.shape) < 2 or plane.shape[0] % 2 or plane.shape[1] % 2:
        refuse("plane", "even sides of at least 2", plane.shape)
    for name, number, low in (("width", width, 0), ("height", height, 0), ("outer", outer, 1)):
        if not low < number < np.inf:
            refuse(name, f"a finite number above {low}", float(number))
    if not np.isfinite(around):
        refuse("around", "a finite number", float(around))
    require_finite("plane", plane.astype(np.float64))
