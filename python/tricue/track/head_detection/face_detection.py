# SPDX-License-Identifier: MIT
"""Detection of a frontal face to start on, by a cascade of classifiers (Viola and Jones 2001).

It is cv2's, with Haar features, or scikit-image's if cv2 has none, as in 5.x.
"""

import threading
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import cv2

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.track.head_detection import face_cascade

# Size of the head relative to the detected square, as in hand-drawn boxes of faces.
HEAD_WIDTH_RATIO, HEAD_HEIGHT_RATIO = 0.75, 0.95
MIN_SIDE, MIN_SHARE = 20, 10  # of the smallest face: pixels, and the image's shorter side over the face's
FACES_NEED = (
    f"can't detect faces, because cv2 {cv2.__version__} has no cascade and scikit-image is missing; "
    'pip install "tricue[face]" or "opencv-python-headless<5"'
)
_ONE_AT_A_TIME = threading.Lock()  # cv2's cascade stores its image and releases the GIL


def find_face(image: Image) -> Box | None:
    """The largest frontal face in a BGR or gray image, or None.

    ImportError if cv2 has no cascade, as in 5.x, and scikit-image isn't installed.
    """
    smallest = max(MIN_SIDE, min(image.shape[:2]) // MIN_SHARE)
    classifier = _load_cascade()
    if classifier is None:
        if not _has_scikit_image():
            raise ImportError(f"box: {FACES_NEED}, or give a box (--box x,y,width,height)")
        square = face_cascade.find_square(image, smallest)
    else:
        square = _find_square(classifier, image, smallest)
    return None if square is None else _crop_to_head(square)


def can_find_faces() -> bool:
    """Whether cv2 has a cascade or scikit-image is installed."""
    return _load_cascade() is not None or _has_scikit_image()


def _find_square(classifier: Any, image: Image, smallest: int) -> Box | None:
    """The square of the largest face, by cv2's cascade of Haar features."""
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    size = (smallest, smallest)
    with _ONE_AT_A_TIME:
        found = classifier.detectMultiScale(gray, scaleFactor=1.1, minNeighbors=5, minSize=size)
    squares = [Box(*map(float, square)) for square in found]
    return max(squares, key=lambda square: square.area, default=None)


def _crop_to_head(square: Box) -> Box:
    """The box of the head's upright ellipse, without the background on both sides of the detected square."""
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
