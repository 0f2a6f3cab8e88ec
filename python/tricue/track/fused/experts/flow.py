# SPDX-License-Identifier: MIT
"""How the target's own pixels moved since the last frame: how much it grew."""

from typing import NamedTuple

import cv2

from tricue.track.fused.sight import Image
from tricue.track.fused.view import PIXELS, View

HALF = 20  # patch pixels, of the part round the target that flow is measured in
SIGMA, LEVELS, POOL = 1.0, 2, 2  # of the flow: pixels, of its filters; levels; radius of its windows
MIN_ANGLE, MIN_CONTRAST = 0.05, 4.0  # its least reliability
LEAST = 30  # pixels of the target that flow has to be measured at
INNER = 0.8  # of the box, whose pixels are the target's
OUTLIERS = 2.5  # standard deviations
LOOSE = 0.15  # patch pixels, standard deviation beyond which the motion isn't a rigid one


class Glance(NamedTuple):
    """What flow remembers of a frame: (41, 41) gray round the target, and image pixels a pixel of it."""

    gray: Image
    unit: float

    @classmethod
    def at(cls, view: View, right: float, down: float) -> "Glance":
        """Of a target so many patch pixels off the view's middle."""
        i, j = (PIXELS // 2 - HALF + round(each) for each in (down, right))
        reach = PIXELS - 2 * HALF - 1
        i, j = min(max(i, 0), reach), min(max(j, 0), reach)
        part = view.patch[i : i + 2 * HALF + 1, j : j + 2 * HALF + 1]
        return cls(cv2.cvtColor(part, cv2.COLOR_BGR2GRAY), view.unit)  # type: ignore[arg-type]


def growth(before: Glance, now: Glance, view: View) -> float | None:
    """How many times as large as in the last frame the target is, by a similarity fitted to the flow of its
    pixels; None where that tells nothing.
    """
    width, height = (min(INNER * each / 2, HALF - 1.0) for each in view.size)
    left, top = max(HALF - round(width), 0), max(HALF - round(height), 0)
    region = left, top, 2 * HALF + 1 - left, 2 * HALF + 1 - top
    u, v, _, _ = view.sight.k.pyramid_flow(
        before.gray, now.gray, SIGMA, LEVELS, MIN_ANGLE, MIN_CONTRAST, region, POOL
    )
    shrunk, spread, _ = view.sight.k.flow_scale(u, v, OUTLIERS, LEAST)
    rigid = 0.5 < shrunk < 2 and spread < 2 * LOOSE**2
    return now.unit / before.unit / shrunk if rigid else None
