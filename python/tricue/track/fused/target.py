# SPDX-License-Identifier: MIT
"""The target's place and size in the image."""

import math
from typing import NamedTuple

from tricue.camera.box import Box


class Target(NamedTuple):
    """Center, width and height in pixels of the image."""

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def of(cls, box: Box) -> "Target":
        """The center and size of a box."""
        return cls(*box.center, box.width, box.height)

    @property
    def box(self) -> Box:
        """The same as a box."""
        return Box(self.x - self.width / 2, self.y - self.height / 2, self.width, self.height)

    @property
    def side(self) -> float:
        """Side of the square with the target's area, in pixels."""
        return math.sqrt(self.width * self.height)

    def shift(self, right: float, down: float) -> "Target":
        """The target so many pixels farther right and down."""
        return Target(self.x + right, self.y + down, self.width, self.height)

    def scale(self, factor: float) -> "Target":
        """The target with its sides multiplied, around the same center."""
        return Target(self.x, self.y, float(self.width * factor), float(self.height * factor))
