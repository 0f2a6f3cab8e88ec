# SPDX-License-Identifier: MIT
"""A stereo pair prepared for the search: its light, and its color bins and disparities on demand."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams

Region = tuple[int, int, int, int]
Ellipse = tuple[float, float, float, float]  # center x, y, semi-axes minor (along x), major; pixels

Color = tuple[float, float, float]  # blue, green, red
Limits = tuple[int, int]  # lowest and highest disparity, inclusive
Disparities = NDArray[np.float32]

LIGHT_ROWS = 60  # about so many rows of an image tell its light
DARKEST = 1.0  # lowest mean level of a channel that is fully compensated
# The largest matching windows, pixels, whose costs fit 16 bits: gray levels differ by up to 255, the
# prefilter's slopes by at most 31 each.
MAX_WINDOW_GRAY, MAX_WINDOW_PREFILTERED = 15, 31


class PreparedPair(NamedTuple):
    """A rectified stereo pair; the head is searched in cells of ``step`` x ``step`` pixels.

    left, right: left BGR (H, W, 3), right the same, or gray (H, W) where the frame is.
    mean: color of some of the left image's rows, a measure of the light while the scene stays the same.
    gains: those that turn colors into those of the first frame's light (von Kries); None: not compensated.
    """

    left: Image
    right: Image
    mean: Color
    gains: Color | None
    step: int

    @classmethod
    def of(
        cls,
        k: Kernels,
        left: Image,
        right: Image,
        head_width: float,
        first_mean: Color | None,
        p: StereoHeadParams,
    ) -> "PreparedPair":
        """Prepare the images of a frame, left BGR, right as it is.

        head_width: pixels, about. first_mean: mean color of the first left image; None to not compensate the
        light.
        """
        step = cell_side(left.shape, head_width, p)
        every = max(1, len(left) // LIGHT_ROWS)
        b, g, r = k.image_mean(left[every // 2 :: every]).tolist()
        gains = None
        if first_mean is not None:
            first_b, first_g, first_r = first_mean
            gains = first_b / max(b, DARKEST), first_g / max(g, DARKEST), first_r / max(r, DARKEST)
        return cls(left, right, (b, g, r), gains, step)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells."""
        height, width = self.left.shape[:2]
        return height // self.step, width // self.step

    def bins(self, k: Kernels, region: Region, stride: int, p: StereoHeadParams) -> NDArray[np.uint16]:
        """The ``color_bins`` of every stride-th cell of a region (x0, y0, x1, y1)."""
        x0, y0, x1, y1 = region
        step = self.step
        pixels = (step * x0, step * y0, step * x1, step * y1)
        gains = None if self.gains is None else np.array(self.gains)
        return k.color_bins(self.left, pixels, p.color_space, step * stride, gains)

    def disparities(
        self, k: Kernels, region: Region, limits: Limits, p: StereoHeadParams, *, ellipse: bool, cells: bool
    ) -> Disparities:
        """The ``sad_disparity`` in a region of cells, or of pixels, or in the ellipse inscribed in it."""
        side, matching = (self.step, p.matching) if cells else (1, self.pixel_matching(p))
        left, right = k.reduce_gray(self.left, side), k.reduce_gray(self.right, side)
        return k.sad_disparity(left, right, region, ellipse, limits, matching)

    def pixel_matching(self, p: StereoHeadParams) -> tuple[int, int, bool]:
        """How pixels are matched, not cells, as kernels take it."""
        return self.pixel_window(p), p.uniqueness, p.prefilter

    def pixel_window(self, p: StereoHeadParams) -> int:
        """The side of the matching window, pixels."""
        widest = MAX_WINDOW_PREFILTERED if p.prefilter else MAX_WINDOW_GRAY
        return min(p.window + 2 * (self.step - 1), widest)


def cell_side(shape: tuple[int, ...], head_width: float, p: StereoHeadParams) -> int:
    """The side of a cell, pixels, for images of this shape and a head about so many pixels wide."""
    height, width = shape[:2]
    side = max(1, min(round(width / p.resolution), height, width))
    if side == 1 or head_width >= side * p.min_head_cells:
        return side
    return max(1, int(head_width / p.min_head_cells))
