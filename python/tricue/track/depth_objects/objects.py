# SPDX-License-Identifier: MIT
"""Objects in depth, section IV.A: divisions of the range, (32)-(36), and their connected components."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.metric import box_of
from tricue.track.depth_objects.params import SegmentationParams

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

SLICES = 16  # of an object's width and height, in its horizontal and vertical distribution
EDGE = 2  # pixels from the border within which an object may go on outside
FEET = 0.35  # metres over the floor, from which somebody still stands on it
LEGS = 0.7  # as wide as a body's box on average
BESIDE = 0.08  # metres from an object, where something nearer may cover more of it,
COVERED = 0.15  # on so much of a side
NEVER = 1e6  # metres, a jump of the depth that there is not
ONE = np.uint8(1)


class Objects(NamedTuple):
    """C objects, largest first; with their signatures, horizontal and vertical distribution.

    states: (C, 5) X, Y, Z of the box's centre, width and height, metres; Z is the mean depth.
    cut: (C, 4) whether it may go on at its left, right, top, bottom: at the image's border, or behind
        something nearer.
    shift: (C, 2) from the box's centre to the centroid, metres.
    columns, rows: (C, SLICES) each of sum 1. area: (C,) square metres.
    """

    states: Floats
    cut: NDArray[np.bool_]
    shift: Floats
    columns: Singles
    rows: Singles
    area: Floats

    @property
    def whole(self) -> NDArray[np.bool_]:
        """(C, 2) whether the width and the height are seen whole."""
        return ~(self.cut[:, ::2] | self.cut[:, 1::2])

    def boxes(self, camera: Floats) -> list[Box]:
        """Their boxes in pixels of a camera (4,)."""
        return [box_of(state, camera) for state in self.states]


def segment(k: Kernels, fg: Foreground, plane: Floats, p: SegmentationParams) -> Objects:
    """Divide the range at the minima of the depth's density, and each division into connected objects."""
    depth = fg.depth
    gap = p.edge_gap if p.edges else NEVER
    mask = k.depth_edges(depth, gap, p.edge_slope) ^ ONE
    counts = k.depth_histogram(depth, mask, p.near, p.far, p.levels)
    level = (p.far - p.near) / p.levels
    density = k.depth_density(counts, p.bandwidth / level)
    _, minima = k.density_extrema(density, p.prominence * float(density.max()))
    dividers = np.array([p.near, *(p.near + (m + 0.5) * level for m in minima[:254].tolist()), p.far])
    labels = k.divide_depth(depth, mask, dividers)
    least = p.least_area * fg.camera[0] * fg.camera[1] / p.far**2
    area = int(min(max(8.0, least), depth.size + 1.0))
    table, _, columns, rows, _ = k.depth_components(labels, depth, p.near, p.far, 0, SLICES, area, False)
    cut = k.cut_sides(depth, table, fg.camera, EDGE, BESIDE, p.nearer, COVERED)
    measured = k.measure_objects(table, columns, rows, cut, fg.camera, plane[:4], FEET, LEGS)
    return Objects(measured[:, :5], cut, measured[:, 5:7], columns, rows, measured[:, 7])
