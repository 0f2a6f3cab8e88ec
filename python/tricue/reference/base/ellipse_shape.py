# SPDX-License-Identifier: MIT
"""The pixels inside an axis-aligned ellipse: shared by the twins of the search for heads."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

Mask = NDArray[np.bool_]


def require_ellipse(ellipse: Floats, margin: float = 1.0) -> None:
    """Refuse anything but a finite ellipse with semi-axes in (0, 4096 / margin], and a margin in [1, 16]."""
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    if not 1 <= margin <= 16:
        refuse("margin", "1 to 16", float(margin))
    if not ellipse[2:].min() > 0:
        refuse("ellipse", "semi-axes above 0", float(ellipse[2:].min()))
    longest = float(margin * ellipse[2:].max())
    if longest > 4096:
        suffix = " with the margin" if margin > 1 else ""
        refuse("ellipse", f"semi-axes of at most 4096 pixels{suffix}", longest)


def mask_of(ellipse: Floats, shape: tuple[int, ...], corner: tuple[int, int] = (0, 0)) -> Mask:
    """(H, W): the pixels whose centers are inside the ellipse (x, y, minor, major).

    Computed relative to the pixel of the ellipse's center, so that shifts by whole pixels keep its shape.
    corner: (x, y) of the first pixel.
    """
    x, y, minor, major = ellipse
    columns = np.arange(shape[1]) + corner[0] - np.floor(x)
    rows = np.arange(shape[0]) + corner[1] - np.floor(y)
    x, y = x - np.floor(x), y - np.floor(y)
    with np.errstate(over="ignore"):  # rows far from a very flat ellipse
        v = (rows + 0.5 - y) / major
        reach = minor * np.sqrt(np.maximum(1 - v * v, 0))
    first, last = np.ceil(x - reach - 0.5), np.floor(x + reach - 0.5)
    within = (rows >= np.ceil(y - major - 0.5)) & (rows <= np.floor(y + major - 0.5))
    return np.asarray(within[:, None] & (columns >= first[:, None]) & (columns <= last[:, None]))
