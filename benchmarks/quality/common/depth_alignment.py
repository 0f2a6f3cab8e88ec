# SPDX-License-Identifier: MIT
"""How far edges of depth are from edges of color, in pixels and in frames."""

from collections.abc import Sequence
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.quality.common.depth_holes import MIN_STEP, fill_holes

Array = NDArray[np.float64]
MAX_SHIFT = 8
"""Largest shift along x and y, pixels."""
BLOCKS = 3, 4
"""Rows and columns of the parts of an image, each of which has its own shift."""
MIN_EDGE_PIXELS = 120
MIN_PEAK = 1.5
"""The gradient at the best shift, as a multiple of the mean over all shifts; noise reaches 1.3."""
MAX_LAG = 3


class Edges(NamedTuple):
    """Pixels (n,) at edges of depth: rows and columns."""

    rows: NDArray[np.intp]
    columns: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.rows)


def gradient(gray: NDArray[np.uint8]) -> Array:
    """The magnitude of the gradient (H, W), gray levels per pixel, limited to 20."""
    smooth = cv2.GaussianBlur(gray.astype(np.float32), (0, 0), 1.0)
    along = [cv2.Sobel(smooth, cv2.CV_32F, dx, dy, scale=1 / 8) for dx, dy in ((1, 0), (0, 1))]
    return np.asarray(np.minimum(np.hypot(*along), 20), np.float64)


def find_edges(depth: Array) -> Edges:
    """The pixels on both sides of steps in depth; holes are first filled from the farther side."""
    filled = fill_holes(depth)
    square = np.ones((3, 3), np.uint8)
    clean = np.where(np.isfinite(filled), filled, 0.0)
    near, far = cv2.erode(clean, square), cv2.dilate(clean, square)
    edge = (near > 0) & (far - near > MIN_STEP * near)
    edge[:MAX_SHIFT] = edge[-MAX_SHIFT:] = False
    edge[:, :MAX_SHIFT] = edge[:, -MAX_SHIFT:] = False
    return Edges(*np.nonzero(edge))


def scores(edges: Edges, slopes: Array) -> Array:
    """The mean gradient at the edges after each shift along y and x, (2 MAX_SHIFT + 1, 2 MAX_SHIFT + 1)."""
    span = range(-MAX_SHIFT, MAX_SHIFT + 1)
    return np.array([[slopes[edges.rows + dy, edges.columns + dx].mean() for dx in span] for dy in span])


def shifts(edges: Edges, slopes: Array) -> Array:
    """The shifts (n, 2) from depth to color, x and y, in the parts of an image in which edges match."""
    rows, columns = (
        np.minimum(place * count // size, count - 1)
        for place, count, size in zip(edges, BLOCKS, slopes.shape, strict=True)
    )
    found = []
    for block in range(BLOCKS[0] * BLOCKS[1]):
        own = rows * BLOCKS[1] + columns == block
        if own.sum() < MIN_EDGE_PIXELS:
            continue
        surface = scores(Edges(edges.rows[own], edges.columns[own]), slopes)
        dy, dx = np.unravel_index(int(surface.argmax()), surface.shape)
        inside = all(0 < at < 2 * MAX_SHIFT for at in (dy, dx))
        if inside and surface.max() > MIN_PEAK * surface.mean():
            found.append([dx - MAX_SHIFT, dy - MAX_SHIFT])
    return np.array(found, float).reshape(-1, 2)


def delay(edges: Sequence[Edges], slopes: Sequence[Array]) -> float:
    """By how many frames, and fractions of a frame, depth is later than color; NaN if the lag isn't clear.

    Each frame's edges of depth are compared with the color of the frames from MAX_LAG before to MAX_LAG
    after. The lag is the one with the highest peak of the mean gradient over shifts.
    """
    lags = range(-MAX_LAG, MAX_LAG + 1)
    at = [index for index in range(MAX_LAG, len(edges) - MAX_LAG) if len(edges[index]) >= MIN_EDGE_PIXELS]
    if not at:
        return float("nan")
    surfaces = [np.mean([scores(edges[index], slopes[index + lag]) for index in at], axis=0) for lag in lags]
    peaks = np.array([surface.max() for surface in surfaces])
    best = int(peaks.argmax())
    if not 0 < best < 2 * MAX_LAG:
        return float("nan")
    before, top, after = peaks[best - 1 : best + 2]
    return float(MAX_LAG - best - (before - after) / (2 * (before - 2 * top + after)))
