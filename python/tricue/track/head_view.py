# SPDX-License-Identifier: MIT
"""What a stereo pair shows where the head is looked for, Moreno et al. 2002, section 3."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_params import StereoHeadParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
Ellipse = tuple[float, float, float, float]  # centre x, y, semi-axes minor (along x), major; pixels

LEVELS = np.arange(256.0)
NO_CHECK = -1  # of left against right


class Pair(NamedTuple):
    """A rectified pair, and how it is searched: every ``step``-th pixel is a place.

    colors: (h, w, 3) BGR of the places, as in the light of the first frame. grey: (H, W), left and right, and
    small: the same, ``step`` times smaller.
    """

    colors: Image
    grey: tuple[Image, Image]
    small: tuple[Image, Image]
    step: int

    @classmethod
    def of(cls, left: Image, right: Image, light: Floats | None, p: StereoHeadParams) -> "Pair":
        """From the images of a frame, BGR and BGR or grey, and the first frame's light."""
        step = max(1, round(left.shape[1] / p.resolution))
        grey = _grey(left), _grey(right)
        small = grey if step == 1 else (_smaller(grey[0], step), _smaller(grey[1], step))
        places = np.ascontiguousarray(left[step // 2 :: step, step // 2 :: step])
        return cls(places if light is None else _lit(places, light), grey, small, step)


def light_of(left: Image) -> Floats:
    """(3,) the mean blue, green and red of a picture: what falls on it, as far as what is in it stays."""
    return np.array(cv2.mean(left)[:3])


def _lit(image: Image, light: Floats) -> Image:
    """An image as it would be in another light: each channel by its own gain (von Kries)."""
    gains = light / np.maximum(light_of(image), 1.0)
    table = np.clip(LEVELS[:, None] * gains + 0.5, 0, 255).astype(np.uint8)
    return cv2.LUT(image, table[None]).astype(np.uint8, copy=False)


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
    bins = k.color_bins(pair.colors, (left, top, right, bottom), p.bins, p.chroma, 1)
    middle = disparity / step
    first, last = round(middle) - p.disparities[0], round(middle) + p.disparities[1]
    region = (left, top, right - left, bottom - top)
    found = k.sad_disparity(
        *pair.small, region, False, first, last, p.window, p.uniqueness, p.prefilter, NO_CHECK
    )
    coherent = np.abs(found - np.float32(middle)) <= np.float32(p.coherent)
    return View(left, top, bins, coherent.view(np.uint8))
