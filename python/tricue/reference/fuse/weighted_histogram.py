# SPDX-License-Identifier: MIT
"""Histogram of flow or disparity, weighted by its reliability (Okada, Shirai, Miura 1996, section 4.2)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.fuse.detail.rectangle_pixels import Rectangle, rectangle_pixels
from tricue.reference.fuse.detail.value_bins import require_range, value_bins

Plane = NDArray[np.float32]


def weighted_histogram(
    values: Plane,
    weights: Plane,
    region: Rectangle,
    low: float,
    high: float,
    bins: int,
    mask: NDArray[np.uint8] | None = None,
) -> NDArray[np.float64]:
    """(bins,): the sum of the weights of the values in each bin of [low, high), over the pixels of a region
    (x0, y0, x1, y1) whose mask isn't 0.

    NaN, and what is outside the range, isn't counted; nor is a weight that isn't above 0 and finite.
    """
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
