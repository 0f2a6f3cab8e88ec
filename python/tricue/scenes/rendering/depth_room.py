# SPDX-License-Identifier: MIT
"""A room with furniture, as geometry for a depth camera."""

from typing import NamedTuple


class Furniture(NamedTuple):
    """An upright box on the floor, meters in the level frame; see tricue.scenes.rendering.depth_view."""

    x: float
    z: float
    width: float
    depth: float
    height: float
    yaw: float  # radians about the vertical


class Room(NamedTuple):
    """A room around the camera, which stands at the origin; meters in the level frame."""

    wall: float  # depth z of the back wall
    side: float  # distance of the left and the right wall
    height: float  # from floor to ceiling
    furniture: tuple[Furniture, ...] = ()
