# SPDX-License-Identifier: MIT
"""Where the target is believed to be, and the part of a frame round it that the experts look at."""

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.track.fused.sight import Around, Image, Plane, Sight

CELLS = 32  # a side of the window
PIXELS = 2 * CELLS  # a side of its patch
AROUND = 5.0  # of a target's side


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
        return Target(self.x + right, self.y + down, self.width, self.height)

    @property
    def around(self) -> Around:
        """What may be looked at to find it: its window, those beside it, and their own."""
        return self.x, self.y, AROUND * self.side

    def scaled(self, factor: float) -> "Target":
        """As large as that, in the same place."""
        return Target(self.x, self.y, float(self.width * factor), float(self.height * factor))


class View:
    """A square window of a frame round a target; what experts read of it is worked out once, when asked for.

    patch: (64, 64, 3) BGR. unit: image pixels a patch pixel. target: as it was believed when looking.
    """

    def __init__(self, sight: Sight, target: Target, patch: Image, unit: float) -> None:
        self.sight, self.target, self.patch, self.unit = sight, target, patch, unit
        self.size = target.width / unit, target.height / unit  # of the target, patch pixels

    @cached_property
    def cells(self) -> Plane:
        """(11, 32, 32) orientations and colors, fading out towards the window's edge."""
        return self.sight.k.gradient_color_cells(self.patch, TAPER)

    @cached_property
    def colors(self) -> Image:
        """(1, 3, 4096) samples of the patch."""
        return np.ascontiguousarray(self.patch.reshape(-1, 3).T)[None]

    @cached_property
    def depth(self) -> tuple[Plane, NDArray[np.uint8]] | None:
        """(64, 64) P(target | depth), 0.5 where there is none, and 1 where something is nearer, else 0."""
        x, y = self.target.x - PIXELS / 2 * self.unit, self.target.y - PIXELS / 2 * self.unit
        return self.sight.depths(x, y, self.unit, PIXELS)

    def inner(self, right: float = 0.0, down: float = 0.0, share: float = 1.0) -> tuple[slice, slice]:
        """Rows and columns of the patch that a target so many patch pixels off the middle covers, or the
        inner share of it; at least one of each.
        """
        return _span(PIXELS / 2 + down, share * self.size[1]), _span(PIXELS / 2 + right, share * self.size[0])


def look(sight: Sight, targets: list[Target], context: float) -> list[View]:
    """The views of some targets; context: side of a window in sides of its target."""
    sides = [context * each.side for each in targets]
    windows = np.array([(t.x - s / 2, t.y - s / 2, s, s) for t, s in zip(targets, sides, strict=True)])
    patches = sight.k.sample_windows(sight.picture, windows, PIXELS, PIXELS)
    return [View(sight, *each) for each in zip(targets, patches, [s / PIXELS for s in sides], strict=True)]


def _span(middle: float, length: float) -> slice:
    first = min(max(round(middle - length / 2), 0), PIXELS - 1)
    return slice(first, max(min(round(middle + length / 2), PIXELS), first + 1))


def _taper() -> Plane:
    """Hann's window, so that a patch has no edges."""
    bell: NDArray[np.float64] = np.sin(np.pi * (np.arange(CELLS) + 0.5) / CELLS) ** 2
    return np.outer(bell, bell).astype(np.float32)


TAPER = _taper()
