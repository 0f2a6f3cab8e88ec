# SPDX-License-Identifier: MIT
"""The cells of a frame that are read to measure a region, so that no others are computed."""

import math
from typing import NamedTuple

from tricue.track.flow_depth.cues import POOLING_RADIUS
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, Region, cells_of, grown, whole
from tricue.track.flow_depth.reduced_frame import WantedCells

MAX_FLOW_STEP = 2  # cells of a level, by which a coarser level's flow may be off in pyramid_flow
MAX_DISPARITY_STEP = 1.5  # the same in gradient_disparity
DERIVATIVE_REACH = 3  # cells, of gradient_disparity's filter


class CueReach(NamedTuple):
    """How far around a region the cues' kernels read, cells; 0 for an unused cue.

    flow: in the frame and the previous one. left: for the disparity, in the left image. right: around the
    region's place in the right image by the expected disparity. A region is first enlarged to whole cells: a
    corner that is 1e-16 inside of a cell would be rounded to the cell's edge by the sum.
    """

    flow: int
    left: int
    right: int

    @classmethod
    def of(cls, p: FlowDepthParams) -> "CueReach":
        """The reach of the cues that are used."""
        flow = _flow_reach(p) if "flow" in p.cues else 0
        return cls(flow, *_disparity_reach(p)) if "disparity" in p.cues else cls(flow, 0, 0)

    def before(self, region: Rectangle, shape: tuple[int, ...]) -> Region:
        """The cells of the previous frame that the flow of a region reads."""
        return cells_of(grown(whole(region), self.flow, self.flow), shape)

    def wanted(self, region: Rectangle, disparity: float, shape: tuple[int, ...]) -> WantedCells:
        """The cells that are read in this frame, given the expected disparity."""
        reach = max(self.flow, self.left)
        left = cells_of(grown(whole(region), reach, reach), shape)
        return WantedCells(left, self._in_right(region, disparity, shape) if self.right else None)

    def _in_right(self, region: Rectangle, disparity: float, shape: tuple[int, ...]) -> Region:
        """The cells in the right image; if the region would be outside it, the cells at the edge."""
        x0, y0, x1, y1 = whole(region)
        last = shape[1] - 1
        left, right = min(max(x0 - disparity, 0), last), min(max(x1 - disparity, 0), last)
        return cells_of((left - self.right, y0 - self.left, right + self.right + 1, y1 + self.left), shape)


def _flow_reach(p: FlowDepthParams) -> int:
    """The reach of each level's filters and windows, the guess from coarser levels, and the next pixel."""
    filters = math.ceil(3.5 * p.sigma - 0.5)
    if p.flow_levels == 1:
        return filters
    margin = filters + POOLING_RADIUS + 2
    reach, guess = margin, 0
    for _ in range(p.flow_levels - 1):
        guess = 2 * (guess + MAX_FLOW_STEP)
        reach = max(margin + guess, 2 * reach + 3)  # two pixels for smoothing, one for rounding
    return reach


def _disparity_reach(p: FlowDepthParams) -> tuple[int, int]:
    """The reach in the left image, and around the expected place in the right one."""
    uncertain = sum(MAX_DISPARITY_STEP * 2**level for level in range(1, p.disparity_levels))
    left = right = wanted = 0.0
    for level in range(p.disparity_levels):
        size = 2**level  # cells per pixel of the level
        pooled = wanted + p.disparity_radius * size
        left = max(left, pooled + (DERIVATIVE_REACH + 2) * size)
        right = max(right, pooled + (DERIVATIVE_REACH + 6 + uncertain) * size)
        wanted = pooled + size
        uncertain = max(uncertain / 2 - MAX_DISPARITY_STEP, 0)
    return math.ceil(left), math.ceil(right)
