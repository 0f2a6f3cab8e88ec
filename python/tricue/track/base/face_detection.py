# SPDX-License-Identifier: MIT
"""Detection of a face to start on, by OpenCV's cascade classifier (Viola and Jones 2001)."""

from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box

# Size of the head relative to the detected square, as in hand-drawn boxes of faces.
HEAD_WIDTH_RATIO, HEAD_HEIGHT_RATIO = 0.75, 0.95


def find_face(image: NDArray[np.uint8]) -> Box | None:
    """The largest frontal face in a BGR or gray image, or None. ImportError if cv2 has no cascade, as 5.x."""
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    smallest = max(20, min(gray.shape) // 10)
    found = _load_cascade().detectMultiScale(
        gray, scaleFactor=1.1, minNeighbors=5, minSize=(smallest, smallest)
    )
    squares = [Box(*map(float, square)) for square in found]
    largest = max(squares, key=lambda square: square.area, default=None)
    return None if largest is None else _crop_to_head(largest)


def _crop_to_head(square: Box) -> Box:
    """The box of the head's upright ellipse, without the background on both sides of the detected square."""
    x, y, half, _ = square.ellipse
    return Box.from_ellipse(x, y, HEAD_WIDTH_RATIO * half, HEAD_HEIGHT_RATIO * half)


@cache
def _load_cascade() -> Any:  # cv2 5's types don't know it
    folder = getattr(getattr(cv2, "data", None), "haarcascades", None)
    classifier = getattr(cv2, "CascadeClassifier", None)
    file = Path(folder or "", "haarcascade_frontalface_default.xml")
    if folder is None or classifier is None or not file.is_file():
        raise ImportError(
            f"box: can't detect faces, because cv2 {cv2.__version__} has no cascade; "
            "give a box (--box x,y,width,height), or pip install 'opencv-python-headless<5'"
        )
    return classifier(str(file))
