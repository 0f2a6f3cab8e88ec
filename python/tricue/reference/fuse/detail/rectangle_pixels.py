# SPDX-License-Identifier: MIT
"""The pixels of a rectangle whose corners may lie between pixels."""

import numpy as np

from tricue.reference.base.checks import refuse

Rectangle = tuple[float, float, float, float]


def rectangle_pixels(rectangle: Rectangle, shape: tuple[int, ...], name: str) -> tuple[slice, slice]:
    """Rows and columns of the pixels whose centers lie in [x0, x1) x [y0, y1); pixel 0 is [0, 1).

    Clipped to the image, and empty where x1 <= x0 or y1 <= y0.
    """
    require_finite_corners(rectangle, name)
    x0, y0, x1, y1 = rectangle
    return _inside(y0, y1, shape[0]), _inside(x0, x1, shape[1])


def require_finite_corners(rectangle: Rectangle, name: str) -> None:
    """Refuse corners that are NaN or infinite."""
    for corner in rectangle:
        if not np.isfinite(corner):
            refuse(name, "finite corners", float(corner))


def _inside(begin: float, end: float, size: int) -> slice:
    """The i in [0, size) with begin <= i + 0.5 < end."""
    first, last = (int(np.clip(np.ceil(np.float64(edge) - 0.5), 0, size)) for edge in (begin, end))
    return slice(first, max(first, last))
