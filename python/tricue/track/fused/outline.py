# SPDX-License-Identifier: MIT
"""How far the target extends from its center, by what is at its depth.

The outline gives the box that a track reports. The target's own box, in which its appearance is measured,
keeps its aspect ratio.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.params import Params, parameter
from tricue.track.fused.sources import OURS
from tricue.track.fused.target import Target
from tricue.track.fused.window import PATCH_PIXELS, Window

MIN_FILLED_POSTERIOR = 0.45  # mean P(target | depth) along a row or column of the target: half of its maximum
OUTLINE_CENTER_SHARE = 0.25  # of the box's sides: the rows and columns that are followed outwards
MAX_COVERED_BY_OCCLUDER = 0.05  # of the box, above which its outline can't be measured
MIN_OUTLINE_SIDE, MAX_OUTLINE_SIDE = 0.3, 3.0  # of half the width or height


@dataclass(frozen=True, kw_only=True)
class OutlineParams(Params):
    """Of the outline."""

    outline_time_constant: float = parameter(
        0.5,
        unit="s",
        source=OURS,
        above=0,
        doc="with which the box's sides follow the outline",
        was="outline_time",
    )


class Outline(NamedTuple):
    """Distances of the sides from the target's center, in halves of its width and height."""

    left: float = 1.0
    top: float = 1.0
    right: float = 1.0
    bottom: float = 1.0

    def apply_to(self, target: Target) -> Target:
        """The target with these sides."""
        half_width, half_height = target.width / 2, target.height / 2
        left, right = target.x - self.left * half_width, target.x + self.right * half_width
        top, bottom = target.y - self.top * half_height, target.y + self.bottom * half_height
        return Target((left + right) / 2, (top + bottom) / 2, right - left, bottom - top)

    def blend(self, measured: "Outline", rate: float) -> "Outline":
        """The outline moved towards a measured one by a share of their difference."""
        return Outline(*(old + rate * (new - old) for old, new in zip(self, measured, strict=True)))


BOX_OUTLINE = Outline()


def measure_outline(window: Window, right: float, down: float, covered: float) -> Outline | None:
    """The outline of the target, so many patch pixels off a window's center.

    covered: the share of its box that an occluder covers. None where depth doesn't show it, or it is covered.
    """
    source = window.observation.depth_source
    if window.depth is None or source is None or not source.has_sharp_edges:
        return None
    if covered > MAX_COVERED_BY_OCCLUDER:
        return None
    posterior = window.depth[0]
    rows, columns = window.inner(right, down, OUTLINE_CENTER_SHARE)
    x, y = PATCH_PIXELS / 2 + right, PATCH_PIXELS / 2 + down
    across, along = posterior[rows].mean(axis=0), posterior[:, columns].mean(axis=1)
    sides = (*_extent(across, x), *_extent(along, y))
    if None in sides:
        return None
    halves = [each / 2 for each in (window.size[0], window.size[0], window.size[1], window.size[1])]
    left, far, top, bottom = (
        min(max(float(side or 0) / half, MIN_OUTLINE_SIDE), MAX_OUTLINE_SIDE)
        for side, half in zip(sides, halves, strict=True)
    )
    return Outline(left, top, far, bottom)


def _extent(filled: NDArray[np.floating], center: float) -> tuple[float | None, float | None]:
    """How far the filled part reaches before and after a place.

    None if it starts outside of it, or reaches the window's edge.
    """
    start = min(max(int(center), 0), len(filled) - 1)
    empty = np.flatnonzero(filled < MIN_FILLED_POSTERIOR)
    before, after = empty[empty <= start], empty[empty > start]
    if not len(before) or not len(after) or before[-1] == start:
        return None, None
    return center - _crossing(filled, before[-1]), _crossing(filled, after[0] - 1) - center


def _crossing(filled: NDArray[np.floating], index: int) -> float:
    """Where MIN_FILLED_POSTERIOR is crossed between the centers of a pixel and the next."""
    first, second = float(filled[index]), float(filled[index + 1])
    return index + 0.5 + (MIN_FILLED_POSTERIOR - first) / (second - first)
