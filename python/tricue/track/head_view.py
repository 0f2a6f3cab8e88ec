# SPDX-License-Identifier: MIT
"""What a stereo pair shows where the head is looked for, Moreno et al. 2002, section 3."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_params import StereoHeadParams

Image = NDArray[np.uint8]
Ellipse = tuple[float, float, float, float]  # centre x, y, semi-axes minor (along x), major; pixels

NO_CHECK = -1  # of left against right


class Pair(NamedTuple):
    """A rectified pair, and how it is searched: every ``step``-th pixel is a place.

    left: (H, W, 3) BGR. grey: (H, W), left and right. small: the same, ``step`` times smaller.
    """

    left: Image
    grey: tuple[Image, Image]
    small: tuple[Image, Image]
    step: int

    @classmethod
    def of(cls, left: Image, right: Image, p: StereoHeadParams) -> "Pair":
        """From the images of a frame."""
        step = max(1, round(left.shape[1] / p.resolution))
        grey = _grey(left), _grey(right)
        small = grey if step == 1 else (_smaller(grey[0], step), _smaller(grey[1], step))
        return cls(left, grey, small, step)


def _grey(image: Image) -> Image:
    return image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY).astype(np.uint8, copy=False)


def _smaller(grey: Image, step: int) -> Image:
    height, width = (size // step for size in grey.shape)
    whole = grey[: height * step, : width * step]
    return cv2.resize(whole, (width, height), interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)


class View(NamedTuple):
    """A region of the places: left and top of it, bins (h, w) of its colors, and where its depth is coherent
    with the head's (h, w).
    """

    left: int
    top: int
    bins: NDArray[np.uint16]
    coherent: Image


def look(k: Kernels, pair: Pair, ellipse: Ellipse, disparity: float, p: StereoHeadParams) -> View:
    """At all places that the search round an ellipse touches, for what is about at a disparity, pixels."""
    step, (across, down) = pair.step, p.search
    x, y, minor, major = (each / step for each in ellipse)
    left, top = math.floor(x - p.ring * minor) - across, math.floor(y - p.ring * major) - down
    right, bottom = math.ceil(x + p.ring * minor) + across, math.ceil(y + p.ring * major) + down
    pixels = (step * left, step * top, step * right, step * bottom)
    bins = k.color_bins(pair.left, pixels, p.bins, p.chroma, step)
    middle = disparity / step
    first, last = round(middle) - p.disparities[0], round(middle) + p.disparities[1]
    region = (left, top, right - left, bottom - top)
    found = k.sad_disparity(
        *pair.small, region, False, first, last, p.window, p.uniqueness, p.prefilter, NO_CHECK
    )
    coherent = np.abs(found - np.float32(middle)) <= np.float32(p.coherent)
    return View(left, top, bins, coherent.view(np.uint8))
