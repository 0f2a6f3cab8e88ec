# SPDX-License-Identifier: MIT
"""A stereo rig that pans about the vertical.

The level frame is fixed to the room, with the left camera at its origin: x right, y down, z forward, meters.
The rig rotates about the left camera's center.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.rig import StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.people.body import rotation_about_y


class Pan(NamedTuple):
    """The rig, and the direction in which it looks in each of M frames."""

    rig: StereoRig
    height: float  # of the cameras above the floor, meters
    angles: Array  # (M,) radians from z toward x
    tilt: float = 0.0  # radians upwards, after the pan

    def to_camera(self, index: int) -> Array:
        """The rotation (3, 3) from the level frame to the left camera's frame."""
        pan = rotation_about_y(-float(self.angles[index]))
        if not self.tilt:
            return pan
        cos, sin = math.cos(self.tilt), math.sin(self.tilt)
        return np.array([[1, 0, 0], [0, cos, sin], [0, -sin, cos]]) @ pan

    def on_floor(self, column: Array, depth: Array) -> Array:
        """The floor positions (M, 2), x and z in the level frame, at a column and a depth in each frame.

        column: X / Z in the camera's frame. depth: z in the camera's frame, meters.
        """
        sin, cos = np.sin(self.angles), np.cos(self.angles)
        return np.stack([(cos * column + sin) * depth, (cos - sin * column) * depth], axis=1)

    @property
    def reach(self) -> tuple[float, float]:
        """The leftmost and the rightmost angle that the left camera sees in any frame, radians."""
        half = math.atan(self.rig.intrinsics.width / 2 / self.rig.intrinsics.fx)
        return float(self.angles.min()) - half, float(self.angles.max()) + half
