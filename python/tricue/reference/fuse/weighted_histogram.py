# SPDX-License-Identifier: MIT
"""Histogram of flow or disparity, weighted by its reliability (Okada, Shirai, Miura 1996, section 4.2)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse
from tricue.reference.fuse.detail.rectangle_pixels import Rectangle, rectangle_pixels
from tricue.reference.fuse.detail.value_bins import require_range, value_bins


def weighted_histogram(
    values: Plane,
    weights: Plane,
    region: Rectangle,
    low: float,
    high: float,
    bins: int,
    mask: NDArray[np.uint8] | None = None,
) -> NDArray[np.float64]:
    """Sums the weights of each bin with bincount."""
    for name, plane in (("weights", weights), ("mask", mask)):
        if plane is not None and plane.shape != values.shape:
            refuse(name, f"shape {values.shape}", plane.shape)
    require_range(low, high, bins)
    inside = rectangle_pixels(region, values.shape, "region")
    weight = weights[inside]
    counts = (weight > 0) & (weight < np.inf)
    if mask is not None:
        counts &= mask[inside] != 0
    places = value_bins(values[inside], low, high, bins)[counts]
    return np.bincount(places, weight[counts], bins + 1)[:bins].astype(np.float64)
