# SPDX-License-Identifier: MIT
"""Photographs for scenes, from the scikit-image wheel, so that nothing is downloaded."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from tricue import imgproc
from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.doctor.install import install_extra

# Cluttered photographs; wood, fur, retina and stained tissue have colors close to skin.
BACKGROUNDS = ("coffee", "cat", "motorcycle", "retina", "immunohistochemistry")

# In the photograph "astronaut", 512x512: the face from hairline to chin, and the head with hair.
ASTRONAUT_FACE = Box(176, 60, 98, 123)
ASTRONAUT_HEAD = Box(152, 12, 152, 176)


def load_photograph(name: str) -> Image:
    """One of scikit-image's photographs as BGR (H, W, 3), read-only because it is cached.

    Without scikit-image, ImportError says what to install.
    """
    try:
        import skimage  # noqa: F401
    except ImportError:
        message = f"scenes: expected scikit-image to be installed: {install_extra('demo')}"
        raise ImportError(message) from None
    return _decode(name)


@cache
def _decode(name: str) -> Image:
    from skimage import data

    load: Callable[[], Any] = getattr(data, "stereo_motorcycle" if name == "motorcycle" else name)
    picture = load()[0] if name == "motorcycle" else load()
    flipped = np.ascontiguousarray(picture[..., ::-1])
    flipped.setflags(write=False)
    return flipped


def crop_background(name: str, height: int, width: int, rng: np.random.Generator) -> Image:
    """A random window of one of BACKGROUNDS, scaled to (height, width).

    It has between two thirds and all of the largest possible size. ValueError for another name.
    """
    if name not in BACKGROUNDS:
        raise ValueError(f"background: expected one of {', '.join(BACKGROUNDS)}, got {name!r}")
    picture = load_photograph(name)
    available = np.array(picture.shape[:2])
    window = np.array([height, width]) * (available / [height, width]).min() * rng.uniform(2 / 3, 1)
    top, left = (rng.random(2) * (available - window)).astype(int)
    rows, columns = window.astype(int)
    return resize(picture[top : top + rows, left : left + columns], height, width)


def crop(picture: Image, box: Box) -> Image:
    """The part of an image in a box of whole pixels."""
    x, y, width, height = box.as_int()
    return picture[y : y + height, x : x + width]


def resize(picture: Image, height: int, width: int) -> Image:
    """Scale an image down without aliasing, to (height, width)."""
    return imgproc.resize(picture, height, width, "area")
