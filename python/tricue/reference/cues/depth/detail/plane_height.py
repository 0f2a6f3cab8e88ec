# SPDX-License-Identifier: MIT
"""The height of every pixel of a depth image above a plane: for above_floor and plane_support."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import require_finite, require_shape
from tricue.reference.base.depth_pixels import has_depth, rays


def height_above(
    depth: NDArray[np.float32], camera: NDArray[np.float64], plane: NDArray[np.float64]
) -> NDArray[np.float32]:
    """(H, W) n · X + d in meters, in float32 throughout; NaN where nothing was measured."""
    x, y = rays(camera, depth)
    require_shape("plane", plane, (4,))
    require_finite("plane", plane)
    with np.errstate(over="ignore", invalid="ignore"):
        nx, ny, nz, d = plane.astype(np.float32)
        height: NDArray[np.float32] = depth * (nx * x + (ny * y + nz)[:, None]) + d
    return np.where(has_depth(depth), height, np.float32(np.nan))
