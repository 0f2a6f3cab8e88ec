# SPDX-License-Identifier: MIT
"""The disparity of an ellipse (Moreno et al. 2002, section 3.2, equation (5))."""

import math

import numpy as np

from tricue.reference.base.arrays import Floats, Image
from tricue.reference.base.checks import refuse
from tricue.reference.base.ellipse_shape import mask_of, require_ellipse
from tricue.reference.cues.stereo.detail.cell_disparities import cell_disparities
from tricue.reference.cues.stereo.sad_disparity import Limits, Matching

FARTHEST = 2**30  # pixels, beyond any image


def ellipse_disparity(
    left: Image,
    right: Image,
    ellipse: Floats,
    limits: Limits,
    matching: Matching,
    statistic: tuple[bool, bool, float],
) -> tuple[float, int, int]:
    """Matches the rectangle around the ellipse, then computes the median or the mean inside."""
    subpixel, median, tolerance = statistic
    if not tolerance >= 0:
        refuse("tolerance", "0 or more", float(tolerance))
    require_ellipse(ellipse)
    ellipse = np.append(np.clip(ellipse[:2], -FARTHEST, FARTHEST), ellipse[2:])
    x0, y0 = np.floor(ellipse[:2] - ellipse[2:]).astype(int).tolist()
    x1, y1 = np.ceil(ellipse[:2] + ellipse[2:]).astype(int).tolist()
    inside = mask_of(ellipse, (y1 - y0, x1 - x0), (x0, y0))
    if not inside.any():
        return math.nan, 0, 0
    found = cell_disparities(left, right, 1, (x0, y0, x1, y1), limits, matching)
    matched = found[inside & np.isfinite(found)]
    if matched.size == 0:
        return math.nan, 0, 0
    if not subpixel:
        matched = np.ceil(matched - np.float32(0.5)) + np.float32(0)  # not -0
    middle = (
        np.median(matched) if median else np.float32(matched.sum(dtype=np.float64)) / np.float32(len(matched))
    )
    near = np.abs(matched - np.float32(middle)) <= np.float32(tolerance)
    return float(middle), len(matched), int(np.count_nonzero(near))
