# SPDX-License-Identifier: MIT
"""A face to start on, found by OpenCV's cascade (Viola and Jones 2001)."""

from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box

WIDTH, HEIGHT = 0.75, 0.95  # of the square: the head that is in it, as hand-drawn boxes of faces have it


def find_face(image: NDArray[np.uint8]) -> Box | None:
    """The largest frontal face in a BGR or gray image, or None; ImportError where cv2 has none, as 5.x."""
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    smallest = max(20, min(gray.shape) // 10)
    found = _cascade().detectMultiScale(gray, scaleFactor=1.1, minNeighbors=5, minSize=(smallest, smallest))
    squares = [Box(*map(float, square)) for square in found]
    largest = max(squares, key=lambda square: square.area, default=None)
    return None if largest is None else _narrowed(largest)


def _narrowed(square: Box) -> Box:
    """The head's upright oval, without the background at both sides that the cascade's square holds."""
    x, y, half, _ = square.ellipse
    return Box.from_ellipse(x, y, WIDTH * half, HEIGHT * half)


@cache
def _cascade() -> Any:  # cv2 5's types don't know it
    folder = getattr(getattr(cv2, "data", None), "haarcascades", None)
    classifier = getattr(cv2, "CascadeClassifier", None)
    file = Path(folder or "", "haarcascade_frontalface_default.xml")
    if folder is None or classifier is None or not file.is_file():
        raise ImportError(
            f"box: a face can't be looked for, as cv2 {cv2.__version__} has no cascade; "
            "give a box (--box x,y,width,height), or pip install 'opencv-python-headless<5'"
        )
    return classifier(str(file))
