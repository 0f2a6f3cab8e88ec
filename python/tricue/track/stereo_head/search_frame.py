# SPDX-License-Identifier: MIT
"""Re-detection: searches the whole image at all distances for a lost head, by color and depth."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.stereo_head.disparity import limits_between
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Disparities, Ellipse, PreparedPair, cell_side
from tricue.track.stereo_head.search_local import score_matches
from tricue.track.stereo_head.stereo_geometry import Point, StereoGeometry

CELL_STRIDE = 3  # every third cell of ``resolution`` columns is searched, in both directions
MIN_SEARCHED_WIDTH = 4  # searched cells, of a head as far away as it was; for a small head there are more
DISTANCE_RATIO = 0.85  # ratio of a searched distance to the next farther one
MIN_SEMI_AXIS = 1.0  # of an ellipse, in searched cells


class LostHead(NamedTuple):
    """A lost head, and where it can be.

    size: width and height, meters. histogram: (L,) its color model. last_seen: (3,) meters.
    radius: its largest distance from there, meters.
    """

    size: tuple[float, float]
    histogram: Floats
    last_seen: Point
    radius: float

    def distances(self, p: StereoHeadParams) -> tuple[float, float]:
        """The smallest and the largest distance at which it can be, meters."""
        z = self.last_seen[2]
        return max(z - self.radius, p.near), min(z + self.radius, p.far)


def search_frame(
    k: Kernels, pair: PreparedPair, geometry: StereoGeometry, head: LostHead, p: StereoHeadParams
) -> tuple[Ellipse, float] | None:
    """The ellipse and the disparity, pixels, most like the head; None if it can't be in the image."""
    stride = _stride(pair, geometry.width(head.size, head.last_seen[2]), p)
    step = pair.step * stride
    disparities = _match_cells(k, pair, geometry, head, p)[stride // 2 :: stride, stride // 2 :: stride]
    rows, columns = disparities.shape
    bins = pair.bins(k, (0, 0, columns * stride, rows * stride), stride, p)
    best: tuple[float, Ellipse, float] | None = None
    for z in _sample_distances(*head.distances(p)):
        disparity = geometry.disparity(z)
        minor, major = (
            half / 2 * f / z for half, f in zip(head.size, geometry.rig[:2].tolist(), strict=True)
        )
        if not MIN_SEMI_AXIS <= min(minor, major) / step <= max(rows, columns):
            continue
        cells = disparity / pair.step
        tolerance = max(p.disparity_tolerance, (1 - DISTANCE_RATIO) / 2 * cells)
        coherent = (np.abs(disparities - np.float32(cells)) <= tolerance).view(np.uint8)
        middle = np.array([columns / 2, rows / 2, minor / step, major / step])
        grid = (rows, columns, 1)
        scores = score_matches(k.ellipse_search(bins, middle, grid, head.histogram, p.ring, coherent), p)
        x, y = _grid_centers(columns) * step, _grid_centers(rows) * step
        scores[~_select_reachable(head, geometry, x, y, z)] = -np.inf
        row, column = divmod(int(np.argmax(scores)), columns)
        if scores[row, column] > (-np.inf if best is None else best[0]):
            ellipse = float(x[column]), float(y[row]), minor, major
            measured = _measure(np.where(coherent, disparities, np.float32(np.nan)), ellipse, step)
            best = float(scores[row, column]), ellipse, cells if measured is None else measured
    return None if best is None else (best[1], best[2] * pair.step)


def _measure(disparities: Disparities, ellipse: Ellipse, step: int) -> float | None:
    """The median of the disparities in an ellipse; None if there is none.

    The search tries few distances, which are farther apart than the disparities that are searched next.
    step: pixels from a disparity to the next one.
    """
    x, y, minor, major = ellipse
    rows, columns = disparities.shape
    across = ((np.arange(columns) + 0.5) * step - x) / minor
    down = ((np.arange(rows) + 0.5) * step - y) / major
    inside = disparities[across**2 + down[:, None] ** 2 <= 1]
    measured = inside[np.isfinite(inside)]
    return float(np.median(measured)) if measured.size else None


def _sample_distances(near: float, far: float) -> list[float]:
    """Distances from near to far, inclusive, with equal ratios."""
    count = max(1, math.ceil(math.log(far / near) / -math.log(DISTANCE_RATIO)))
    return [float(z) for z in np.geomspace(near, far, count + 1)]


def _grid_centers(count: int) -> Floats:
    """The centers (count,) that ``ellipse_search`` tries around the middle of this many cells."""
    return np.arange(float(count)) + (count / 2 - count // 2)


def _select_reachable(
    head: LostHead, geometry: StereoGeometry, x: Floats, y: Floats, z: float
) -> NDArray[np.bool_]:
    """Whether (rows, columns) the head can be at x and y, box coordinates, and a distance z, meters."""
    fx, fy, cx, cy, _ = geometry.rig.tolist()
    dx = (x - 0.5 - cx) * z / fx - head.last_seen[0]
    dy = (y - 0.5 - cy) * z / fy - head.last_seen[1]
    dz = z - head.last_seen[2]
    return np.asarray(dx**2 + dy[:, None] ** 2 + dz**2 <= head.radius**2)


def _match_cells(
    k: Kernels, pair: PreparedPair, geometry: StereoGeometry, head: LostHead, p: StereoHeadParams
) -> Disparities:
    """The disparity of each cell, in cells, within the head's possible range."""
    height, width = pair.shape
    first, last = limits_between(geometry, *head.distances(p), pair.step)
    region, limits = (0, 0, width, height), (first - 1, last + 1)
    return pair.disparities(k, region, limits, p, ellipse=False, cells=True)


def _stride(pair: PreparedPair, head_width: float, p: StereoHeadParams) -> int:
    """Of how many cells one is searched, in both directions, for a head of about so many pixels."""
    coarsest = CELL_STRIDE * cell_side(pair.left.shape, math.inf, p)
    return max(1, int(min(coarsest, head_width / MIN_SEARCHED_WIDTH) / pair.step))
