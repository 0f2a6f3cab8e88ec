# SPDX-License-Identifier: MIT
"""Count, mean and covariance of skin pixels (Sabeti, Parvizi, Wu 2008, equations (5)-(16))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.skin_boundary import skin_boundary


def skin_moments(
    image: NDArray[np.uint8],
    reference: NDArray[np.uint8],
    threshold: float,
    region: tuple[int, int, int, int],
    step: int,
) -> NDArray[np.float64]:
    """Computes mean and covariance of the skin pixels' coordinates."""
    if step < 1:
        refuse("step", "at least 1", step)
    if not -1.0 <= threshold <= 1.0:
        raise ValueError(f"threshold: expected a number in [-1, 1], got {threshold:g}")
    x0, y0 = max(region[0], 0), max(region[1], 0)
    x1, y1 = max(region[2], x0), max(region[3], y0)
    skin = skin_boundary(image[y0 + step // 2 : y1 : step, x0:x1], reference) > 255 * threshold
    rows, columns = np.nonzero(skin)
    if rows.size == 0:
        return np.zeros(6)
    x, y = x0 + columns + 0.5, y0 + step // 2 + step * rows + 0.5
    mean_x, mean_y = x.mean(), y.mean()  # (11), (12)
    xx = np.mean((x - mean_x) ** 2)  # (14)
    yy = np.mean((y - mean_y) ** 2)  # (15)
    xy = np.mean((x - mean_x) * (y - mean_y))  # (16)
    return np.array([step * rows.size, mean_x, mean_y, xx, yy, xy])
