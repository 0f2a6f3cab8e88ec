# SPDX-License-Identifier: MIT
"""A stereo pair prepared for the search: subsampled colors, their gains, gray and reduced images."""

from typing import NamedTuple

import cv2
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
    gains: (3,) that turn colors into those of the first frame's light (von Kries); None: not compensated.
    gray: left and right, (H, W) each.
    reduced: left and right, (h, w) each, the mean gray level of each cell.
    """

    colors: Image
    gains: Floats | None
    gray: tuple[Image, Image]
    reduced: tuple[Image, Image]
    step: int

    @classmethod
    def of(cls, left: Image, right: Image, first_mean: Floats | None, p: StereoHeadParams) -> "PreparedPair":
        """Prepare the images of a frame, left BGR, right BGR or gray.

        first_mean: (3,) mean color of the first left image; None: the light isn't compensated.
        """
        height, width = left.shape[:2]
        step = max(1, min(round(width / p.resolution), height, width))
        gray = _to_gray(left), _to_gray(right)
        reduced = gray if step == 1 else (_reduce(gray[0], step), _reduce(gray[1], step))
        colors = np.ascontiguousarray(left[step // 2 :: step, step // 2 :: step])
        gains = None if first_mean is None else first_mean / np.maximum(mean_color(colors), 1.0)
        return cls(colors, gains, gray, reduced, step)

    def bins(self, k: Kernels, region: Region, stride: int, p: StereoHeadParams) -> NDArray[np.uint16]:
        """The ``color_bins`` of every stride-th cell of a region (x0, y0, x1, y1)."""
        height, width = self.colors.shape[:2]
        x0, y0, x1, y1 = region
        left, top = min(max(x0, 0), width), min(max(y0, 0), height)
        colors = self.colors[top : max(y1, top), left : max(x1, left)]
        if self.gains is not None and colors.size:
            colors = cv2.transform(colors, np.diag(self.gains)).astype(np.uint8, copy=False)
        shifted = (x0 - left, y0 - top, x1 - left, y1 - top)
        return k.color_bins(colors, shifted, p.bins, p.max_chroma, stride)


def mean_color(image: Image) -> Floats:
    """(3,) mean blue, green and red of an image: a measure of the light while the scene stays the same."""
    return np.array(cv2.mean(image)[:3])


def _to_gray(image: Image) -> Image:
    return image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY).astype(np.uint8, copy=False)


def _reduce(gray: Image, step: int) -> Image:
    height, width = (size // step for size in gray.shape)
    whole = gray[: height * step, : width * step]
    return cv2.resize(whole, (width, height), interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)
