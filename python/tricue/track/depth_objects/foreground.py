# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be: in range, above the floor, thinned out where large.

An image that is riddled with gaps is mended first: bodies would fall apart in it.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.depth_objects.params import SegmentationParams

Floats = NDArray[np.float64]
Depth = NDArray[np.float32]

NO_FLOOR = np.zeros(6)
UP = np.array([0.0, -1.0, 0.0])
LEAST_COSINE = 0.6  # a camera looks down, up, or aside by up to 53 degrees
COARSE = 80  # columns of the image in which the floor is looked for
TOLERANCE = 0.04  # metres, of a point on the floor
TRIALS = 128  # planes tried
STEADY = 0.8  # of the points that were on the floor when it was found: the camera hasn't moved
FLOOR_SHARE, BELOW_SHARE = 0.06, 0.03  # of all points: the least on a floor, the most under it


class Foreground(NamedTuple):
    """Depth (h, w) with NaN wherever no target is, and the camera (4,) that sees it: fx, fy, cx, cy.

    Its pixel (i, j) is the frame's (step i, step j).
    """

    depth: Depth
    camera: Floats
    step: int


def numbers(camera: Intrinsics) -> Floats:
    """(4,) fx, fy, cx, cy: what kernels know of a camera."""
    return np.array([camera.fx, camera.fy, camera.cx, camera.cy])


def foreground(
    k: Kernels,
    depth: Depth,
    camera: Floats,
    plane: Floats,
    rng: np.random.Generator,
    p: SegmentationParams,
) -> tuple[Foreground, Floats]:
    """The foreground, and the floor's plane (6,), what floor_plane gives: zeros while none is known."""
    step = max(1, round(depth.shape[1] / p.resolution))
    thin = np.ascontiguousarray(depth[::step, ::step])
    if p.gap_passes:
        thin = k.fill_gaps(thin, p.edge_gap, p.edge_slope, p.ragged, p.gap_passes)
    thinned = camera / step
    if p.floor:
        plane = floor(k, thin, thinned, plane, rng, p.near)
    kept = k.above_floor(thin, thinned, plane[:4], p.near, p.far, p.floor_clear)
    return Foreground(kept, thinned, step), plane


def floor(
    k: Kernels, depth: Depth, camera: Floats, known: Floats, rng: np.random.Generator, near: float
) -> Floats:
    """The plane with many points on it and hardly any below; the known one where this frame has none."""
    step = max(1, round(depth.shape[1] / COARSE))
    support = 0.0
    if known.any():
        support = float(k.plane_support(depth, camera, known[:4], TOLERANCE, step)[0])
        if support >= STEADY * known[4]:
            return known
    coarse = depth[::step, ::step]
    # Points within the tolerance of the camera would be on any plane through it.
    coarse = np.where(coarse >= near, coarse, np.float32(np.nan))
    # Below the middle of the image: there it is seen best.
    triples = rng.integers(coarse.size // 2, coarse.size, (TRIALS, 3))
    plane = k.floor_plane(coarse, camera / step, triples, TOLERANCE, UP, LEAST_COSINE)
    found = plane[4] > max(FLOOR_SHARE, support) and plane[5] < BELOW_SHARE
    return plane if found else known
