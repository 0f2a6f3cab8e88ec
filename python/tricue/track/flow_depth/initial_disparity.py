# SPDX-License-Identifier: MIT
"""The disparity of a region when none is expected yet: the one that most of its cells share."""

import numpy as np

from tricue.arrays import Plane
from tricue.kernels import Kernels
from tricue.track.base.shared_disparity import most_shared
from tricue.track.base.stereo_matching import StereoMatching
from tricue.track.flow_depth.rectangles import Region
from tricue.track.flow_depth.reduced_frame import ReducedFrame

MIN_DISPARITY_CELLS = 12  # of the region, that must have a disparity
MIN_SHARED_PART = 0.25  # of these, that must share one
SHARED_TOLERANCE = 1.0  # cells, the largest difference between shared disparities
MAX_DISPARITY_SHARE = 0.3  # of the columns, for parallel cameras; negative ones up to an eighth of that
MATCHING = StereoMatching(window=7, uniqueness=10)


def find_initial_disparity(k: Kernels, frame: ReducedFrame, region: Region) -> float | None:
    """The disparity that most of a region shares, cells.

    None if too few cells have a disparity, if too few share one, and for an empty region.
    """
    x0, y0, x1, y1 = region
    if x0 >= x1 or y0 >= y1:
        return None
    disparities = _match(k, frame, region)
    disparities = disparities[np.isfinite(disparities)]
    if disparities.size < MIN_DISPARITY_CELLS:
        return None
    best = most_shared(disparities, SHARED_TOLERANCE)
    if np.count_nonzero(best) < MIN_SHARED_PART * disparities.size:
        return None
    return float(np.median(disparities[best]))


def _match(k: Kernels, frame: ReducedFrame, region: Region) -> Plane:
    """The disparities (h, w) of a region, by block matching or from the depth image; NaN where missing."""
    if frame.disparity is not None:
        x0, y0, x1, y1 = region
        return frame.disparity[y0:y1, x0:x1]
    assert frame.right is not None
    highest = max(int(MAX_DISPARITY_SHARE * frame.gray.shape[1]), 1)
    limits = -highest // 8 - round(frame.offset), highest - round(frame.offset)
    return k.sad_disparity(frame.gray, frame.right, region, False, limits, MATCHING)
