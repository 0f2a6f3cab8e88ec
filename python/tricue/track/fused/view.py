# SPDX-License-Identifier: MIT
"""Where the target is believed to be, and the part of the image round it that the experts look at."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Plane = NDArray[np.float32]

CELLS = 32  # a side of the window
PIXELS = 2 * CELLS  # a side of its patch


class Target(NamedTuple):
    """Centre, width and height, pixels of the image."""

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def of(cls, box: Box) -> "Target":
        """The middle and size of a box."""
        return cls(*box.center, box.width, box.height)

    @property
    def box(self) -> Box:
        """The same as a box."""
        return Box(self.x - self.width / 2, self.y - self.height / 2, self.width, self.height)

    @property
    def side(self) -> float:
        """Of the square as large as the target."""
        return math.sqrt(self.width * self.height)

    def moved(self, right: float, down: float) -> "Target":
        """The same elsewhere."""
        return self._replace(x=self.x + right, y=self.y + down)

    def scaled(self, factor: float) -> "Target":
        """As large as that, in the same place."""
        return self._replace(width=float(self.width * factor), height=float(self.height * factor))


class View(NamedTuple):
    """A square window of the image round a target.

    patch: (64, 64, 3) BGR. unit: image pixels a patch pixel. target: as it was believed when looking.
    """

    image: Image
    patch: Image
    unit: float
    target: Target

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the target in patch pixels."""
        return self.target.width / self.unit, self.target.height / self.unit

    @property
    def colors(self) -> Any:
        """(1, 3, 4096) samples of the patch."""
        return np.ascontiguousarray(self.patch.reshape(1, -1, 3).transpose(0, 2, 1))


def look(k: Kernels, image: Image, targets: list[Target], context: float) -> list[View]:
    """The views of some targets; context: side of a window in sides of its target."""
    sides = [context * each.side for each in targets]
    windows = np.array([(t.x - s / 2, t.y - s / 2, s, s) for t, s in zip(targets, sides, strict=True)])
    patches = k.sample_windows(image, windows, PIXELS, PIXELS)
    return [
        View(image, patch, side / PIXELS, target)
        for patch, side, target in zip(patches, sides, targets, strict=True)
    ]
