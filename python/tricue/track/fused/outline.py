# SPDX-License-Identifier: MIT
"""How far the target reaches from its middle, by what is at its depth: the box that is told, not the one that
its look is measured in.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.view import PIXELS, Target, View

FILLED = 0.45  # mean P(target | depth) along a line through it, as far as it reaches: half of its most
CENTRAL = 0.25  # of the box, whose rows and columns are followed outwards
COVERED = 0.05  # of the box, by what is nearer: then its outline isn't seen
LEAST, MOST = 0.3, 3.0  # of the half width or height


class Outline(NamedTuple):
    """Distances of the sides from the target's middle, in halves of its width and height."""

    left: float = 1.0
    top: float = 1.0
    right: float = 1.0
    bottom: float = 1.0

    def around(self, target: Target) -> Target:
        """The target with these sides."""
        across, down = target.width / 2, target.height / 2
        left, right = target.x - self.left * across, target.x + self.right * across
        top, bottom = target.y - self.top * down, target.y + self.bottom * down
        return Target((left + right) / 2, (top + bottom) / 2, right - left, bottom - top)

    def moved(self, seen: "Outline", rate: float) -> "Outline":
        """With what was seen blended in."""
        return Outline(*(old + rate * (new - old) for old, new in zip(self, seen, strict=True)))


WHOLE = Outline()


def outline(view: View, right: float, down: float, hidden: float) -> Outline | None:
    """What depth shows so many patch pixels off a view's middle; None where it doesn't, or something nearer
    hides a part of the box.
    """
    ranger = view.sight.ranger
    if view.depth is None or ranger is None or not ranger.sharp or hidden > COVERED:
        return None
    own = view.depth[0]
    rows, columns = view.inner(right, down, CENTRAL)
    x, y = PIXELS / 2 + right, PIXELS / 2 + down
    sides = (*_reach(own[rows].mean(axis=0), x), *_reach(own[:, columns].mean(axis=1), y))
    if None in sides:
        return None
    half = [each / 2 for each in (view.size[0], view.size[0], view.size[1], view.size[1])]
    left, far, top, bottom = (
        min(max(float(side or 0) / length, LEAST), MOST) for side, length in zip(sides, half, strict=True)
    )
    return Outline(left, top, far, bottom)


def _reach(filled: NDArray[np.floating], middle: float) -> tuple[float | None, float | None]:
    """How far it goes on filled before and after a place; None up to the edge, or where it doesn't start."""
    at = min(max(int(middle), 0), len(filled) - 1)
    empty = np.flatnonzero(filled < FILLED)
    before, after = empty[empty <= at], empty[empty > at]
    if not len(before) or not len(after) or before[-1] == at:
        return None, None
    return middle - _crossing(filled, before[-1]), _crossing(filled, after[0] - 1) - middle


def _crossing(filled: NDArray[np.floating], index: int) -> float:
    """Where it is half filled between the middles of a pixel and the next."""
    first, second = float(filled[index]), float(filled[index + 1])
    return index + 0.5 + (FILLED - first) / (second - first)
