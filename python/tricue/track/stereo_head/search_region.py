# SPDX-License-Identifier: MIT
"""The cells that the local search reads: their color bins, and whether they are at the head's depth."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse, PreparedPair

FILL_WINDOW = 7  # cells, side of the square that fills gaps in the disparity, as in textureless hair


class SearchRegion(NamedTuple):
    """A rectangle of cells, which may extend beyond the image.

    left, top: of its first cell. bins: (h, w) color bins. coherent: (h, w) 1 at the head's depth, else 0.
    """

    left: int
    top: int
    bins: NDArray[np.uint16]
    coherent: Image

    def to_cells(self, ellipse: Ellipse, step: int) -> NDArray[np.float64]:
        """The center and semi-axes (4,), in cells of the region, of an ellipse in image pixels."""
        x, y, minor, major = ellipse
        return np.array([x / step - self.left, y / step - self.top, minor / step, major / step])


def crop_region(
    k: Kernels, pair: PreparedPair, ellipse: Ellipse, disparity: float, p: StereoHeadParams
) -> SearchRegion:
    """The region that the search around an ellipse reads, for a head near a disparity, pixels."""
    step, (across, down) = pair.step, p.search
    x, y, minor, major = ellipse
    x, y, minor, major = x / step, y / step, minor / step, major / step
    left, top = math.floor(x - p.ring * minor) - across, math.floor(y - p.ring * major) - down
    right, bottom = math.ceil(x + p.ring * minor) + across, math.ceil(y + p.ring * major) + down
    expected = min(disparity / step, float(pair.left.shape[1] // step))
    below, above = p.disparities
    bins, coherent = k.head_cells(
        pair.left,
        pair.right,
        (left, top, right, bottom),
        step,
        p.color_space,
        pair.gains,
        (expected, p.disparity_tolerance, FILL_WINDOW),
        (round(expected) - below, round(expected) + above),
        p.matching,
    )
    return SearchRegion(left, top, bins, coherent)
