# SPDX-License-Identifier: MIT
"""How far away the target is: its pixels are told by that, its size, and what hides it."""

import math
from typing import NamedTuple

import numpy as np

from tricue.track.fused.sight import Expected, Plane, Sight
from tricue.track.fused.view import Target, View

GRID = 48  # samples a side, of which a target's depth is measured
LEAST = 0.1  # of them have to be measured
NARROW, WIDE = 0.04, 0.4  # metres, of a target's relief
CENTRAL = 0.5  # of the box, which a target that isn't known yet surely fills
NEAREST, FARTHEST = 0.001, 1000.0  # metres; beyond them nothing is measured, whatever is said
REACH = 0.5  # metres round the most common depth there
TO_SIGMA = 1.4826  # from the median of distances, of normal noise


class DepthExpert(NamedTuple):
    """relief: metres, standard deviation of the target's surface. length: metres, side of the square as large
    as it, if it is flat.
    """

    relief: float
    length: float

    def opinion(self, view: View) -> Plane | None:
        """(64, 64) P(target | depth)."""
        return None if view.depth is None else view.depth[0]

    def learnt(self, measured: "Measured", length: float, rate: float) -> "DepthExpert":
        """With what was measured blended in."""
        relief = min(max(measured.spread, NARROW), WIDE)
        return DepthExpert(
            self.relief + rate * (relief - self.relief), self.length * (length / self.length) ** rate
        )


class Measured(NamedTuple):
    """Metres: median depth of a target's pixels, their spread; share: of its box, that is measured."""

    z: float
    spread: float
    share: float


def measure(sight: Sight, target: Target, expected: Expected | None) -> Measured | None:
    """The depth of what is in a target's box, near what is expected; where that is nothing or unsure, of
    its middle.
    """
    if sight.ranger is None:
        return None
    if expected is not None and expected.sigma > REACH:
        expected = None
    side = CENTRAL * target.side if expected is None else max(target.width, target.height)
    unit = side / GRID
    metres = sight.ranger.metres((target.x - side / 2, target.y - side / 2, unit), GRID, expected)
    if expected is None:
        inside = (metres > NEAREST) & (metres < FARTHEST)
        middle = float(np.median(metres[inside])) if inside.any() else math.nan
        around, reach = middle, REACH
    else:
        steps = np.abs((np.arange(GRID) + 0.5) / GRID - 0.5) * 2 * side
        inside = (steps[:, None] / target.height) ** 2 + (steps / target.width) ** 2 <= 1
        around = expected.z
        reach = 3 * math.hypot(expected.sigma, sight.ranger.noise(expected.z, unit))
    chosen = metres[inside & (np.abs(metres - np.float32(around)) < reach)]
    if len(chosen) < LEAST * np.count_nonzero(inside) or not len(chosen):
        return None
    z = float(np.median(chosen))
    return Measured(
        z, TO_SIGMA * float(np.median(np.abs(chosen - z))), len(chosen) / np.count_nonzero(inside)
    )
