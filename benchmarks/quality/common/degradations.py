# SPDX-License-Identifier: MIT
"""Degradations of a recorded color sequence: a worse camera, a lower rate, or a worse first box."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray
from tricue.camera.box import Box

Image = NDArray[np.uint8]


def as_recorded(image: Image, number: int) -> Image:
    """The image, unchanged."""
    return image


def gray(image: Image, number: int) -> Image:
    """The image in gray."""
    return image if image.ndim == 2 else _image(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY))


def dark(image: Image, number: int) -> Image:
    """The image with a fifth of the light, and sensor noise of 3 levels."""
    return noisy(_clipped(image * np.float32(0.2)), number, 3)


def flickering(image: Image, number: int) -> Image:
    """Brightness that varies by ±35 %, with a period of 7 frames."""
    return _clipped(image * np.float32(1 + 0.35 * np.sin(0.9 * number)))


def tinted(image: Image, number: int) -> Image:
    """Channels that vary by ±30 %, out of phase, with a period of 314 frames."""
    if image.ndim == 2:
        return image
    gains = 1 + 0.3 * np.sin(0.02 * number + 2 * np.pi / 3 * np.arange(3))
    return _clipped(image * gains)


def noisy(image: Image, number: int, levels: float = 20) -> Image:
    """The image with normal noise; levels: its standard deviation, gray levels."""
    noise = np.random.default_rng(number).normal(0, levels, image.shape)
    return _clipped(image + noise)


def blurred(image: Image, number: int) -> Image:
    """The image out of focus: blurred by a Gaussian of 2.5 pixels."""
    return _image(cv2.GaussianBlur(image, (0, 0), 2.5))


def compressed(image: Image, number: int) -> Image:
    """The image compressed as JPEG, quality 12."""
    _, packed = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, 12])
    unpacked = cv2.imdecode(packed, cv2.IMREAD_UNCHANGED)
    assert unpacked is not None, "what was just packed"
    return _image(unpacked)


class Degradation(NamedTuple):
    """How a recording is changed.

    image: changes an image, given its number. scale: factor of the images' sides, at most 1. box: factor of
    the first box's sides, around its center. step: from one frame that is seen to the next.
    """

    image: Callable[[Image, int], Image] = as_recorded
    scale: float = 1.0
    box: float = 1.0
    step: int = 1

    def apply(self, image: Image, number: int) -> Image:
        """The image that the tracker gets."""
        shown = self.image(image, number)
        if self.scale == 1:
            return shown
        return _image(cv2.resize(shown, None, fx=self.scale, fy=self.scale, interpolation=cv2.INTER_AREA))


DEGRADATIONS: Mapping[str, Degradation] = {
    "as recorded": Degradation(),
    "gray": Degradation(gray),
    "dark": Degradation(dark),
    "flicker": Degradation(flickering),
    "tint": Degradation(tinted),
    "noise": Degradation(noisy),
    "blur": Degradation(blurred),
    "jpeg": Degradation(compressed),
    "half size": Degradation(scale=1 / 2),
    "third of the size": Degradation(scale=1 / 3),
    "loose box": Degradation(box=1.4),
    "tight box": Degradation(box=0.7),
    "every fifth frame": Degradation(step=5),
    "every eighth frame": Degradation(step=8),
}


def scale_box(box: Box, factor: float) -> Box:
    """The box with its sides multiplied by a factor, around the same center."""
    (x, y), (width, height) = box.center, (factor * box.width, factor * box.height)
    return Box(x - width / 2, y - height / 2, width, height)


def _clipped(values: ArrayLike) -> Image:
    return _image(np.clip(np.asarray(values, np.float32) + np.float32(0.5), 0, 255))


def _image(values: ArrayLike) -> Image:
    return np.ascontiguousarray(np.asarray(values).astype(np.uint8))
