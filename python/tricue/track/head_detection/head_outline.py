# SPDX-License-Identifier: MIT
"""The outline of a head whose place is roughly known: the ellipse along which the image's edges run.

Disparities tell that place roughly: they are measured in windows, which spread over a head's sides.

Source: Birchfield 1998, "Elliptical head tracking using intensity gradients and color histograms". That edges
across the outline count against it, and strong ones little more than weak ones, is ours.
"""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Singles = NDArray[np.float32]

WIDTH = 20  # pixels of a head where its outline is looked for
REACH = 7  # pixels that the outline may be away, right, left, up and down
LOG_SIZES = np.linspace(-0.3, 0.3, 9)  # of the outline, relative to the head's
POINTS = 40  # along the outline, without the lower quarter, where the neck begins
NOISE = 2.0  # gray levels a pixel: an edge as strong counts half
DEVIATION, LOG_DEVIATION = 0.3, 0.15  # of place, in heads, and of size, from those that were given
PRIOR = 0.1  # of their squared deviations against the edges


class Outline(NamedTuple):
    """evidence: how much the edges run along it, 1 at most, less what it is away from the box that was given;
    about 0 where edges run anywhere.
    """

    evidence: float
    box: Box


class _Places(NamedTuple):
    """All outlines that are tried: S sizes at M places, and the n points of each.

    pixels: (S, n, M) where the points are in the patch, whose rows follow one another.
    cosines, sines: (n, 1) of twice the angle of the outline's normal.
    log_prior: (S, M) by how far the outline is from the box that was given.
    x, y: (M,) its center, pixels from the middle of the patch.
    """

    pixels: NDArray[np.intp]
    cosines: Singles
    sines: Singles
    log_prior: Singles
    x: NDArray[np.intp]
    y: NDArray[np.intp]


def _places(shape: tuple[int, int], aspect: float) -> _Places:
    """Of a patch (rows, columns) whose middle is in the middle of a pixel."""
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


def find_outline(k: Kernels, image: Image, box: Box) -> Outline:
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
    return Outline(float(evidence[size, place]), found)


def _edges(patch: Image) -> tuple[Singles, Singles]:
    """Cosine and sine of twice the gradient's angle, times its strength in [0, 1], of all pixels in turn.

    Of twice the angle, as it doesn't matter on which side of an edge it is light.
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
