# SPDX-License-Identifier: MIT
"""The floor's plane, from random samples of the depth image; kept while the camera doesn't move."""

import numpy as np

from tricue.arrays import Depth, Floats
from tricue.kernels import Kernels

NO_FLOOR = np.zeros(6)
UP = np.array([0.0, -1.0, 0.0])  # camera frame
MIN_FLOOR_COSINE = 0.6  # between the floor's normal and UP: tilts and rolls of up to 53 degrees
FLOOR_COLUMNS = 80  # of the subsampled image in which the floor is searched
FLOOR_TOLERANCE = 0.04  # meters from the plane to a point on the floor
FLOOR_TRIALS = 512  # planes tried; a floor with a fifth of the points is missed once in 60 times
DRAWS = np.random.default_rng(0).random((FLOOR_TRIALS, 3))  # of points, as shares of all
SHIFT = (5**0.5 - 1) / 2  # of the draws from a frame to the next one; its multiples spread evenly
MIN_SUPPORT_KEPT = 0.8  # of the known floor's support, to conclude that the camera hasn't moved
MIN_FLOOR_SUPPORT = 0.06  # of all points, on a new floor
MAX_BELOW_FLOOR = 0.03  # of all points, below a new floor
# The standard deviation of a new floor's points in its narrower direction: strips of people had up to 0.11 m,
# and up to 0.055 of the distance from 1 m on; floors and tables have from 0.18 m, and mostly from 0.15 of it.
MIN_FLOOR_SPREAD = 0.12  # meters
MIN_RELATIVE_SPREAD = 0.07  # of the mean distance


def floor_step(columns: int) -> int:
    """The subsampling step, pixels, for the floor search in an image with this many columns."""
    return max(1, round(columns / FLOOR_COLUMNS))


def is_supported(plane: Floats, support: float) -> bool:
    """Whether a plane (6,) is still the floor, given its share of a frame's points."""
    return plane.item(4) > 0 and support >= MIN_SUPPORT_KEPT * plane.item(4)


def find_floor(
    k: Kernels,
    depth: Depth,
    camera: Floats,
    known: Floats,
    support: float,
    number: int,
    near: float,
) -> Floats:
    """The plane (6,) with large support and hardly any points below it.

    known: the last frame's plane, or NO_FLOOR. support: the share of this frame's points on it. It is kept
    unless this frame has a better one. camera: (4,) of this image. number: the frame's; in another one other
    planes are tried. near: the smallest depth used, meters.

    A plane is its unit normal, its distance from the camera, and the shares of points on it and below it.
    """
    step = floor_step(depth.shape[1])
    coarse = depth[::step, ::step]
    # Points within the tolerance of the camera would lie on any plane through it.
    coarse = np.where(coarse >= near, coarse, np.float32(np.nan))
    # The lower half of the image, which has most of the floor.
    lower = coarse.size // 2 + np.flatnonzero(np.isfinite(coarse.reshape(-1)[coarse.size // 2 :]))
    if len(lower) < 3:
        return known
    triples = lower[((DRAWS + number * SHIFT) % 1.0 * len(lower)).astype(np.int64)]
    plane = k.floor_plane(coarse, camera / step, triples, FLOOR_TOLERANCE, UP, MIN_FLOOR_COSINE)
    least = support if known.item(4) > 0 else 0.0
    accepted = plane[4] > max(MIN_FLOOR_SUPPORT, least) and plane[5] < MAX_BELOW_FLOOR
    return plane if accepted and is_wide(plane, coarse, camera / step) else known


def is_wide(plane: Floats, depth: Depth, camera: Floats) -> bool:
    """Whether the points on a plane spread in both of its directions.

    Those of a strip don't, such as the hips of somebody of whom alone there is depth.
    """
    v, u = np.nonzero(np.isfinite(depth))
    z = depth[v, u].astype(np.float64)
    fx, fy, cx, cy = camera.tolist()
    points = np.array([(u - cx) / fx * z, (v - cy) / fy * z, z])
    nx, ny, nz, distance = plane[:4].tolist()
    height = nx * points[0] + ny * points[1] + nz * points[2] + distance
    on = points[:, np.abs(height) <= FLOOR_TOLERANCE]
    _, narrower, _ = np.linalg.eigvalsh(np.cov(on))
    away = float(np.linalg.norm(on.mean(axis=1)))
    return bool(narrower >= max(MIN_FLOOR_SPREAD, MIN_RELATIVE_SPREAD * away) ** 2)
