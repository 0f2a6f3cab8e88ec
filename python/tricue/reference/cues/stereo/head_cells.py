# SPDX-License-Identifier: MIT
"""The cells of the search for a head: their colors and depths (Moreno et al. 2002, sections 3.1 and 3.2)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Image
from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.color_bins import color_bins
from tricue.reference.cues.color.detail.color_space import ColorSpace
from tricue.reference.cues.stereo.detail.cell_disparities import cell_disparities
from tricue.reference.cues.stereo.detail.coherent_cells import coherent_cells
from tricue.reference.cues.stereo.sad_disparity import Limits, Matching

MAX_CORNER = (2**31 - 1) // 2  # pixels


def head_cells(
    left: Image,
    right: Image,
    region: tuple[int, int, int, int],
    step: int,
    space: ColorSpace,
    gains: tuple[float, float, float] | None,
    depth: tuple[float, float, int],
    limits: Limits,
    matching: Matching,
) -> tuple[NDArray[np.uint16], NDArray[np.uint8]]:
    """Bins the colors of the cells' middle pixels, matches cells, and clears those outside the image."""
    found = cell_disparities(left, right, step, region, limits, matching)
    x0, y0, x1, y1 = region
    farthest = max(map(abs, region)) * step
    if farthest > MAX_CORNER:
        refuse("region", "corners within a billion pixels", farthest)
    pixels = (step * x0, step * y0, step * x1, step * y1)
    colors = color_bins(left, pixels, space, step, None if gains is None else np.array(gains))
    coherent = coherent_cells(found, *depth)
    rows, columns = np.arange(y0, y1), np.arange(x0, x1)
    coherent[(rows < 0) | (rows >= left.shape[0] // step)] = 0
    coherent[:, (columns < 0) | (columns >= left.shape[1] // step)] = 0
    return colors, coherent
