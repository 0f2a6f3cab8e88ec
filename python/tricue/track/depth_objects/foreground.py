# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be: in range, above the floor, subsampled if large.

Gaps are filled first in images with many, because bodies would fall apart otherwise.
"""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Depth, Floats
from tricue.kernels import Kernels
from tricue.track.depth_objects.floor import FLOOR_TOLERANCE, find_floor, floor_step, is_supported
from tricue.track.depth_objects.params import SegmentationParams

MAX_MARGIN = 0.05  # of an image side; a margin without depth that registration may leave


class Foreground(NamedTuple):
    """Depth (h, w), meters, NaN in the background, and its camera (4,) fx, fy, cx, cy, pixels.

    Its pixel (i, j) is pixel (step i, step j) of the frame. measured: left, top, right, bottom, pixels, of
    the rectangle outside which nothing was measured, since registered depth may end before the image does.
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
    number: int,
    p: SegmentationParams,
) -> tuple[Foreground, Floats]:
    """The foreground of a depth image (H, W), meters, and the plane (6,) of the floor.

    plane: the floor of the last frame, NO_FLOOR before the first. number: the frame's. See
    :func:`find_floor`.
    """
    step = max(1, round(depth.shape[1] / p.resolution))
    thinned_camera = camera / step if step > 1 else camera
    gaps = p.edge_gap, p.edge_slope, p.max_gap_share, p.gap_passes
    space = p.near, p.far, p.floor_clear
    test = FLOOR_TOLERANCE, floor_step(-(-depth.shape[1] // step))
    kept, support, measured = k.find_foreground(
        depth, step, gaps, thinned_camera, plane[:4], test, space, MAX_MARGIN
    )
    if p.floor and not is_supported(plane, on_plane := support.item(0)):
        filled = k.fill_gaps(np.ascontiguousarray(depth[::step, ::step]), *gaps)
        found = find_floor(k, filled, thinned_camera, plane, on_plane, number, p.near)
        if found is not plane:
            plane, kept = found, k.above_floor(filled, thinned_camera, found[:4], *space)
    return Foreground(kept, thinned_camera, step, measured), plane
