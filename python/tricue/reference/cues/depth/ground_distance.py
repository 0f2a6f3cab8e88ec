# SPDX-License-Identifier: MIT
"""Distances along the ground, measured by a tilted depth camera."""

import numpy as np

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.base.depth_pixels import require_camera

MIN_LEVEL = 1e-6  # length of the optical axis's component along the ground


def ground_distance(depth: Depth, camera: Floats, up: Floats, near: float, far: float) -> Depth:
    """Multiplies the depths by a factor per pixel, then clips."""
    require_camera(camera)
    require_shape("up", up, (3,))
    require_finite("up", up)
    length = _norm(up)
    if not abs(length - 1) <= 1e-6:
        refuse("up", "a vector of length 1", length)
    if not np.isfinite(near):
        refuse("near", "a finite number", float(near))
    if not (np.isfinite(far) and far > near):
        refuse("far", "a finite number above near", float(far))
    x, y, z = up
    ahead = np.array([-z * x, -z * y, x * x + y * y])  # not 1 - z²: up's length is only nearly 1
    level = _norm(ahead)
    if not level > MIN_LEVEL:
        refuse("up", "a direction across the view", "one along it")
    ahead /= level
    fx, fy, cx, cy = camera
    height, width = depth.shape
    right, down = (np.arange(width) - cx) / fx, (np.arange(height) - cy) / fy
    factors = np.add.outer(ahead[1] * down + ahead[2], ahead[0] * right).astype(np.float32)
    distance = depth * factors
    below = np.nextafter(np.float32(far), np.float32(0))
    clipped: Depth = np.minimum(np.maximum(distance, np.float32(near)), below)
    return clipped


def _norm(v: Floats) -> float:
    """The length, added up in the native kernel's order."""
    return float(np.sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]))
