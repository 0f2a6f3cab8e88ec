# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be: in range, above the floor, thinned where it is large.

Images with many gaps are filled first: without that, bodies would fall apart.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.depth_objects.floor import find_floor
from tricue.track.depth_objects.params import SegmentationParams

Floats = NDArray[np.float64]
Depth = NDArray[np.float32]

MAX_MARGIN = 0.05  # of a side of the image, without any depth, that a registration leaves


class Foreground(NamedTuple):
    """Depth (h, w), meters, NaN in the background, and its camera (4,) fx, fy, cx, cy, pixels.

    Its pixel (i, j) is pixel (step i, step j) of the frame. measured: left, top, right, bottom, pixels, of
    the rectangle outside of which nothing was measured: registered depth ends before the image does.
    """

    depth: Depth
    camera: Floats
    step: int
    measured: tuple[int, int, int, int]


def extract_foreground(
    k: Kernels,
    depth: Depth,
    camera: Floats,
    plane: Floats,
    rng: np.random.Generator,
    p: SegmentationParams,
) -> tuple[Foreground, Floats]:
    """The foreground of a depth image (H, W), meters, and the plane (6,) of the floor.

    plane: the floor of the last frame, NO_FLOOR before the first. See :func:`find_floor`.
    """
    step = max(1, round(depth.shape[1] / p.resolution))
    thinned = np.ascontiguousarray(depth[::step, ::step])
    if p.gap_passes:
        thinned = k.fill_gaps(thinned, p.edge_gap, p.edge_slope, p.max_gap_share, p.gap_passes)
    thinned_camera = camera / step
    if p.floor:
        plane = find_floor(k, thinned, thinned_camera, plane, rng, p.near)
    kept = k.above_floor(thinned, thinned_camera, plane[:4], p.near, p.far, p.floor_clear)
    return Foreground(kept, thinned_camera, step, _measured_bounds(thinned)), plane


def _measured_bounds(depth: Depth) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the pixels with a depth, as far as the image has narrow margins without."""
    if all(map(_is_measured, (depth[0], depth[-1], depth[:, 0], depth[:, -1]))):
        return 0, 0, depth.shape[1], depth.shape[0]  # four sides are looked at sooner than all pixels
    known = depth > 0
    (top, bottom), (left, right) = (_measured_span(np.asarray(known.any(axis=axis))) for axis in (1, 0))
    return left, top, right, bottom


def _is_measured(side: NDArray[np.float32]) -> bool:
    """Whether a side of the image has any depth; mostly its middle has."""
    return side.item(len(side) // 2) > 0 or bool((side > 0).any())


def _measured_span(known: NDArray[np.bool_]) -> tuple[int, int]:
    """The first and the end of what is known along a side, or the side's own end where that is far."""
    length, where = len(known), np.flatnonzero(known)
    if where.size == 0:
        return 0, length
    first, end = int(where[0]), int(where[-1]) + 1
    margin = MAX_MARGIN * length
    return first if first <= margin else 0, end if length - end <= margin else length
