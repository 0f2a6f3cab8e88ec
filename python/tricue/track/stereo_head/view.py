# SPDX-License-Identifier: MIT
"""What a stereo pair shows where the head is looked for, Moreno et al. 2002, section 3."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
Region = tuple[int, int, int, int]
Ellipse = tuple[float, float, float, float]  # centre x, y, semi-axes minor (along x), major; pixels

NO_CHECK = -1  # of left against right
AROUND = 7  # places, side of the square by which gaps in the disparity are filled


class Pair(NamedTuple):
    """A rectified pair, and how it is searched: every ``step``-th pixel is a place.

    colors: (h, w, 3) BGR of the places. gains: (3,) that make them what they were in the first frame's light
    (von Kries), if any. grey: (H, W), left and right, and small: the same, ``step`` times smaller.
    """

    colors: Image
    gains: Floats | None
    grey: tuple[Image, Image]
    small: tuple[Image, Image]
    step: int

    @classmethod
    def of(cls, left: Image, right: Image, light: Floats | None, p: StereoHeadParams) -> "Pair":
        """From the images of a frame, BGR and BGR or grey, and the first frame's light."""
        height, width = left.shape[:2]
        step = max(1, min(round(width / p.resolution), height, width))
        grey = _grey(left), _grey(right)
        small = grey if step == 1 else (_smaller(grey[0], step), _smaller(grey[1], step))
        places = np.ascontiguousarray(left[step // 2 :: step, step // 2 :: step])
        gains = None if light is None else light / np.maximum(light_of(places), 1.0)
        return cls(places, gains, grey, small, step)

    def bins(self, k: Kernels, region: Region, step: int, p: StereoHeadParams) -> NDArray[np.uint16]:
        """Of every step-th place of a region (x0, y0, x1, y1), as color_bins gives them."""
        height, width = self.colors.shape[:2]
        x0, y0, x1, y1 = region
        left, top = min(max(x0, 0), width), min(max(y0, 0), height)
        seen = self.colors[top : max(y1, top), left : max(x1, left)]
        if self.gains is not None and seen.size:
            seen = cv2.transform(seen, np.diag(self.gains)).astype(np.uint8, copy=False)
        return k.color_bins(seen, (x0 - left, y0 - top, x1 - left, y1 - top), p.bins, p.chroma, step)


def _coherent(found: NDArray[np.float32], middle: float, reach: float) -> Image:
    """Where disparities are about the middle one; where none was found, as in hair of one color, what most of
    those round it are.
    """
    off = np.abs(found - np.float32(middle))
    near, beyond = off <= np.float32(reach), off > np.float32(reach)  # neither, where none was found
    votes = (near.view(np.int8) - beyond.view(np.int8)).astype(np.int16)
    around = cv2.boxFilter(votes, -1, (AROUND, AROUND), normalize=False, borderType=cv2.BORDER_CONSTANT)
    return np.asarray(near | ((around > 0) > beyond)).view(np.uint8)


def light_of(left: Image) -> Floats:
    """(3,) the mean blue, green and red of a picture: what falls on it, as far as what is in it stays."""
    return np.array(cv2.mean(left)[:3])


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
    region = (left, top, right, bottom)
    bins = pair.bins(k, region, 1, p)
    middle = min(disparity / step, float(pair.small[0].shape[1]))
    first, last = round(middle) - p.disparities[0], round(middle) + p.disparities[1]
    found = k.sad_disparity(
        *pair.small, region, False, first, last, p.window, p.uniqueness, p.prefilter, NO_CHECK
    )
    coherent = _coherent(found, middle, p.coherent)
    height, width = pair.small[0].shape  # there is no head beyond them
    coherent[: max(-top, 0)] = coherent[max(height - top, 0) :] = 0
    coherent[:, : max(-left, 0)] = coherent[:, max(width - left, 0) :] = 0
    return View(left, top, bins, coherent)
