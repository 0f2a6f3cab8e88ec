# SPDX-License-Identifier: MIT
"""The outline of a head at a roughly known place: the ellipse that the image's edges follow.

Disparities give the place only roughly, because their matching windows extend beyond a head's sides.

Source: Birchfield 1998, "Elliptical head tracking using intensity gradients and color histograms". Our
additions: edges across the outline count against it, and strong edges count little more than weak ones.
"""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image, Singles
from tricue.camera.box import Box
from tricue.kernels import Kernels

WIDTH = 20  # pixels, of a head in the image in which its outline is searched
REACH = 7  # pixels by which the outline may be off to each side
LOG_SIZES = np.linspace(-0.3, 0.3, 9)  # of the outline, relative to the head's
POINTS = 40  # along the outline except its lower quarter, where the neck begins
NOISE = 2.0  # gray levels per pixel; an edge of this strength counts half
DEVIATION, LOG_DEVIATION = 0.3, 0.15  # of the place, in head sizes, and of the log size, from the given ones
PRIOR = 0.1  # weight of their squared deviations relative to the edges


class HeadOutline(NamedTuple):
    """evidence: how well the edges follow it, at most 1, minus a penalty for its distance from the given box;
    about 0 for edges in random directions.
    """

    evidence: float
    box: Box


class _Places(NamedTuple):
    """All candidate outlines: S sizes at M places, and the n points of each.

    pixels: (S, n, M) the points' indices in the flattened patch.
    cosines, sines: (n, 1) of twice the angle of the outline's normal.
    log_prior: (S, M) by the outline's distance from the given box.
    x, y: (M,) the outlines' centers, pixels from the middle of the patch.
    """

    pixels: NDArray[np.intp]
    cosines: Singles
    sines: Singles
    log_prior: Singles
    x: NDArray[np.intp]
    y: NDArray[np.intp]


def _places(shape: tuple[int, int], aspect: float) -> _Places:
    """The candidates for a patch (rows, columns) centered on a pixel."""
    rows, columns = shape
    angles = np.linspace(-0.75 * np.pi, 0.75 * np.pi, POINTS)  # from straight up
    across, down = np.sin(angles), -np.cos(angles)
    sizes = np.exp(LOG_SIZES)[:, None] * WIDTH / 2
    x = np.rint(sizes * across).astype(np.intp) + columns // 2
    y = np.rint(sizes * aspect * down).astype(np.intp) + rows // 2
    normal = 2 * np.arctan2(down / aspect, across)
    moves = np.arange(-REACH, REACH + 1)
    dy, dx = (each.ravel() for each in np.meshgrid(moves, moves, indexing="ij"))
    away = (dx / (DEVIATION * WIDTH)) ** 2 + (dy / (DEVIATION * WIDTH * aspect)) ** 2
    resized = (LOG_SIZES / LOG_DEVIATION) ** 2
    return _Places(
        pixels=(y * columns + x)[:, :, None] + dy * columns + dx,
        cosines=np.cos(normal).astype(np.float32)[:, None],
        sines=np.sin(normal).astype(np.float32)[:, None],
        log_prior=(-0.5 * (resized[:, None] + away)).astype(np.float32),
        x=dx,
        y=dy,
    )


def find_outline(k: Kernels, image: Image, box: Box) -> HeadOutline:
    """The best outline of the head in a box, pixels of an image, BGR or gray."""
    aspect = box.height / box.width
    largest = np.exp(LOG_SIZES[-1]) * WIDTH / 2
    columns, rows = (2 * (int(np.ceil(half)) + REACH) + 1 for half in (largest, largest * aspect))
    places = _places((rows, columns), aspect)
    scale, (x, y) = box.width / WIDTH, box.center
    window = np.array(
        [[x - columns / 2 * scale, y - rows / 2 * scale, columns * scale, rows * scale]], np.float64
    )
    cosines, sines = _edges(k.sample_windows(image, window, rows, columns)[0])
    along = places.cosines * cosines[places.pixels] + places.sines * sines[places.pixels]
    evidence = along.mean(axis=1) + PRIOR * places.log_prior
    size, place = np.unravel_index(np.argmax(evidence), evidence.shape)
    factor = float(np.exp(LOG_SIZES[size])) / 2
    middle = x + float(places.x[place]) * scale, y + float(places.y[place]) * scale
    found = Box.from_ellipse(*middle, factor * box.width, factor * box.height)
    return HeadOutline(float(evidence[size, place]), found)


def _edges(patch: Image) -> tuple[Singles, Singles]:
    """Cosine and sine of twice the gradient's angle, times its strength in [0, 1], for all pixels of the
    flattened patch.

    Doubling the angle makes it independent of which side of an edge is brighter.
    """
    pixels = patch.shape[0] * patch.shape[1]
    x, y = (
        cv2.Sobel(patch, cv2.CV_32F, *order, ksize=3, scale=1 / 8).reshape(pixels, -1)
        for order in ((1, 0), (0, 1))
    )
    strongest = np.argmax(x * x + y * y, axis=1)[:, None]  # channel
    x, y = (np.take_along_axis(each, strongest, axis=1)[:, 0] for each in (x, y))
    squared = x * x + y * y
    strength = np.sqrt(squared)
    weight = strength / ((strength + NOISE) * np.maximum(squared, np.float32(1e-12)))
    return (x * x - y * y) * weight, 2 * x * y * weight
