# SPDX-License-Identifier: MIT
"""The outline: how far the target extends from its center, according to the pixels at its depth.

The outline gives the box that a track reports. The target's own box, in which its appearance is measured,
keeps its aspect ratio. A side follows depth only if depth agreed with it in the first frame: something that
the target touches, such as the floor, may be at the same depth.
"""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

import numpy as np

from tricue.arrays import Plane
from tricue.camera.box import Box
from tricue.track.base.params import Params, parameter
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.target import Target
from tricue.track.fused.window import PATCH_PIXELS, Window

MIN_FILLED_POSTERIOR = 0.45  # mean P(target | depth) along a row or column of the target: half of its maximum
FILLED = float(np.float32(MIN_FILLED_POSTERIOR))  # rounded like the profiles
OUTLINE_CENTER_SHARE = 0.25  # of the box's sides: the rows and columns that are followed outward
MAX_COVERED_BY_OCCLUDER = 0.05  # of the box, above which the outline can't be measured
BORDER_MARGIN = 0.1  # of the target's side, from the image's border, as boxes are drawn by hand
MAX_FIRST_DEVIATION = 0.2  # of half the box, between a side of the first box and what depth shows
MAX_SEEN_DEVIATION = 0.6  # of half the box, for a SEEN side; farther off, the edge is something else's
MAX_CUT_REACH = 6.0  # halves of the box


@dataclass(frozen=True, kw_only=True)
class OutlineParams(Params):
    """The parameters of the outline."""

    outline_time_constant: float = parameter(
        0.5,
        unit="s",
        source=PROTOTYPE,
        above=0,
        doc="time constant with which the box's sides follow the outline",
        was="outline_time",
    )


class Outline(NamedTuple):
    """Distances of the sides from the target's center, in halves of its width and height."""

    left: float = 1.0
    top: float = 1.0
    right: float = 1.0
    bottom: float = 1.0

    @classmethod
    def of(cls, box: Box, target: Target) -> "Outline":
        """The outline with which the target has this box."""
        left, top, right, bottom = box.xyxy
        half_width, half_height = target.width / 2, target.height / 2
        return cls(
            (target.x - left) / half_width,
            (target.y - top) / half_height,
            (right - target.x) / half_width,
            (bottom - target.y) / half_height,
        )

    def apply_to(self, target: Target) -> Target:
        """The target with its sides moved to the outline."""
        half_width, half_height = target.width / 2, target.height / 2
        left, right = target.x - self.left * half_width, target.x + self.right * half_width
        top, bottom = target.y - self.top * half_height, target.y + self.bottom * half_height
        return Target((left + right) / 2, (top + bottom) / 2, right - left, bottom - top)

    def blend(self, measured: "Outline", rate: float) -> "Outline":
        """The outline moved toward a measured one by a share ``rate`` of the difference."""
        return Outline(*(old + rate * (new - old) for old, new in zip(self, measured, strict=True)))


BOX_OUTLINE = Outline()


class Reaches(NamedTuple):
    """How far the pixels at the target's depth reach from its center, in halves of its width and height.

    None in a direction in which they reach the window's edge, or if the center isn't at that depth.
    """

    left: float | None
    top: float | None
    right: float | None
    bottom: float | None


class Side(Enum):
    """What depth tells about a side of the target, decided at the first depth.

    HIDDEN: nothing, because something at the same depth is there, such as a table or a chair. SEEN: where the
    side is. CUT: the image's border cuts the target off there, so the target may extend farther later.
    """

    HIDDEN = 0
    SEEN = 1
    CUT = 2


class Sides(NamedTuple):
    """What depth tells about each side."""

    left: Side
    top: Side
    right: Side
    bottom: Side

    @classmethod
    def cut_by_border(cls, target: Target, shape: tuple[int, int]) -> "Sides":
        """CUT for the sides that the border of an image of that height and width cuts off, else HIDDEN."""
        height, width = shape
        box, margin = target.box, BORDER_MARGIN * target.side
        ends = box.x, box.y, width - box.x - box.width, height - box.y - box.height
        return cls(*(Side.CUT if end <= margin else Side.HIDDEN for end in ends))

    @property
    def are_hidden(self) -> bool:
        """Whether depth shows none of the sides."""
        return self == ALL_HIDDEN

    def see(self, reaches: Reaches | None) -> "Sides":
        """The sides after the first depth: HIDDEN becomes SEEN where depth agrees with the box."""
        if reaches is None:
            return self
        return Sides(
            *(
                Side.SEEN
                if side is Side.HIDDEN and reach is not None and abs(reach - 1) <= MAX_FIRST_DEVIATION
                else side
                for side, reach in zip(self, reaches, strict=True)
            )
        )

    def outline(self, reaches: Reaches) -> Outline:
        """The outline with the sides that depth shows; the others stay those of the box."""
        return Outline(*(_limit_reach(*each) for each in zip(self, reaches, strict=True)))


ALL_HIDDEN = Sides(*4 * [Side.HIDDEN])


def _limit_reach(side: Side, reach: float | None) -> float:
    """How far the side is from the center by depth, as far as depth is trusted; else that of the box."""
    if reach is None or side is Side.HIDDEN:
        return 1.0
    if side is Side.CUT:
        return min(max(reach, 1.0), MAX_CUT_REACH)
    return reach if abs(reach - 1) <= MAX_SEEN_DEVIATION else 1.0


def measure_reaches(
    window: Window, right: float, down: float, covered: float, *, without_support: bool
) -> Reaches | None:
    """How far the pixels at the target's depth reach from the target's center.

    right, down: that center, in patch pixels from the window's. covered: the share of the target's box that
    an occluder covers. without_support: whether to exclude what the target stands on. None if there is no
    depth, if depth has no sharp edges, or if the target is covered.
    """
    source = window.observation.depth_source
    if window.depth is None or source is None or not source.has_sharp_edges:
        return None
    if covered > MAX_COVERED_BY_OCCLUDER:
        return None
    posterior = window.posterior_without_support if without_support else window.depth_posterior
    rows, columns = window.inner(right, down, OUTLINE_CENTER_SHARE)
    x, y = PATCH_PIXELS / 2 + right, PATCH_PIXELS / 2 + down
    middle_rows, middle_columns = posterior[rows], posterior[:, columns]
    across = np.add.reduce(middle_rows, axis=0) / len(middle_rows)
    downward = np.add.reduce(middle_columns, axis=1) / middle_columns.shape[1]
    to_left, to_right = _extent(across, x, window.size[0] / 2)
    to_top, to_bottom = _extent(downward, y, window.size[1] / 2)
    return Reaches(to_left, to_top, to_right, to_bottom)


def _extent(profile: Plane, center: float, half: float) -> tuple[float | None, float | None]:
    """How far the filled part of a profile reaches before and after a place, in halves of the box."""
    values = profile.tolist()
    start = min(max(int(center), 0), len(values) - 1)
    if values[start] < FILLED:
        return None, None
    before, after = _first_empty(values, start, -1, -1), _first_empty(values, start, len(values), 1)
    return (
        None if before is None else (center - _crossing(values, before)) / half,
        None if after is None else (_crossing(values, after - 1) - center) / half,
    )


def _first_empty(profile: list[float], start: int, end: int, step: int) -> int | None:
    for i in range(start, end, step):
        if profile[i] < FILLED:
            return i
    return None


def _crossing(profile: list[float], index: int) -> float:
    """Where the profile crosses MIN_FILLED_POSTERIOR between the centers of a pixel and the next."""
    first, second = profile[index], profile[index + 1]
    return index + 0.5 + (MIN_FILLED_POSTERIOR - first) / (second - first)
