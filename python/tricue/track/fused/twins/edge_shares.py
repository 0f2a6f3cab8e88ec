# SPDX-License-Identifier: MIT
"""What a map has along the edges of boxes: where a target ends."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse


def edge_shares(
    plane: NDArray[np.float32], widths: NDArray[np.float64], heights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(N,) means of a map in boxes of the given sizes, pixels, round the middle of the map; 0 lies outside.

    Two of them give what lies between two boxes.
    """
    if widths.shape != heights.shape:
        refuse("heights", f"shape {widths.shape}", heights.shape)
    rows, columns = plane.shape
    down, across = _covered(rows, heights), _covered(columns, widths)
    sums: NDArray[np.float64] = ((down @ plane.astype(np.float64)) * across).sum(axis=1)
    return sums / (widths * heights)


def _covered(count: int, lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    low = (count - lengths[:, None]) / 2
    pixel = np.arange(count)[None]
    covered: NDArray[np.float64] = np.minimum(low + lengths[:, None], pixel + 1) - np.maximum(low, pixel)
    return np.clip(covered, 0, 1)
