# SPDX-License-Identifier: MIT
"""A stereo pair that turns about the vertical with constant angular velocity.

Level frame: fixed to the room, the left camera at its origin; x right, y down, z forward, metres. The pair
turns about the left camera's centre, so that what stands still keeps its disparity but for its angle.
"""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.rig import StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.people.body import rotation_about_y


class Pan(NamedTuple):
    """Where the pair looks, frame by frame."""

    rig: StereoRig
    height: float  # of the cameras above the floor, metres
    angles: Array  # (M,) of where the pair looks, radians from z towards x

    def to_camera(self, index: int) -> Array:
        """The rotation (3, 3) from the level frame to the left camera's."""
        return rotation_about_y(-float(self.angles[index]))

    def on_floor(self, column: Array, depth: Array) -> Array:
        """The places (M, 2), x and z of the level frame, seen at a column and a depth z in each frame.

        column: as a share of the focal length right of the principal point, (X / Z in the camera's frame).
        """
        sin, cos = np.sin(self.angles), np.cos(self.angles)
        return np.stack([(cos * column + sin) * depth, (cos - sin * column) * depth], axis=1)

    @property
    def reach(self) -> tuple[float, float]:
        """The leftmost and the rightmost angle that the left camera ever sees, radians."""
        half = math.atan(self.rig.intrinsics.width / 2 / self.rig.intrinsics.fx)
        return float(self.angles.min()) - half, float(self.angles.max()) + half
