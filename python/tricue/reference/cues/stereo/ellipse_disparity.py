# SPDX-License-Identifier: MIT
"""The disparity of an ellipse (Moreno et al. 2002, section 3.2, equation (5))."""

import math

import numpy as np

from tricue.reference.base.arrays import Image
from tricue.reference.base.checks import refuse
from tricue.reference.cues.stereo.detail.cell_disparities import cell_disparities


def ellipse_disparity(
    left: Image,
    right: Image,
    region: tuple[int, int, int, int],
    first: int,
    last: int,
    window: int,
    uniqueness: int,
    prefilter: bool,
    subpixel: bool,
    median: bool,
    tolerance: float,
) -> tuple[float, int, int]:
    """Computes the median or the mean of all disparities found, and counts those near it."""
    if not tolerance >= 0:
        refuse("tolerance", "0 or more", float(tolerance))
    found = cell_disparities(left, right, 1, region, True, first, last, window, uniqueness, prefilter)
    matched = found[np.isfinite(found)]
    if matched.size == 0:
        return math.nan, 0, 0
    if not subpixel:
        matched = np.ceil(matched - np.float32(0.5)) + np.float32(0)  # not -0
    middle = (
        np.median(matched) if median else np.float32(matched.sum(dtype=np.float64)) / np.float32(len(matched))
    )
    near = np.abs(matched - np.float32(middle)) <= np.float32(tolerance)
    return float(middle), len(matched), int(np.count_nonzero(near))
