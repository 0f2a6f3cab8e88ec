# SPDX-License-Identifier: MIT
"""A frontal face by scikit-image's cascade of local binary patterns (Liao et al. 2007).

A window that passes is a hit. A face has many hits, at neighboring positions and sizes, and, since it is
symmetric, also in the mirrored image. In a color image it must have the color of skin.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.camera.box import Box

Squares = NDArray[np.float64]  # (N, 3): center x, y and side, pixels

WINDOW = 24  # pixels, of the cascade
SCALE_STEP = 1.1  # from one size of faces to the next
SIMILAR = 0.2  # of the smaller square's side: largest difference between the edges of one face's hits
MIN_HITS, MIN_HITS_GRAY = 11, 14  # in the image and its mirror image; a gray image has no color to check
MIN_GREEN_DEFICIT, MIN_BLUE_DEFICIT = 0.10, 0.15  # of skin, as shares of red: 83 of 84 pictures of skin
MAX_GRAY_RANGE = 4.0  # levels, mean difference of a pixel's channels; compressed gray video isn't quite gray
SQUARE_SCALE = 1.09  # side of the square of OpenCV's Haar cascade on a face, relative to this cascade's


def find_square(image: Image, smallest: int) -> Box | None:
    """The square of the largest face in a BGR or gray image, scaled to cv2's size; None without a face.

    smallest: side of the smallest face, pixels. ImportError without scikit-image.
    """
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
    half = SQUARE_SCALE * side / 2
    return Box.from_ellipse(float(x), float(y), float(half), float(half))


def _find_hits(gray: Image, smallest: int) -> Squares:
    """The windows of all sizes that pass the cascade.

    The image is reduced instead of enlarging the windows, because the cascade's cells have whole pixels.
    Images are scanned one at a time, because the order of hits within a call depends on the number of
    threads.
    """
    cascade = _load_cascade()
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
def _load_cascade() -> Any:
    from skimage import data
    from skimage.feature import Cascade

    locate: Callable[[], str] = data.lbp_frontal_face_cascade_filename
    return Cascade(locate())
