# SPDX-License-Identifier: MIT
"""Maxima and minima of a depth density (Sabeti, Parvizi, Wu 2008, equations (32)-(34))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse

Levels = NDArray[np.int64]


def density_extrema(density: Floats, prominence: float) -> tuple[Levels, Levels]:
    """Finds peaks and plateaus, and measures the prominence of each from the levels around it."""
    strange = density[~(np.isfinite(density) & (density >= 0))]
    if strange.size:
        refuse("density", "finite numbers, none negative", float(strange[0]))
    if not prominence >= 0:
        refuse("prominence", "a number of at least 0", float(prominence))
    padded = np.concatenate([[0.0], density, [0.0]])
    maxima = [peak - 1 for peak in _peaks(padded) if _prominence(padded, peak) >= prominence]  # (32)
    between = [slice(maxima[j] + 1, maxima[j + 1]) for j in range(len(maxima) - 1)]  # (34)
    minima = [range_.start + int(density[range_].argmin()) for range_ in between]  # (33)
    return np.array(maxima, np.int64), np.array(minima, np.int64)


def _peaks(padded: Floats) -> list[int]:
    """The middles of the stretches of equal density on both sides of which the density falls."""
    change = np.diff(padded)
    edges = np.flatnonzero(change) + 1
    rises = change[edges - 1] > 0
    tops = [k for k in range(len(edges) - 1) if rises[k] and not rises[k + 1]]
    return [int(edges[k] + edges[k + 1] - 1) // 2 for k in tops]


def _prominence(padded: Floats, peak: int) -> float:
    """How far the density falls before a higher level, or the end; on the side where it falls less."""
    left, right = padded[: peak + 1][::-1], padded[peak:]
    return float(padded[peak] - max(_least(left), _least(right)))


def _least(side: Floats) -> float:
    """The lowest density from the side's first level to the first that is higher."""
    higher = np.flatnonzero(side > side[0])
    return float(side[: higher[0] if higher.size else None].min())
