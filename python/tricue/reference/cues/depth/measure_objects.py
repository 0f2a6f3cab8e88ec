# SPDX-License-Identifier: MIT
"""Segmented objects in meters, extended down to the floor that they stand on."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import require_camera, require_table

Shares = NDArray[np.float32]


ObjectTable = tuple[Floats, Shares, Shares, NDArray[np.bool_]]  # table, columns, rows, cut
Ground = tuple[Floats, float]  # plane, feet


def measure_objects(objects: ObjectTable, camera: Floats, ground: Ground) -> Floats:
    """Back-projects the boxes, and extends those that stand on the floor."""
    _require(objects, camera, ground)
    (table, columns, rows, cut), (plane, _) = objects, ground
    fx, fy, cx, cy = camera
    x, y, w, h, pixels, z, _ = table.T
    width, height = w * z / fx, h * z / fy
    center_x, center_y = (x + w / 2 - 0.5 - cx) * z / fx, (y + h / 2 - 0.5 - cy) * z / fy
    shift_x, shift_y = (_mean_place(shares) * size for shares, size in ((columns, width), (rows, height)))

    centers = np.column_stack([center_x, center_y, z])
    strip = np.where(cut[:, 3], 0.0, _strips_to_floor(centers, height, ground))
    if plane.any():
        shift_y = _mean_below(centers, height, strip, rows, plane[:3]) - strip / 2
    return np.column_stack(
        [center_x, center_y + strip / 2, z, width, height + strip, shift_x, shift_y, pixels * z * z / fx / fy]
    )


def _strips_to_floor(centers: Floats, height: Floats, ground: Ground) -> Floats:
    """The lengths from the lower edges down to the floor, at the depths of the centers (C, 3).

    0 for an object that doesn't stand on the floor.
    """
    plane, feet = ground
    strips, up = np.zeros(len(centers)), plane[:3]
    if not plane.any():
        return strips
    ahead = np.array([0.0, 0.0, 1.0]) - up[2] * up
    for i, center in enumerate(centers):
        edge = center + [0.0, height[i] / 2, 0.0]
        if ahead @ edge <= 0:
            continue
        lowest = edge * (ahead @ center) / (ahead @ edge)
        above = up @ lowest + plane[3]
        stand = lowest - above * up
        if 0 < above < feet and stand[2] > 0:
            strips[i] = max(stand[1] * center[2] / stand[2] - edge[1], 0.0)
    return strips


def _mean_below(centers: Floats, height: Floats, strip: Floats, rows: Shares, up: Floats) -> Floats:
    """How far the mean of upright objects' points is below their centers (C, 3), each row at its own depth.
    The strip is filled like the rest.
    """
    ahead, bins = np.array([0.0, 0.0, 1.0]) - up[2] * up, rows.shape[1]
    ends = np.column_stack([-height / 2, height / 2 + strip])
    down = np.column_stack([np.outer(height, (np.arange(bins) + 0.5) / bins - 0.5), (height + strip) / 2])
    y, first_and_last = (centers[:, 1:2] + each for each in (down, ends))
    level = centers[:, :1] * ahead[0] + centers[:, 2:] * ahead[2]
    in_front = (level + first_and_last * ahead[1] > 0).all(axis=1)
    nearness = np.where(in_front[:, None], level + y * ahead[1], centers[:, 2:])
    depths = rows / nearness[:, :-1]
    share, total = strip / (height + strip), depths.sum(axis=1)
    below = (1 - share) * (depths * y[:, :-1]).sum(axis=1) + share * y[:, -1] / nearness[:, -1]
    empty = ~(total > 0)
    return np.where(empty, strip / 2, below / np.where(empty, 1, total) - centers[:, 1])


def _mean_place(shares: Shares) -> Floats:
    """The mean places of distributions over equal parts of [-1/2, 1/2]."""
    bins = shares.shape[1]
    mean: Floats = shares.astype(np.float64) @ ((np.arange(bins) + 0.5) / bins - 0.5)
    return mean


def _require(objects: ObjectTable, camera: Floats, ground: Ground) -> None:
    (table, columns, rows, cut), (plane, feet) = objects, ground
    require_camera(camera)
    require_table(table)
    for name, each in (("columns", columns), ("rows", rows), ("cut", cut)):
        if len(each) != len(table):
            refuse(name, f"{len(table)} rows", len(each))
    for name, shares in (("columns", columns), ("rows", rows)):
        require_finite(name, shares.astype(np.float64))
    require_shape("plane", plane, (4,))
    require_finite("plane", plane)
    if not 0 <= feet < np.inf:
        refuse("feet", "a finite number, not negative", float(feet))
