# SPDX-License-Identifier: MIT
"""What the twins of the depth cue share: which pixels were measured, and where they are."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_finite, require_shape

Depth = NDArray[np.float32]


def has_depth(depth: Depth) -> NDArray[np.bool_]:
    """Where something was measured: above 0 and finite."""
    return (depth > 0) & (depth < np.inf)


def rays(camera: NDArray[np.float64], depth: Depth) -> tuple[Depth, Depth]:
    """x (W,), y (H,): the pixel (u, v) at depth z is (x[u] z, y[v] z, z). Computed in float64, kept in
    float32.
    """
    require_camera(camera)
    fx, fy, cx, cy = camera
    height, width = depth.shape
    with np.errstate(over="ignore"):
        x, y = (np.arange(width) - cx) / fx, (np.arange(height) - cy) / fy
        return x.astype(np.float32), y.astype(np.float32)


def require_camera(camera: NDArray[np.float64]) -> None:
    """Refuse what isn't fx, fy above 0, cx, cy."""
    require_shape("camera", camera, (4,))
    require_finite("camera", camera)
    for focal_length in camera[:2]:
        if not focal_length > 0:
            refuse("camera", "focal lengths above 0", float(focal_length))


def require_table(table: NDArray[np.float64]) -> None:
    """Refuse what depth_components doesn't give of objects that were measured."""
    require_shape("table", table, (len(table), 7))
    require_finite("table", table)
    for _, _, width, height, _, depth, _ in table:
        for size in (width, height):
            if not size > 0:
                refuse("table", "sizes above 0", float(size))
        if not depth > 0:
            refuse("table", "depths above 0", float(depth))
