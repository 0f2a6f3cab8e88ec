# SPDX-License-Identifier: MIT
"""The bins of flows or disparities: shared by histograms and the look-up of densities."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

MAX_BINS = 65536


def value_bins(values: NDArray[np.float32], low: float, high: float, bins: int) -> NDArray[np.intp]:
    """floor((value - low) (bins / (high - low))) in float32, at most bins - 1.

    ``bins`` for NaN and for values outside [low, high), which is decided exactly.
    """
    exact = values.astype(np.float64)
    inside = (exact >= low) & (exact < high)
    with np.errstate(over="ignore", invalid="ignore"):  # if high and low are adjacent floats
        place = (values - np.float32(low)) * np.float32(np.divide(bins, high - low))
    return np.where(inside, np.where(place < bins - 1, place, bins - 1), bins).astype(np.intp)


def require_range(low: float, high: float, bins: int) -> None:
    """Refuse an invalid range of a histogram."""
    if not np.isfinite(low):
        refuse("low", "a finite number", float(low))
    if not (np.isfinite(high) and high > low):
        refuse("high", "a finite number above low", float(high))
    if not 1 <= bins <= MAX_BINS:
        refuse("bins", f"1 to {MAX_BINS}", bins)
