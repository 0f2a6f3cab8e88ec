# SPDX-License-Identifier: MIT
"""Detection of a frontal face to start on, by the best detector that is installed.

Cascades of classifiers (Viola and Jones 2001) come with cv2 4, with Haar features, and with scikit-image.
Comparison with rendered faces needs neither.
"""

import threading
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import cv2

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.track.head_detection import face_cascade, rendered_face

Detector = Callable[[Image, int], Box | None]  # of the largest face; int: side of the smallest, pixels

# Size of the head relative to a cascade's square, as in hand-drawn boxes of faces.
HEAD_WIDTH_RATIO, HEAD_HEIGHT_RATIO = 0.75, 0.95
MIN_SIDE, MIN_SHARE = 20, 10  # of the smallest face: pixels, and the image's shorter side over the face's
_ONE_AT_A_TIME = threading.Lock()  # cv2's cascade stores its image and releases the GIL


def find_face(image: Image, detector: str | None = None) -> Box | None:
    """The largest frontal face in a BGR or gray image, or None.

    detector: one of :func:`detectors`, by default the first.
    """
    installed = detectors()
    find = installed[detector or next(iter(installed))]
    return find(image, max(MIN_SIDE, min(image.shape[:2]) // MIN_SHARE))


def detectors() -> dict[str, Detector]:
    """The installed detectors by name, the best first."""
    found: dict[str, Detector] = {}
    if _load_cascade() is not None:
        found["cv2"] = _find_by_cv2
    if _has_scikit_image():
        found["scikit-image"] = _find_by_scikit_image
    return found | {"rendered faces": rendered_face.find_largest}


def _find_by_cv2(image: Image, smallest: int) -> Box | None:
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    size = (smallest, smallest)
    with _ONE_AT_A_TIME:
        found = _load_cascade().detectMultiScale(gray, scaleFactor=1.1, minNeighbors=5, minSize=size)
    squares = [Box(*map(float, square)) for square in found]
    return _crop_to_head(max(squares, key=lambda square: square.area, default=None))


def _find_by_scikit_image(image: Image, smallest: int) -> Box | None:
    return _crop_to_head(face_cascade.find_square(image, smallest))


def _crop_to_head(square: Box | None) -> Box | None:
    """The box of the head's upright ellipse, without the background on both sides of the detected square."""
    if square is None:
        return None
    x, y, half, _ = square.ellipse
    return Box.from_ellipse(x, y, HEAD_WIDTH_RATIO * half, HEAD_HEIGHT_RATIO * half)


@cache
def _load_cascade() -> Any:  # missing in cv2 5's types
    """cv2's cascade; None if it has none."""
    folder = getattr(getattr(cv2, "data", None), "haarcascades", None)
    classifier = getattr(cv2, "CascadeClassifier", None)
    file = Path(folder or "", "haarcascade_frontalface_default.xml")
    return None if folder is None or classifier is None or not file.is_file() else classifier(str(file))


@cache
def _has_scikit_image() -> bool:
    try:
        return find_spec("skimage") is not None
    except ValueError:  # sys.modules holds None in its place
        return False
