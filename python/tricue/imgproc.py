# SPDX-License-Identifier: MIT
"""Image processing by the OpenCV of the system that the core was built with, for scenes and cameras.

cv2's pixels differ between versions: its warps interpolate at multiples of 1/32 pixel before version 5, and
at any position since. With this module, rendered and rectified images don't depend on the installed cv2.

Images are uint8, float32 or float64, (H, W) or (H, W, C) with up to 4 channels; their pixels are packed, rows
may be padded. Results have the image's type and channels. ValueError or TypeError names what is wrong.
"""

from typing import Literal, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from tricue._core import _imgproc
from tricue.arrays import Singles

__all__ = [
    "bgr_to_gray",
    "bgr_to_lab",
    "box_blur",
    "copy_where",
    "dilate",
    "erode",
    "fill_polygon",
    "gaussian_blur",
    "lab_to_bgr",
    "remap",
    "resize",
    "shift",
    "warp_perspective",
]

Scalar = TypeVar("Scalar", bound=np.generic)
MAX_SIGMA = 1000  # pixels
MIDDLE = -1  # the anchor in the middle of a square


def resize(
    image: NDArray[Scalar], height: int, width: int, method: Literal["area", "linear", "cubic"]
) -> NDArray[Scalar]:
    """Scale an image. method: "area" gives means, for scaling down."""
    return cast("NDArray[Scalar]", _imgproc.resize(image, height, width, method))


def gaussian_blur(
    image: NDArray[Scalar], sigma: float, border: Literal["reflect", "replicate"] = "reflect"
) -> NDArray[Scalar]:
    """Blur by a Gaussian of ``sigma`` pixels, up to 1000: OpenCV's time and memory grow with its size, and at
    infinity it overflows. Beyond the border the image is mirrored or repeats its edge.
    """
    if not 0 < sigma <= MAX_SIGMA:
        raise ValueError(f"sigma: expected pixels above 0, {MAX_SIGMA} at most, got {sigma!r}")
    return cast("NDArray[Scalar]", _imgproc.gaussian_blur(image, sigma, border))


def box_blur(image: NDArray[Scalar], side: int) -> NDArray[Scalar]:
    """The mean of the square of ``side`` pixels around each pixel; beyond the border it is mirrored."""
    return cast("NDArray[Scalar]", _imgproc.box_blur(image, side))


def erode(image: NDArray[Scalar], side: int, anchor: int = MIDDLE) -> NDArray[Scalar]:
    """The minimum in a square of ``side`` pixels. anchor: the result's index in it, along both axes."""
    return cast("NDArray[Scalar]", _imgproc.erode(image, side, anchor))


def dilate(image: NDArray[Scalar], side: int, anchor: int = MIDDLE) -> NDArray[Scalar]:
    """The maximum in a square of ``side`` pixels. anchor: the result's index in it, along both axes."""
    return cast("NDArray[Scalar]", _imgproc.dilate(image, side, anchor))


def shift(
    image: NDArray[Scalar],
    x: float,
    y: float,
    height: int,
    width: int,
    method: Literal["linear", "nearest"] = "linear",
    border: Literal["constant", "replicate"] = "constant",
    value: float = 0.0,
) -> NDArray[Scalar]:
    """An image (height, width) in which the given one begins at x, y, which needn't be whole pixels.

    border: a constant value around it, or its edge repeated.
    """
    return cast("NDArray[Scalar]", _imgproc.shift(image, x, y, height, width, method, border, value))


def warp_perspective(
    image: NDArray[Scalar], matrix: NDArray[np.float64], height: int, width: int
) -> NDArray[Scalar]:
    """Warp an image by a homography (3, 3) from its pixels to the result's, linearly; 0 outside it."""
    return cast("NDArray[Scalar]", _imgproc.warp_perspective(image, matrix, height, width))


def remap(
    image: NDArray[Scalar],
    columns: Singles,
    rows: Singles,
    border: Literal["constant", "replicate", "wrap"] = "constant",
) -> NDArray[Scalar]:
    """The image at ``columns`` and ``rows`` (h, w), interpolated linearly. border: "constant" is 0."""
    return cast("NDArray[Scalar]", _imgproc.remap(image, columns, rows, border))


def copy_where(source: NDArray[Scalar], where: NDArray[np.bool_], target: NDArray[Scalar]) -> None:
    """Copy pixels into ``target`` where the mask (H, W) is true, in place, many times faster than NumPy."""
    _imgproc.copy_where(source, where, target)


def fill_polygon(points: NDArray[np.int32], height: int, width: int) -> Singles:
    """An image of 1 in a polygon (n, 2) of columns and rows, its outline included, and 0 outside."""
    return cast("Singles", _imgproc.fill_polygon(points, height, width))


def bgr_to_gray(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The gray levels (H, W) of a BGR image (H, W, 3)."""
    return cast("NDArray[np.uint8]", _imgproc.bgr_to_gray(image))


def bgr_to_lab(image: Singles) -> Singles:
    """CIE L*a*b* (H, W, 3), L* from 0 to 100, of BGR in [0, 1]."""
    return cast("Singles", _imgproc.bgr_to_lab(image))


def lab_to_bgr(image: Singles) -> Singles:
    """BGR (H, W, 3) in [0, 1] of CIE L*a*b*."""
    return cast("Singles", _imgproc.lab_to_bgr(image))
