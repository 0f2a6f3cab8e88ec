# SPDX-License-Identifier: MIT
"""The pixels inside an axis-aligned ellipse: shared by the twins of the search for heads."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

NO_BIN = 65535
Bins = NDArray[np.uint16]
Mask = NDArray[np.bool_]


def require_ellipse(ellipse: Floats, margin: float) -> None:
    """Refuse anything but a finite ellipse with semi-axes in (0, 4096 / margin], and a margin in [1, 16]."""
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    if not 1 <= margin <= 16:
        refuse("margin", "1 to 16", float(margin))
    if not ellipse[2:].min() > 0:
        refuse("ellipse", "semi-axes above 0", float(ellipse[2:].min()))
    longest = float(margin * ellipse[2:].max())
    if longest > 4096:
        refuse("ellipse", "semi-axes of at most 4096 pixels with the margin", longest)


def require_bins(bins: Bins, size: int) -> None:
    """Refuse a size outside 1 to 65535, and bins that are neither below it nor NO_BIN."""
    if not 1 <= size <= 65535:
        refuse("size", "1 to 65535 bins", size)
    strange = bins[(bins >= size) & (bins != NO_BIN)]
    if strange.size:
        refuse("bins", f"bins below {size}, or 65535 for none", int(strange.max()))


def mask_of(ellipse: Floats, shape: tuple[int, ...]) -> Mask:
    """(H, W): the pixels whose centers are inside the ellipse (x, y, minor, major).

    Computed relative to the pixel of the ellipse's center, so that shifts by whole pixels keep its shape.
    """
    x, y, minor, major = ellipse
    columns = np.arange(shape[1]) - np.floor(x)
    rows = np.arange(shape[0]) - np.floor(y)
    x, y = x - np.floor(x), y - np.floor(y)
    with np.errstate(over="ignore"):  # rows far from a very flat ellipse
        v = (rows + 0.5 - y) / major
        reach = minor * np.sqrt(np.maximum(1 - v * v, 0))
    first, last = np.ceil(x - reach - 0.5), np.floor(x + reach - 0.5)
    within = (rows >= np.ceil(y - major - 0.5)) & (rows <= np.floor(y + major - 0.5))
    return np.asarray(within[:, None] & (columns >= first[:, None]) & (columns <= last[:, None]))


def masks_of(ellipse: Floats, margin: float, shape: tuple[int, ...]) -> tuple[Mask, Mask]:
    """The pixels inside an ellipse, and those in the ring around it."""
    inside = mask_of(ellipse, shape)
    larger = ellipse * np.array([1, 1, margin, margin])
    return inside, mask_of(larger, shape) & ~inside


def count(bins: Bins, mask: Mask, size: int) -> NDArray[np.int64]:
    """(size,): the number of pixels under the mask in each bin."""
    found = bins[mask]
    return np.bincount(found[found != NO_BIN], minlength=size)
