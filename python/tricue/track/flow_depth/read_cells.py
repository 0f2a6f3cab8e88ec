# SPDX-License-Identifier: MIT
"""Which cells of a frame are read to measure a region, so that no others are made."""

import math
from typing import NamedTuple

from tricue.track.flow_depth.cues import POOLING_RADIUS
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, Region, cells_of, grown
from tricue.track.flow_depth.reduced_frame import WantedCells

MAX_FLOW_STEP = 2  # cells of a level, of pyramid_flow, by which a coarser level's flow may be off
MAX_DISPARITY_STEP = 1.5  # the same of gradient_disparity
DERIVATIVE_REACH = 3  # cells, of the filter of gradient_disparity


class CueReach(NamedTuple):
    """How far around a region the kernels of the cues read, cells; 0 of a cue that isn't used.

    flow: in the frame and the one before. left: for the disparity, in the left image. right: around where
    the region is in the right image by the expected disparity.
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
        """The cells of the frame before that the flow of a region reads."""
        return cells_of(grown(region, self.flow, self.flow), shape)

    def wanted(self, region: Rectangle, disparity: float, shape: tuple[int, ...]) -> WantedCells:
        """The cells that are read in this frame, by the expected disparity."""
        reach = max(self.flow, self.left)
        left = cells_of(grown(region, reach, reach), shape)
        return WantedCells(left, self._in_right(region, disparity, shape) if self.right else None)

    def _in_right(self, region: Rectangle, disparity: float, shape: tuple[int, ...]) -> Region:
        """Where the region would be beyond the right image, the cells at its edge are read."""
        x0, y0, x1, y1 = region
        last = shape[1] - 1
        left, right = min(max(x0 - disparity, 0), last), min(max(x1 - disparity, 0), last)
        return cells_of((left - self.right, y0 - self.left, right + self.right + 1, y1 + self.left), shape)


def _flow_reach(p: FlowDepthParams) -> int:
    """Filters and windows of each level, what the guess from coarser levels may add, and the next pixel."""
    filters = math.ceil(3.5 * p.sigma - 0.5)
    if p.flow_levels == 1:
        return filters
    margin = filters + POOLING_RADIUS + 2
    reach, guess = margin, 0
    for _ in range(p.flow_levels - 1):
        guess = 2 * (guess + MAX_FLOW_STEP)
        reach = max(margin + guess, 2 * reach + 3)  # two pixels of smoothing, and one of rounding
    return reach


def _disparity_reach(p: FlowDepthParams) -> tuple[int, int]:
    """In the left image, and beside the expected place in the right one."""
    uncertain = sum(MAX_DISPARITY_STEP * 2**level for level in range(1, p.disparity_levels))
    left = right = wanted = 0.0
    for level in range(p.disparity_levels):
        size = 2**level  # cells of a pixel of the level
        pooled = wanted + p.disparity_radius * size
        left = max(left, pooled + (DERIVATIVE_REACH + 2) * size)
        right = max(right, pooled + (DERIVATIVE_REACH + 6 + uncertain) * size)
        wanted = pooled + size
        uncertain = max(uncertain / 2 - MAX_DISPARITY_STEP, 0)
    return math.ceil(left), math.ceil(right)
