# SPDX-License-Identifier: MIT
"""How much more of a map lies in a box than round it, for every place of the box."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse

Plane = NDArray[np.float32]


def box_contrast(plane: Plane, width: float, height: float, outer: float, around: float) -> Plane:
    """(R, C) of a map (2R, 2C): its mean in a box minus ``around`` times that in the frame round it.

    The box of ``width`` by ``height`` pixels has its centre at (C + 2 (j - C // 2), R + 2 (i - R // 2)) for
    the value in row i, column j; the frame reaches to ``outer`` times its size. Outside the map lies 0.
    Pixels count by the part that is covered, as an integral image gives it.
    """
    if not (width > 0 and height > 0 and outer > 1):
        refuse("box", "sides above 0 and an outer factor above 1", (width, height, outer))
    rows, columns = plane.shape[0] // 2, plane.shape[1] // 2
    inner = _covered(rows, height) @ plane @ _covered(columns, width).T
    whole = _covered(rows, height * outer) @ plane @ _covered(columns, width * outer).T
    area = width * height
    contrast: Plane = inner / area - around * (whole - inner) / (area * (outer * outer - 1))
    return contrast.astype(np.float32)


def _covered(count: int, length: float) -> NDArray[np.float64]:
    """(count, 2 count): how much of each pixel a length covers at each of the places of its centre."""
    centre = (count + 2.0 * (np.arange(count) - count // 2))[:, None]
    pixel = np.arange(2 * count)[None]
    overlap: NDArray[np.float64] = np.minimum(centre + length / 2, pixel + 1) - np.maximum(
        centre - length / 2, pixel
    )
    return np.clip(overlap, 0, 1)
