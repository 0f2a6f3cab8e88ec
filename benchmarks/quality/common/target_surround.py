# SPDX-License-Identifier: MIT
"""The surround of a target: what is at the same depth as the target, and the plane that it stands on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.rig import Intrinsics

Array = NDArray[np.float64]
SIDES = ("left", "right", "above", "below")
MIN_TOLERANCE, TOLERANCE = 0.1, 0.05
"""Meters, or share of the distance, within which something is at the same depth as the target."""
PLANE_TOLERANCE = 0.015
"""Share of the distance, within which points belong to a plane."""
PLANE_TRIES = 150
MIN_POINTS = 60


class Surround(NamedTuple):
    """What is around a target in a frame.

    same: shares of the measured pixels left, right, above and below, half a box wide, that are at the
    target's depth. unmeasured: share of the surround without depth. plane: share of the surround on its best
    plane. height: median distance of the target from that plane, meters.
    """

    same: tuple[float, float, float, float]
    unmeasured: float
    plane: float
    height: float


def look_around(depth: Array, box: Array, camera: Intrinsics) -> Surround | None:
    """The surround of a box (4,) in a depth image (H, W); None if the target's depth is unknown."""
    x, y, width, height = box.tolist()
    inner = _part(depth, x + width / 4, y + height / 4, width / 2, height / 2)
    known = inner[np.isfinite(inner)]
    if known.size < MIN_POINTS / 2:
        return None
    distance = float(np.median(known))
    tolerance = max(MIN_TOLERANCE, TOLERANCE * distance)
    sides = [
        _part(depth, *place)
        for place in (
            (x - width / 2, y, width / 2, height),
            (x + width, y, width / 2, height),
            (x, y - height / 2, width, height / 2),
            (x, y + height, width, height / 2),
        )
    ]
    left, right, above, below = (
        _share(np.abs(side[np.isfinite(side)] - distance) < tolerance) for side in sides
    )
    plane, high = _plane(depth, box, camera)
    return Surround(
        (left, right, above, below),
        _share(np.isnan(np.concatenate([side.ravel() for side in sides]))),
        plane,
        high,
    )


def motion(boxes: Array) -> Array:
    """The steps (n,) of boxes (N, 4) between frames in which both are known, in the boxes' sides."""
    middles, sides = boxes[:, :2] + boxes[:, 2:] / 2, np.sqrt(boxes[:, 2] * boxes[:, 3])
    steps = np.hypot(*np.diff(middles, axis=0).T) / sides[:-1]
    return np.asarray(steps[np.isfinite(steps)])


def _plane(depth: Array, box: Array, camera: Intrinsics) -> tuple[float, float]:
    """The share of the surround on the plane with the most points, and the target's distance from it."""
    x, y, width, height = box.tolist()
    v, u = np.indices(depth.shape)
    across, down = np.abs(u - x - width / 2) / width, np.abs(v - y - height / 2) / height
    known = np.isfinite(depth)
    around = known & (across < 1) & (down < 1) & ((across > 0.55) | (down > 0.55))
    inner = known & (across < 0.25) & (down < 0.25)
    if around.sum() < MIN_POINTS or not inner.any():
        return float("nan"), float("nan")
    points, target = (_points(depth, part, camera) for part in (around, inner))
    rng = np.random.default_rng(0)
    best, normal, offset = 0, np.zeros(3), 0.0
    for three in rng.integers(len(points), size=(PLANE_TRIES, 3)).tolist():
        a, b, c = points[three]
        cross = np.cross(b - a, c - a)
        size = float(np.linalg.norm(cross))
        if size < 1e-9:
            continue
        count = int((np.abs((points - a) @ cross / size) < PLANE_TOLERANCE * points[:, 2]).sum())
        if count > best:
            best, normal, offset = count, cross / size, float(a @ cross / size)
    return best / len(points), float(np.median(np.abs(target @ normal - offset)))


def _points(depth: Array, part: NDArray[np.bool_], camera: Intrinsics) -> Array:
    """The points (n, 3) of some pixels."""
    rows, columns = np.nonzero(part)
    return camera.back_project(columns, rows, depth[part])


def _part(image: Array, x: float, y: float, width: float, height: float) -> Array:
    rows, columns = image.shape
    top, bottom = (int(np.clip(round(at), 0, rows)) for at in (y, y + height))
    left, right = (int(np.clip(round(at), 0, columns)) for at in (x, x + width))
    return image[top:bottom, left:right]


def _share(flags: NDArray[np.bool_]) -> float:
    return float(flags.mean()) if flags.size else float("nan")
