# SPDX-License-Identifier: MIT
"""The floor of a depth image by RANSAC and least squares."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import has_depth, rays

Points = NDArray[np.float32]
FittedPlane = tuple[Floats, float]

ROUNDS = 3
LINE_SQUARED = 1e-4  # square of the smallest sine between two edges of a triple
EDGE_ON = 1e-3  # smallest sine between a plane and the line of sight to its point


def floor_plane(
    depth: NDArray[np.float32],
    camera: Floats,
    triples: NDArray[np.int64],
    tolerance: float,
    up: Floats,
    min_cosine: float,
) -> Floats:
    """Scores the plane of every triple, then fits the best one by least squares."""
    x, y = rays(camera, depth)
    _check(depth, triples, tolerance, up, min_cosine)
    with np.errstate(over="ignore", invalid="ignore"):
        everywhere = np.stack([x * depth, y[:, None] * depth, depth], axis=-1)
        everywhere[~has_depth(depth)] = np.nan
        everywhere = everywhere.reshape(-1, 3)
        points = everywhere[np.isfinite(everywhere[:, 2])]
        best, score = None, 0
        for p, q, r in everywhere[triples].astype(np.float64):
            plane = _plane_through(p, q, r, up, min_cosine)
            if plane is not None:
                within, below = _relations(points, plane, tolerance)
                its = np.count_nonzero(within) - 3 * np.count_nonzero(below)
                if its > score:
                    best, score = plane, its
        if best is None:
            return np.zeros(6)
        for _ in range(ROUNDS):
            best = _fit(points[_relations(points, best, tolerance)[0]], up, min_cosine) or best
        within, below = _relations(points, best, tolerance)
        return np.array([*best[0], best[1], within.mean(), below.mean()])


def _check(
    depth: NDArray[np.float32], triples: NDArray[np.int64], tolerance: float, up: Floats, min_cosine: float
) -> None:
    if not 0 < tolerance < np.inf:
        refuse("tolerance", "a finite number above 0", float(tolerance))
    require_shape("up", up, (3,))
    require_finite("up", up)
    length = np.sqrt(_dot(up, up))
    if not abs(length - 1) <= 1e-6:
        refuse("up", "a vector of length 1", float(length))
    if not -1 <= min_cosine <= 1:
        refuse("min_cosine", "a number in [-1, 1]", float(min_cosine))
    outside = triples[(triples < 0) | (triples >= depth.size)]
    if outside.size:
        refuse("triples", f"indices in [0, {depth.size})", outside[0])


def _relations(
    points: Points, plane: FittedPlane, tolerance: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which points are within ``tolerance`` of the plane, and which are more than 3 times that below it.

    In float32.
    """
    (nx, ny, nz), d = plane[0].astype(np.float32), np.float32(plane[1])
    x, y, z = points.T
    height = ((nx * x + ny * y) + nz * z) + d
    near = np.float32(tolerance)
    return abs(height) <= near, height < np.float32(-3) * near


def _plane_through(p: Floats, q: Floats, r: Floats, up: Floats, min_cosine: float) -> FittedPlane | None:
    """The plane through three points; None if they are nearly on a line or weren't measured."""
    a, b = q - p, r - p
    normal = np.cross(a, b)
    square = _dot(normal, normal)
    if not square > LINE_SQUARED * _dot(a, a) * _dot(b, b):
        return None
    return _level_plane(normal / np.sqrt(square), p, up, min_cosine)


def _fit(points: Points, up: Floats, min_cosine: float) -> FittedPlane | None:
    """The least-squares plane: through the mean, normal to the direction in which the points spread least."""
    if len(points) < 3:
        return None
    mean = points.mean(axis=0, dtype=np.float64)
    spread = points - mean
    _, vectors = np.linalg.eigh(spread.T @ spread)
    return _level_plane(vectors[:, 0], mean, up, min_cosine)


def _level_plane(normal: Floats, point: Floats, up: Floats, min_cosine: float) -> FittedPlane | None:
    """The plane through a point, with its normal toward the camera; None if it isn't level enough, or is seen
    edge-on.
    """
    d = -_dot(normal, point)
    if d < 0:
        normal, d = -normal, -d
    seen = d > EDGE_ON * np.sqrt(_dot(point, point))
    return (normal, d) if seen and _dot(normal, up) >= min_cosine else None


def _dot(a: Floats, b: Floats) -> float:
    """The dot product, added up in the native kernel's order."""
    return float((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2])
