# SPDX-License-Identifier: MIT
"""The disparities of a stereo pair's cells: shared by the twins of the search for heads."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Image
from tricue.reference.base.checks import refuse
from tricue.reference.camera.reduce_gray import reduce_gray
from tricue.reference.cues.stereo.sad_disparity import Limits, Matching, Rectangle, sad_disparity


def cell_disparities(
    left: Image, right: Image, step: int, region: Rectangle, limits: Limits, matching: Matching
) -> NDArray[np.float32]:
    """The disparities in a region, in cells, from both whole images reduced to gray cells."""
    if left.shape[0] < 1 or left.shape[1] < 1:
        refuse("left", "at least one pixel", "none")
    if left.shape[:2] != right.shape[:2]:
        refuse("right", f"the left image's shape {left.shape[:2]}", right.shape[:2])
    cells = reduce_gray(left, step), reduce_gray(right, step)
    return sad_disparity(*cells, region, False, limits, matching)
