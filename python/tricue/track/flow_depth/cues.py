# SPDX-License-Identifier: MIT
"""Flow and disparity around the target: the observations (10), with their reliabilities."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Plane
from tricue.kernels import Kernels
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Region
from tricue.track.flow_depth.reduced_frame import ReducedFrame

POOLING_RADIUS = 2  # cells, the radius for pooling constraints of the pyramid's flow


class GradientMatching(NamedTuple):
    """How ``gradient_disparity`` measures; see there."""

    levels: int = 3
    sigma: float = 1.0
    radius: int = 2
    min_reliability: float = 0.3
    max_residual: float = 0.2
    max_step: float = 1.0


class CueMap(NamedTuple):
    """One observation per cell (h, w), NaN where missing, and its weight in histograms (h, w)."""

    values: Plane
    weights: Plane


class Cues(NamedTuple):
    """The observations of a region's cells: flow u, v, cells per frame, and disparity d, cells.

    A cue that isn't used is None. disparity_scale: cells in parameters that are lengths in disparity, by what
    this frame measured it with.
    """

    region: Region
    flow: tuple[CueMap, CueMap] | None
    disparity: CueMap | None
    disparity_scale: float = 1.0

    @property
    def maps(self) -> tuple[CueMap, ...]:
        """The used ones of u, v, d (10), in this order."""
        return (self.flow or ()) + ((self.disparity,) if self.disparity else ())

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the region."""
        x0, y0, x1, y1 = self.region
        return y1 - y0, x1 - x0

    def disparities(self) -> Plane:
        """The disparities (h, w), cells; NaN everywhere without that cue."""
        return np.full(self.shape, np.nan, np.float32) if self.disparity is None else self.disparity.values


def measure(
    k: Kernels,
    before: ReducedFrame | None,
    now: ReducedFrame,
    region: Region,
    expected: float,
    p: FlowDepthParams,
) -> Cues:
    """Measure the flow from the frame before, if any, and the disparity around the expected one, cells."""
    flow = disparity = None
    if "flow" in p.cues and before is not None:
        flow = _measure_flow(k, before, now, region, p)
    if "disparity" in p.cues:
        disparity = _measure_disparity(k, now, region, expected, p)
    return Cues(region, flow, disparity, now.disparity_scale(p))


def _measure_flow(
    k: Kernels, before: ReducedFrame, now: ReducedFrame, region: Region, p: FlowDepthParams
) -> tuple[CueMap, CueMap]:
    if _is_uniform(before.gray, region) or _is_uniform(now.gray, region):
        nothing = _no_measurements(region)  # what appears or disappears would look like motion
        return nothing, nothing
    limits = p.min_angle, p.min_contrast
    if p.flow_levels == 1:
        u, v, angle, _ = k.gradient_flow(before.gray, now.gray, p.sigma, *limits, region)
    else:
        u, v, angle, _ = k.pyramid_flow(
            before.gray, now.gray, p.sigma, p.flow_levels, *limits, region, POOLING_RADIUS
        )
    return CueMap(u, angle), CueMap(v, angle)


def _is_uniform(gray: NDArray[np.uint8], region: Region) -> bool:
    """Whether a region has a single gray value, as in a black image."""
    x0, y0, x1, y1 = region
    first = gray.item(y0, x0)
    if first != gray.item(y1 - 1, x1 - 1):  # usually two corners decide
        return False
    return bool((gray[y0:y1, x0:x1] == first).all())


def _no_measurements(region: Region) -> CueMap:
    """A cue without measurements."""
    x0, y0, x1, y1 = region
    shape = y1 - y0, x1 - x0
    return CueMap(np.full(shape, np.nan, np.float32), np.zeros(shape, np.float32))


def _measure_disparity(
    k: Kernels, now: ReducedFrame, region: Region, expected: float, p: FlowDepthParams
) -> CueMap:
    if now.disparity is not None:
        x0, y0, x1, y1 = region
        disparity = np.ascontiguousarray(now.disparity[y0:y1, x0:x1])
        return CueMap(disparity, np.ones_like(disparity))
    assert now.right is not None
    matching = GradientMatching(p.disparity_levels, radius=p.disparity_radius, max_step=p.max_disparity_step)
    return CueMap(*k.gradient_disparity(now.gray, now.right, expected, matching, region))
