# SPDX-License-Identifier: MIT
"""A stereo pair prepared for the search: subsampled colors, their gains, gray and reduced images."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
Region = tuple[int, int, int, int]
Ellipse = tuple[float, float, float, float]  # center x, y, semi-axes minor (along x), major; pixels

NO_LEFT_RIGHT_CHECK = -1  # the tolerance by which sad_disparity doesn't compare left with right


class PreparedPair(NamedTuple):
    """A rectified stereo pair, reduced to cells of ``step`` x ``step`` pixels, in which the head is searched.

    colors: (h, w, 3) BGR of each cell's middle pixel.
    mean: (3,) of the colors, a measure of the light while the scene stays the same.
    gains: (3,) that turn colors into those of the first frame's light (von Kries); None: not compensated.
    gray: left and right, (H, W) each.
    reduced: left and right, (h, w) each, the mean gray level of each cell.
    """

    colors: Image
    mean: Floats
    gains: Floats | None
    gray: tuple[Image, Image]
    reduced: tuple[Image, Image]
    step: int

    @classmethod
    def of(
        cls, k: Kernels, left: Image, right: Image, first_mean: Floats | None, p: StereoHeadParams
    ) -> "PreparedPair":
        """Prepare the images of a frame, left BGR, right BGR or gray.

        first_mean: (3,) mean color of the first left image; None: the light isn't compensated.
        """
        height, width = left.shape[:2]
        step = max(1, min(round(width / p.resolution), height, width))
        gray = k.reduce_gray(left, 1), right if right.ndim == 2 else k.reduce_gray(right, 1)
        reduced = gray if step == 1 else (k.reduce_gray(gray[0], step), k.reduce_gray(gray[1], step))
        colors, mean = k.cell_colors(left, step)
        gains = None if first_mean is None else first_mean / np.maximum(mean, 1.0)
        return cls(colors, mean, gains, gray, reduced, step)

    def bins(self, k: Kernels, region: Region, stride: int, p: StereoHeadParams) -> NDArray[np.uint16]:
        """The ``color_bins`` of every stride-th cell of a region (x0, y0, x1, y1)."""
        height, width = self.colors.shape[:2]
        x0, y0, x1, y1 = region
        left, top = min(max(x0, 0), width), min(max(y0, 0), height)
        colors = self.colors[top : max(y1, top), left : max(x1, left)]
        shifted = (x0 - left, y0 - top, x1 - left, y1 - top)
        return k.color_bins(colors, shifted, p.bins, p.max_chroma, stride, self.gains)
