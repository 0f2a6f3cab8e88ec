# SPDX-License-Identifier: MIT
"""The objects of a depth image (Sabeti, Parvizi, Wu 2008, section IV.A)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.cues.depth.changed_depth import changed_depth
from tricue.reference.cues.depth.cut_sides import Cut, cut_sides
from tricue.reference.cues.depth.density_extrema import density_extrema
from tricue.reference.cues.depth.depth_components import depth_components
from tricue.reference.cues.depth.depth_density import depth_density
from tricue.reference.cues.depth.depth_edges import depth_edges
from tricue.reference.cues.depth.depth_histogram import depth_histogram
from tricue.reference.cues.depth.divide_depth import divide_depth
from tricue.reference.cues.depth.ground_distance import ground_distance
from tricue.reference.cues.depth.measure_objects import Ground, measure_objects

Region = tuple[int, int, int, int]
BINS = 16  # of an object's distributions over columns and rows
MAX_MINIMA = 254  # labels have 8 bits


def segment_depth(
    depth: Depth,
    searched: tuple[Region, Depth, float, float],
    camera: Floats,
    ground: Ground,
    measured: Region,
    divisions: tuple[tuple[float, float, int], float, float, float, float, int],
    cut: Cut,
) -> tuple[Floats, NDArray[np.bool_], Depth, Depth]:
    """Calls one twin after the other."""
    region, before, noise, noise_slope = searched
    up = ground[0][:3]
    (near, far, count), gap, slope, bandwidth, prominence, min_area = divisions
    distance = ground_distance(depth, camera, up, near, far) if up.any() else depth
    mask = 1 - depth_edges(distance, gap, slope)
    if before.shape == (0, 0):
        before = np.full_like(depth, np.nan)  # everything differs from NaN
    mask &= changed_depth(depth, before, noise, noise_slope)
    mask[~_inside(region, depth)] = 0
    counts = depth_histogram(distance, mask, near, far, count)
    dividers = _dividers(counts, near, far, bandwidth, prominence)
    labels = divide_depth(distance, mask, dividers)
    table, _, columns, rows, _ = depth_components(labels, depth, near, far, 0, BINS, min_area, False)
    sides = cut_sides(depth, table, camera, cut) | _at_edge(table, measured, cut[0])
    return measure_objects((table, columns, rows, sides), camera, ground), sides, columns, rows


def _inside(region: Region, depth: Depth) -> NDArray[np.bool_]:
    x0, y0, x1, y1 = region
    y, x = np.indices(depth.shape)
    return np.asarray((x >= x0) & (x < x1) & (y >= y0) & (y < y1))


def _dividers(counts: Floats, near: float, far: float, bandwidth: float, prominence: float) -> Floats:
    density = depth_density(counts, bandwidth)
    _, minima = density_extrema(density, prominence * float(density.max()))
    level = (far - near) / len(counts)
    return np.array([near, *(near + (minima[:MAX_MINIMA] + 0.5) * level), far])


def _at_edge(table: Floats, measured: Region, border: int) -> NDArray[np.bool_]:
    (x, y, width, height), (left, top, right, bottom) = table[:, :4].T, measured
    gaps = x - left, right - (x + width), y - top, bottom - (y + height)
    at_edge: NDArray[np.bool_] = np.column_stack(gaps) < border
    return at_edge
