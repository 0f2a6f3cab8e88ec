# SPDX-License-Identifier: MIT
"""A color histogram shifted to a given mean (Moreno et al. 2002, section 4)."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import require_finite, require_shape
from tricue.reference.cues.color.detail.color_space import ColorSpace, axes, mean_color, require_histogram


def shift_histogram(histogram: Floats, space: ColorSpace, mean: Floats) -> Floats:
    """Distributes the mass of one bin at a time over the eight bins that it is shifted between."""
    require_histogram(histogram, *space)
    require_shape("mean", mean, (3,))
    require_finite("mean", mean)

    bins, _ = space
    widths = np.array([levels / n for n, _, levels in axes(*space)])
    last = np.array(bins) - 1
    offset = (mean - mean_color(histogram, *space)) / widths
    whole = np.floor(np.clip(offset, -2 * last - 2, 2 * last + 2))
    rest = np.clip(offset, -2 * last - 2, 2 * last + 2) - whole
    shifted = np.zeros(bins)
    for place in np.argwhere(histogram.reshape(bins)):
        for corner in np.ndindex(2, 2, 2):
            share = np.prod(np.where(corner, rest, 1 - rest))
            target = np.clip(place + whole + corner, 0, last).astype(int)
            shifted[tuple(target)] += share * histogram.reshape(bins)[tuple(place)]
    return shifted.ravel()
