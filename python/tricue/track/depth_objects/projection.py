# SPDX-License-Identifier: MIT
"""Projection between upright rectangles in meters and boxes in pixels.

A state (5,) is a rectangle in the camera frame: X, Y, Z of its center, width and height, meters.
A camera (4,) is fx, fy, cx, cy, pixels.
"""

import numpy as np

from tricue.arrays import Floats
from tricue.camera.box import Box


def project_rectangle(state: Floats, camera: Floats) -> list[float]:
    """Center x, y, width and height in pixels, and depth in meters, of a state (5,) in a camera (4,).

    Box coordinates: (0, 0) is the corner of the first pixel, not its center.
    """
    x, y, z, width, height = state.tolist()
    fx, fy, cx, cy = camera.tolist()
    per_x, per_y = fx / z, fy / z
    return [x * per_x + (cx + 0.5), y * per_y + (cy + 0.5), width * per_x, height * per_y, z]


def project_box(state: Floats, camera: Floats) -> Box:
    """The box, pixels, of a state (5,) in a camera (4,)."""
    x, y, width, height, _ = project_rectangle(state, camera)
    return Box(x - width / 2, y - height / 2, width, height)


def back_project_box(box: Box, z: float, camera: Floats) -> Floats:
    """The state (5,) at depth z, meters, that a camera (4,) projects to this box.

    The inverse of :func:`project_box`.
    """
    fx, fy, cx, cy = camera.tolist()
    x, y = box.center
    return np.array(
        [(x - 0.5 - cx) * z / fx, (y - 0.5 - cy) * z / fy, z, box.width * z / fx, box.height * z / fy]
    )
