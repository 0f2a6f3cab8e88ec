# SPDX-License-Identifier: MIT
"""Center-surround contrast: how much higher a map is in a box than around it, for every place of the box."""

import numpy as np

from tricue.reference.base.arrays import Floats, Plane
from tricue.reference.base.checks import refuse, require_finite


def box_contrast(
    plane: Plane, width: float, height: float, surround_size: float, surround_weight: float
) -> Plane:
    """Multiplies the map by the fractions of its rows and columns that each box covers."""
    _require_arguments(plane, width, height, surround_size, surround_weight)
    rows, columns = plane.shape[0] // 2, plane.shape[1] // 2
    y, x = (count + 2.0 * (np.arange(count) - count // 2) for count in (rows, columns))
    values = plane.astype(np.float64)

    def box_sums(scale: float) -> Floats:
        return np.asarray(
            _covered(2 * rows, y, scale * height) @ values @ _covered(2 * columns, x, scale * width).T
        )

    inner, whole = box_sums(1.0), box_sums(surround_size)
    area = width * height
    surround_area = area * (surround_size * surround_size - 1)
    contrast: Floats = inner / area - surround_weight * (whole - inner) / surround_area
    return contrast.astype(np.float32)


def _covered(size: int, centers: Floats, length: float) -> Floats:
    """(N, size): the fraction of each pixel that an interval around each of N centers covers."""
    low, high, pixel = centers - length / 2, centers + length / 2, np.arange(size)
    overlap: Floats = np.minimum(high[:, None], pixel + 1) - np.maximum(low[:, None], pixel)
    return np.clip(overlap, 0, 1)


def _require_arguments(
    plane: Plane, width: float, height: float, surround_size: float, surround_weight: float
) -> None:
    if min(plane.shape) < 2 or plane.shape[0] % 2 or plane.shape[1] % 2:
        refuse("plane", "even sides of at least 2", plane.shape)
    for name, number, low in (
        ("width", width, 0),
        ("height", height, 0),
        ("surround_size", surround_size, 1),
    ):
        if not low < number < np.inf:
            refuse(name, f"a finite number above {low}", float(number))
    if not np.isfinite(surround_weight):
        refuse("surround_weight", "a finite number", float(surround_weight))
    require_finite("plane", plane.astype(np.float64))
