# SPDX-License-Identifier: MIT
"""A room with furniture, as geometry for a depth camera."""

from typing import NamedTuple


class Furniture(NamedTuple):
    """An upright box on the floor; level frame, metres."""

    x: float
    z: float
    width: float
    depth: float
    height: float
    yaw: float  # radians about the vertical


class Room(NamedTuple):
    """The walls, level frame, metres; the camera stands at the origin."""

    wall: float  # depth of the back wall
    side: float  # distance of the walls to the left and right
    height: float  # floor to ceiling
    furniture: tuple[Furniture, ...] = ()
