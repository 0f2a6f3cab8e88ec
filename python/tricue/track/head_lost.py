# SPDX-License-Identifier: MIT
"""A head that was lost is looked for in the whole picture, at every distance: by color and depth."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.eyes import Eyes
from tricue.track.head_search import score
from tricue.track.head_view import NO_CHECK, Ellipse, Pair
from tricue.track.stereo_params import StereoHeadParams

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

THIN = 3  # places from one to the next, of those looked at
NEARER = 0.85  # from one distance to the next
SMALLEST = 1.0  # semi-axis, of those places


class Head(NamedTuple):
    """What is looked for: its size, metres, its colors (L,), and its distance, metres, from near to far."""

    size: tuple[float, float]
    histogram: Floats
    near: float
    far: float


def find_again(
    k: Kernels, pair: Pair, eyes: Eyes, head: Head, p: StereoHeadParams
) -> tuple[Ellipse, float] | None:
    """The ellipse and the disparity, pixels, that are most like a head, anywhere in the picture."""
    step = pair.step * THIN
    found = _disparities(k, pair, eyes, head, p)
    rows, columns = found.shape
    bins = pair.bins(k, (0, 0, columns * THIN, rows * THIN), THIN, p)
    best: tuple[float, Ellipse, float] | None = None
    for z in _distances(head):
        disparity = eyes.disparity(z)
        minor, major = (half / 2 * f / z for half, f in zip(head.size, eyes.rig[:2].tolist(), strict=True))
        if min(minor, major) / step < SMALLEST:
            continue
        places = disparity / pair.step
        within = max(p.coherent, (1 - NEARER) / 2 * places)
        there = (np.abs(found - np.float32(places)) <= within).view(np.uint8)
        middle = np.array([columns / 2, rows / 2, minor / step, major / step])
        grid = (rows, columns, 1)
        scores = score(k.ellipse_search(bins, middle, grid, head.histogram, p.ring, there), p)
        row, column = divmod(int(np.argmax(scores)), columns)
        if best is None or scores[row, column] > best[0]:
            x, y = (columns / 2 + column - columns // 2) * step, (rows / 2 + row - rows // 2) * step
            best = float(scores[row, column]), (x, y, minor, major), disparity
    return None if best is None else best[1:]


def _distances(head: Head) -> list[float]:
    """From near to far, each a little farther than the one before."""
    count = max(1, math.ceil(math.log(head.far / head.near) / -math.log(NEARER)))
    return [float(z) for z in np.geomspace(head.near, head.far, count + 1)]


def _disparities(k: Kernels, pair: Pair, eyes: Eyes, head: Head, p: StereoHeadParams) -> Singles:
    """Of every THIN-th place, in places; those that a head can have."""
    height, width = pair.small[0].shape
    first, last = (eyes.disparity(z) / pair.step for z in (head.far, head.near))
    region = (0, 0, width, height)
    found = k.sad_disparity(
        *pair.small,
        region,
        False,
        math.floor(first) - 1,
        math.ceil(last) + 1,
        p.window,
        p.uniqueness,
        p.prefilter,
        NO_CHECK,
    )
    return found[THIN // 2 :: THIN, THIN // 2 :: THIN]
