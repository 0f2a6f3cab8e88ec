# SPDX-License-Identifier: MIT
"""The target's place, size and turn in the image."""

import math
from typing import NamedTuple

from tricue.camera.box import Box

TURN_STEPS = 1024  # of a full turn


class Target(NamedTuple):
    """Center, width and height in pixels of the image.

    turn: clockwise rotation of the axes along which width and height are measured, in steps of 1/1024 of a
    full turn, from -512 to 511.
    """

    x: float
    y: float
    width: float
    height: float
    turn: int = 0

    @classmethod
    def of(cls, box: Box) -> "Target":
        """The target in a box."""
        return cls(*box.center, box.width, box.height)

    @property
    def box(self) -> Box:
        """The target's box before it is turned around its center."""
        return Box(self.x - self.width / 2, self.y - self.height / 2, self.width, self.height)

    @property
    def side(self) -> float:
        """Side of the square with the target's area, in pixels."""
        return math.sqrt(self.width * self.height)

    @property
    def upright(self) -> "Target":
        """The smallest target without a turn that contains this one's ellipse."""
        if not self.turn:
            return self
        across, down = axes(self.turn)
        width = math.hypot(self.width * across, self.height * down)
        height = math.hypot(self.width * down, self.height * across)
        return Target(self.x, self.y, width, height)

    def at(self, x: float, y: float) -> "Target":
        """The target with its center elsewhere."""
        return Target(x, y, self.width, self.height, self.turn)

    def shift(self, right: float, down: float) -> "Target":
        """The target moved so many pixels to the right and down in the image."""
        return self.at(self.x + right, self.y + down)

    def along(self, right: float, down: float) -> tuple[float, float]:
        """The shift in the image, right and down, for a shift in pixels along the target's own axes."""
        cosine, sine = axes(self.turn)
        return cosine * right - sine * down, sine * right + cosine * down

    def scale(self, factor: float) -> "Target":
        """The target with its sides multiplied, around the same center."""
        return Target(self.x, self.y, float(self.width * factor), float(self.height * factor), self.turn)

    def turn_by(self, steps: float) -> "Target":
        """The target turned clockwise around its center, to the nearest step."""
        half = TURN_STEPS // 2
        turn = (self.turn + round(steps) + half) % TURN_STEPS - half
        return Target(self.x, self.y, self.width, self.height, turn)


def axes(turn: int) -> tuple[float, float]:
    """Cosine and sine of a turn."""
    angle = math.tau * turn / TURN_STEPS
    return math.cos(angle), math.sin(angle)
