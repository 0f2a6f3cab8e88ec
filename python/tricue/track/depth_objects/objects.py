# SPDX-License-Identifier: MIT
"""Objects in depth, section IV.A: divisions of the range, (32)-(36), and their connected components."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Singles
from tricue.camera.box import Box
from tricue.kernels import Kernels
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.params import SegmentationParams
from tricue.track.depth_objects.projection import project_box

DISTRIBUTION_BINS = 16  # of an object's horizontal distribution, and of its vertical one
BORDER = 2  # pixels; an object this near the image's border may continue outside
MAX_FEET_HEIGHT = 0.35  # meters; an object whose lower end is below this stands on the floor
OCCLUDER_DISTANCE = 0.08  # meters beside an object's side in which an occluder is looked for
MAX_SIDE_COVERED = 0.15  # of a side; an object covered more is cut there
NO_EDGES = 1e6  # meters, larger than any depth step
MIN_PIXELS = 8.0  # of an object at any distance
SAME_DEPTH, SAME_DEPTH_SLOPE = 0.02, 0.005  # meters, plus this times z²: a sensor's noise
NOTHING_KNOWN = np.empty((0, 0), np.float32)
Region = tuple[int, int, int, int]
EVERYWHERE: Region = (0, 0, 2**31 - 1, 2**31 - 1)


class Objects(NamedTuple):
    """C objects, largest first, as returned by the kernel segment_depth.

    measured: (C, 8) ``states``, ``centroid_offset`` and ``area`` in one array.
    cut: (C, 4) whether an object may continue beyond its left, right, top, bottom: at the edge of the
        measured area or behind an occluder.
    columns, rows: (C, DISTRIBUTION_BINS) horizontal and vertical distribution, each with sum 1.
    """

    measured: Floats
    cut: NDArray[np.bool_]
    columns: Singles
    rows: Singles

    @property
    def states(self) -> Floats:
        """(C, 5) X, Y, Z of the box's center, width and height, meters; Z is the mean depth."""
        return self.measured[:, :5]

    @property
    def centroid_offset(self) -> Floats:
        """(C, 2) from the box's center to the centroid, meters."""
        return self.measured[:, 5:7]

    @property
    def area(self) -> Floats:
        """The areas (C,), square meters."""
        return self.measured[:, 7]

    @property
    def whole(self) -> NDArray[np.bool_]:
        """(C, 2) whether the whole width and the whole height are visible."""
        return ~(self.cut[:, ::2] | self.cut[:, 1::2])

    def boxes(self, camera: Floats) -> list[Box]:
        """Their boxes in pixels of a camera (4,)."""
        return [project_box(state, camera) for state in self.states]


class Divisions(NamedTuple):
    """Where one object ends and another begins, as in the kernel segment_depth.

    levels: smallest and greatest depth, meters, and the number of levels between them. gap, slope: a jump of
    the depth by more than gap + slope z² is an edge, meters. bandwidth: of the kernel density, levels.
    prominence: of a maximum, as a share of the greatest density. min_area: pixels.
    """

    levels: tuple[float, float, int]
    gap: float
    slope: float
    bandwidth: float
    prominence: float
    min_area: int

    @classmethod
    def create(cls, p: SegmentationParams, fg: Foreground) -> "Divisions":
        """The divisions of an image by the parameters."""
        fx, fy = fg.camera[:2].tolist()
        far_pixels = p.min_area * fx * fy / p.far**2
        return cls(
            (p.near, p.far, p.levels),
            p.edge_gap if p.edges else NO_EDGES,
            p.edge_slope,
            p.bandwidth / ((p.far - p.near) / p.levels),
            p.prominence,
            int(min(max(MIN_PIXELS, far_pixels), fg.depth.size + 1.0)),
        )


def segment(
    k: Kernels,
    fg: Foreground,
    plane: Floats,
    p: SegmentationParams,
    *,
    region: Region = EVERYWHERE,
    others: Singles = NOTHING_KNOWN,
) -> Objects:
    """Divide the range at the minima of the distances' density, and each division into connected objects.

    plane: (6,) the floor, along which distances are measured and to which objects' feet are extended;
    NO_FLOOR without one. region: x0, y0, x1, y1, the columns and rows in which to look for objects. others:
    (h, w) meters, depths of what isn't an object; pixels that still have this depth, up to noise, are left
    out.
    """
    found = k.segment_depth(
        fg.depth,
        (region, others, SAME_DEPTH, SAME_DEPTH_SLOPE),
        fg.camera,
        (plane[:4], MAX_FEET_HEIGHT),
        fg.measured,
        Divisions.create(p, fg),
        (BORDER, OCCLUDER_DISTANCE, p.occluder_margin, MAX_SIDE_COVERED),
    )
    return Objects(*found)
