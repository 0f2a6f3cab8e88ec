# SPDX-License-Identifier: MIT
"""Baselines of face detection: cascades of classifiers (Viola and Jones 2001), which other packages have.

cv2 4 has one of Haar features, scikit-image one of local binary patterns (Liao et al. 2007). cv2 groups the
windows that pass; those that pass scikit-image's, the hits, are grouped here. A face has many hits, at
neighboring positions and sizes, and, since it is symmetric, also in the mirrored image. In a color image it
must have the color of skin.
"""

from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.doctor.install import install_extra
from tricue.track.head_detection.face_detection import MIN_SHARE, MIN_SIDE

Squares = NDArray[np.float64]  # (N, 3): center x, y and side, pixels

WINDOW = 24  # pixels, of the cascade
SCALE_STEP = 1.1  # from one size of faces to the next
SIMILAR = 0.2  # of the smaller square's side: largest difference between the edges of one face's hits
MIN_HITS, MIN_HITS_GRAY = 11, 14  # in the image and its mirror image; a gray image has no color to check
MIN_GREEN_DEFICIT, MIN_BLUE_DEFICIT = 0.10, 0.15  # of skin, as shares of red: 83 of 84 pictures of skin
MAX_GRAY_RANGE = 4.0  # levels, mean difference of a pixel's channels; compressed gray video isn't quite gray
SQUARE_SCALE = 1.09  # side of the square of cv2's cascade on a face, relative to scikit-image's
# Size of the head relative to cv2's square, as in hand-drawn boxes of faces.
HEAD_WIDTH_RATIO, HEAD_HEIGHT_RATIO = 0.75, 0.95


def missing(package: str) -> str:
    """Why the cascade of a package can't be used, and what to do; "" if it can."""
    if package == "cv2" and _haar_cascade() is None:
        return f"cv2 {cv2.__version__} has no cascade: pip install 'opencv-python-headless<5'"
    if package == "scikit-image" and find_spec("skimage") is None:
        return f"expected scikit-image to be installed: {install_extra('demo')}"
    return ""


def find_by_cv2(image: Image) -> Box | None:
    """The box of the largest face in a BGR or gray image, or None."""
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    size = (_smallest(image),) * 2
    found = _haar_cascade().detectMultiScale(gray, scaleFactor=1.1, minNeighbors=5, minSize=size)
    squares = [Box(*map(float, square)) for square in found]
    if not squares:
        return None
    x, y, half, _ = max(squares, key=lambda square: square.area).ellipse
    return Box.from_ellipse(x, y, HEAD_WIDTH_RATIO * half, HEAD_HEIGHT_RATIO * half)


def find_by_scikit_image(image: Image) -> Box | None:
    """The same."""
    smallest = _smallest(image)
    gray: Any = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    hits = _find_hits(gray, smallest)
    if not len(_faces(image, hits, 0.5)):  # then the mirror image isn't needed
        return None
    mirrored = _find_hits(gray[:, ::-1], smallest)
    mirrored[:, 0] = gray.shape[1] - mirrored[:, 0]
    faces = _faces(image, np.concatenate([hits, mirrored]), 1.0)
    if not len(faces):
        return None
    x, y, side = faces[np.argmax(faces[:, 2])]
    half = float(SQUARE_SCALE * side / 2)
    return Box.from_ellipse(float(x), float(y), HEAD_WIDTH_RATIO * half, HEAD_HEIGHT_RATIO * half)


def _smallest(image: Image) -> int:
    """The side of the smallest face, pixels, as tricue's detector has it."""
    smallest: int = max(MIN_SIDE, min(image.shape[:2]) // MIN_SHARE)
    return smallest


def _find_hits(gray: Image, smallest: int) -> Squares:
    """The windows of all sizes that pass the cascade.

    The image is reduced instead of enlarging the windows, because the cascade's cells have whole pixels.
    Images are scanned one at a time, because the order of hits within a call depends on the number of
    threads.
    """
    cascade = _lbp_cascade()
    height, width = gray.shape
    hits, side = [np.empty((0, 3))], float(smallest)
    while side < min(gray.shape):
        size = (round(width * WINDOW / side), round(height * WINDOW / side))
        if min(size) <= WINDOW:
            break
        # Without the mean, sums over the image stay small, and exact in the cascade's float32.
        reduced = cv2.resize(np.ascontiguousarray(gray), size, interpolation=cv2.INTER_LINEAR)
        level = reduced - np.round(reduced.mean())
        # Steps of one pixel, a single window size, ungrouped hits.
        one_size = (WINDOW, WINDOW), (WINDOW + 1, WINDOW + 1)
        found = cascade.detect_multi_scale(level, SCALE_STEP, 1, *one_size, 1, 1.0)
        across, down = width / size[0], height / size[1]
        middle = WINDOW / 2
        hits += [
            np.array([[(each["c"] + middle) * across, (each["r"] + middle) * down, side]]) for each in found
        ]
        side *= SCALE_STEP
    return np.concatenate(hits)


def _faces(image: Image, hits: Squares, share: float) -> Squares:
    """The means of groups of hits that have a face's color and ``share`` of the hits required for a face."""
    gray = image.ndim == 2 or float(np.ptp(image, axis=2).mean()) < MAX_GRAY_RANGE
    enough = share * (MIN_HITS_GRAY if gray else MIN_HITS)
    means = [group.mean(axis=0) for group in _groups(hits) if len(group) >= enough]
    return np.array([mean for mean in means if gray or _has_skin_color(image, mean)]).reshape(-1, 3)


def _groups(hits: Squares) -> list[Squares]:
    """The hits, grouped by connecting squares with all four edges near each other."""
    from scipy.sparse.csgraph import connected_components

    if not len(hits):
        return []
    x, y, side = hits.T
    edges = np.stack([x - side / 2, x + side / 2, y - side / 2, y + side / 2])
    differences = np.abs(edges[:, :, None] - edges[:, None, :]).max(axis=0)
    similar = differences <= SIMILAR * np.minimum(side[:, None], side)
    count, labels = connected_components(similar, directed=False)
    return [hits[labels == label] for label in range(count)]


def _has_skin_color(image: Image, square: NDArray[np.float64]) -> bool:
    """Whether the mean color of the square's inner half is as reddish as skin of any tone in any light."""
    x, y, side = square
    rows = slice(max(int(y - side / 4), 0), int(y + side / 4) + 1)
    columns = slice(max(int(x - side / 4), 0), int(x + side / 4) + 1)
    blue, green, red = image[rows, columns].reshape(-1, 3).mean(axis=0).tolist()
    return bool(red - green > MIN_GREEN_DEFICIT * red and red - blue > MIN_BLUE_DEFICIT * red)


@cache
def _haar_cascade() -> Any:  # missing in cv2 5's types
    """None if this cv2 has none."""
    folder = getattr(getattr(cv2, "data", None), "haarcascades", None)
    classifier = getattr(cv2, "CascadeClassifier", None)
    file = Path(folder or "", "haarcascade_frontalface_default.xml")
    return None if folder is None or classifier is None or not file.is_file() else classifier(str(file))


@cache
def _lbp_cascade() -> Any:
    from skimage import data
    from skimage.feature import Cascade

    locate: Any = data.lbp_frontal_face_cascade_filename
    return Cascade(locate())
