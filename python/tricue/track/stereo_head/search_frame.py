# SPDX-License-Identifier: MIT
"""A head that was lost is looked for in the whole picture, at every distance: by color and depth."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.depth import span_between
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.search import score
from tricue.track.stereo_head.stereo_geometry import StereoGeometry
from tricue.track.stereo_head.view import NO_CHECK, Ellipse, Pair

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

THIN = 3  # places from one to the next, of those looked at
NEARER = 0.85  # from one distance to the next
SMALLEST = 1.0  # semi-axis, of those places


class Head(NamedTuple):
    """What is looked for: its size, metres, its colors (L,), where it was last, (3,) metres, and how far from
    there it can be.
    """

    size: tuple[float, float]
    histogram: Floats
    seen: Floats
    reach: float

    def distances(self, p: StereoHeadParams) -> tuple[float, float]:
        """The nearest and the farthest that it can be, metres."""
        z = float(self.seen[2])
        return max(z - self.reach, p.near), min(z + self.reach, p.far)


def find_again(
    k: Kernels, pair: Pair, geometry: StereoGeometry, head: Head, p: StereoHeadParams
) -> tuple[Ellipse, float] | None:
    """The ellipse and the disparity, pixels, that are most like a head, wherever it can be in the picture."""
    step = pair.step * THIN
    found = _disparities(k, pair, geometry, head, p)
    rows, columns = found.shape
    bins = pair.bins(k, (0, 0, columns * THIN, rows * THIN), THIN, p)
    best: tuple[float, Ellipse, float] | None = None
    for z in _distances(*head.distances(p)):
        disparity = geometry.disparity(z)
        minor, major = (
            half / 2 * f / z for half, f in zip(head.size, geometry.rig[:2].tolist(), strict=True)
        )
        if not SMALLEST <= min(minor, major) / step <= max(rows, columns):
            continue
        places = disparity / pair.step
        within = max(p.coherent, (1 - NEARER) / 2 * places)
        there = (np.abs(found - np.float32(places)) <= within).view(np.uint8)
        middle = np.array([columns / 2, rows / 2, minor / step, major / step])
        grid = (rows, columns, 1)
        scores = score(k.ellipse_search(bins, middle, grid, head.histogram, p.ring, there), p)
        x, y = _places(columns) * step, _places(rows) * step
        scores[~_within_reach(head, geometry, x, y, z)] = -np.inf
        row, column = divmod(int(np.argmax(scores)), columns)
        if scores[row, column] > (-np.inf if best is None else best[0]):
            best = float(scores[row, column]), (float(x[column]), float(y[row]), minor, major), disparity
    return None if best is None else best[1:]


def _distances(near: float, far: float) -> list[float]:
    """From near to far, each a little farther than the one before."""
    count = max(1, math.ceil(math.log(far / near) / -math.log(NEARER)))
    return [float(z) for z in np.geomspace(near, far, count + 1)]


def _places(count: int) -> Floats:
    """Where the grid of ellipse_search puts the centre, which is in the middle of so many places."""
    return np.arange(float(count)) + (count / 2 - count // 2)


def _within_reach(head: Head, geometry: StereoGeometry, x: Floats, y: Floats, z: float) -> NDArray[np.bool_]:
    """(rows, columns) whether the head can be at x and y, box coordinates, at a distance."""
    fx, fy, cx, cy, _ = geometry.rig.tolist()
    aside = (x - 0.5 - cx) * z / fx - head.seen[0]
    below = (y - 0.5 - cy) * z / fy - head.seen[1]
    ahead = z - head.seen[2]
    return np.asarray(aside**2 + below[:, None] ** 2 + ahead**2 <= head.reach**2)


def _disparities(
    k: Kernels, pair: Pair, geometry: StereoGeometry, head: Head, p: StereoHeadParams
) -> Singles:
    """Of every THIN-th place, in places; those that a head can have."""
    height, width = pair.small[0].shape
    first, last = span_between(geometry, *head.distances(p), pair.step)
    region = (0, 0, width, height)
    found = k.sad_disparity(
        *pair.small,
        region,
        False,
        first - 1,
        last + 1,
        p.window,
        p.uniqueness,
        p.prefilter,
        NO_CHECK,
    )
    return found[THIN // 2 :: THIN, THIN // 2 :: THIN]
