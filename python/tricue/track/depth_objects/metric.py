# SPDX-License-Identifier: MIT
"""Upright rectangles in metres, X, Y, Z of the centre, width, height, and what a camera sees of them."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box

Floats = NDArray[np.float64]


def rectangle_of(state: Floats, camera: Floats) -> list[float]:
    """Centre x, y, width, height in pixels and depth of a state (5,), seen by a camera (4,) fx, fy, cx, cy.

    Box coordinates: (0, 0) is the first pixel's corner.
    """
    x, y, z, width, height = state.tolist()
    fx, fy, cx, cy = camera.tolist()
    per_x, per_y = fx / z, fy / z
    return [x * per_x + (cx + 0.5), y * per_y + (cy + 0.5), width * per_x, height * per_y, z]


def box_of(state: Floats, camera: Floats) -> Box:
    """The box that a camera (4,) sees of a state (5,)."""
    x, y, width, height, _ = rectangle_of(state, camera)
    return Box(x - width / 2, y - height / 2, width, height)


def state_of(box: Box, z: float, camera: Floats) -> Floats:
    """The state (5,) that a camera (4,) sees as this box, at the depth z: the inverse of :func:`box_of`."""
    fx, fy, cx, cy = camera.tolist()
    x, y = box.center
    return np.array(
        [(x - 0.5 - cx) * z / fx, (y - 0.5 - cy) * z / fy, z, box.width * z / fx, box.height * z / fy]
    )
