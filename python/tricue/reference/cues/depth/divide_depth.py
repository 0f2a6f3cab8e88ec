# SPDX-License-Identifier: MIT
"""The division masks of a depth image (Sabeti, Parvizi, Wu 2008, equations (35), (36))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import has_depth


def divide_depth(
    depth: NDArray[np.float32], mask: NDArray[np.uint8], dividers: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """Labels one division at a time."""
    require_shape("mask", mask, depth.shape)
    if not 2 <= dividers.size <= 256:
        refuse("dividers", "2 to 256 numbers", dividers.size)
    require_finite("dividers", dividers)
    descents = np.flatnonzero(np.diff(dividers) < 0)
    if descents.size:
        refuse("dividers", "ascending numbers", float(dividers[descents[0] + 1]))

    labels = np.zeros(depth.shape, np.uint8)
    z = depth.astype(np.float64)
    for label in range(1, dividers.size):
        division = (dividers[label - 1] <= z) & (z < dividers[label])  # (36)
        labels[division & has_depth(depth) & (mask != 0)] = label
    return labels
