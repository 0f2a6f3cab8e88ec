# SPDX-License-Identifier: MIT
"""The colors inside an axis-aligned ellipse and around it: shared by the twins of the search for heads."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse
from tricue.reference.base.ellipse_shape import Mask, mask_of

NO_BIN = 65535
Bins = NDArray[np.uint16]


def require_bins(bins: Bins, size: int) -> None:
    """Refuse a size outside 1 to 65535, and bins that are neither below it nor NO_BIN."""
    if not 1 <= size <= 65535:
        refuse("size", "1 to 65535 bins", size)
    strange = bins[(bins >= size) & (bins != NO_BIN)]
    if strange.size:
        refuse("bins", f"bins below {size}, or 65535 for none", int(strange.max()))


def masks_of(ellipse: Floats, margin: float, shape: tuple[int, ...]) -> tuple[Mask, Mask]:
    """The pixels inside an ellipse, and those in the ring around it."""
    inside = mask_of(ellipse, shape)
    larger = ellipse * np.array([1, 1, margin, margin])
    return inside, mask_of(larger, shape) & ~inside


def count(bins: Bins, mask: Mask, size: int) -> NDArray[np.int64]:
    """(size,): the number of pixels under the mask in each bin."""
    found = bins[mask]
    return np.bincount(found[found != NO_BIN], minlength=size)
