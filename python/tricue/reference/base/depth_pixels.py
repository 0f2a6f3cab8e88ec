# SPDX-License-Identifier: MIT
"""Shared by the twins of the depth cue: which pixels were measured, and where they are in space."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import refuse, require_finite, require_shape


def has_depth(depth: Depth) -> NDArray[np.bool_]:
    """Where something was measured: above 0 and finite."""
    return (depth > 0) & (depth < np.inf)


def rays(camera: NDArray[np.float64], depth: Depth) -> tuple[Depth, Depth]:
    """x (W,), y (H,): the pixel (u, v) at depth z is the point (x[u] z, y[v] z, z).

    Computed in float64, rounded to float32.
    """
    require_camera(camera)
    fx, fy, cx, cy = camera
    height, width = depth.shape
    with np.errstate(over="ignore"):
        x, y = (np.arange(width) - cx) / fx, (np.arange(height) - cy) / fy
        return x.astype(np.float32), y.astype(np.float32)


def require_camera(camera: NDArray[np.float64]) -> None:
    """Refuse anything but finite fx, fy, cx, cy with focal lengths above 0."""
    require_shape("camera", camera, (4,))
    require_finite("camera", camera)
    for focal_length in camera[:2]:
        if not focal_length > 0:
            refuse("camera", "focal lengths above 0", float(focal_length))


def require_table(table: NDArray[np.float64]) -> None:
    """Refuse anything but a table of depth_components in which all objects have a size and a depth."""
    require_shape("table", table, (len(table), 7))
    require_finite("table", table)
    for _, _, width, height, _, depth, _ in table:
        for size in (width, height):
            if not size > 0:
                refuse("table", "sizes above 0", float(size))
        if not depth > 0:
            refuse("table", "depths above 0", float(depth))
