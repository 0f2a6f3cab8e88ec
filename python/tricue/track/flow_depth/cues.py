# SPDX-License-Identifier: MIT
"""What a frame says of motion and depth round the target: the observations (10), with their reliabilities."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Region
from tricue.track.flow_depth.view import Plane, View

LEAST = 12  # places with a disparity
SOLID = 0.25  # of them, that have the same
TOGETHER = 1.0  # places: the same
WIDEST = 0.3  # of the columns, as disparity of parallel cameras; negative ones up to an eighth of that
WINDOW, UNIQUENESS = 7, 10  # of the block matching that finds the first disparity
POOL = 2  # places, radius in which the pyramid's constraints are pooled


class Reading(NamedTuple):
    """One observation of each place (h, w), NaN where there is none, and the weights (h, w) of their
    histogram.
    """

    values: Plane
    weights: Plane


class Cues(NamedTuple):
    """Of the places of a region: u, v in places a frame and d in places, as far as they are used; all are
    (h, w).
    """

    region: Region
    flow: tuple[Reading, Reading] | None
    disparity: Reading | None

    @property
    def readings(self) -> tuple[Reading, ...]:
        """Those of (10) that there are: u, v, d."""
        return (self.flow or ()) + ((self.disparity,) if self.disparity else ())

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the region."""
        x0, y0, x1, y1 = self.region
        return y1 - y0, x1 - x0

    def disparities(self) -> Plane:
        """(h, w); NaN everywhere without that cue."""
        return np.full(self.shape, np.nan, np.float32) if self.disparity is None else self.disparity.values


def measure(
    k: Kernels, before: View | None, now: View, region: Region, expected: float, p: FlowDepthParams
) -> Cues:
    """Flow from the view before, if any, and disparity round the expected one, places."""
    flow = disparity = None
    if "flow" in p.cues and before is not None:
        flow = _flow(k, before, now, region, p)
    if "disparity" in p.cues:
        disparity = _disparity(k, now, region, expected, p)
    return Cues(region, flow, disparity)


def _flow(k: Kernels, before: View, now: View, region: Region, p: FlowDepthParams) -> tuple[Reading, Reading]:
    least = p.min_angle, p.min_contrast
    if p.flow_levels == 1:
        u, v, angle, _ = k.gradient_flow(before.gray, now.gray, p.sigma, *least, region)
    else:
        u, v, angle, _ = k.pyramid_flow(before.gray, now.gray, p.sigma, p.flow_levels, *least, region, POOL)
    return Reading(u, angle), Reading(v, angle)


def _disparity(k: Kernels, now: View, region: Region, expected: float, p: FlowDepthParams) -> Reading:
    if now.disparity is not None:
        x0, y0, x1, y1 = region
        found = np.ascontiguousarray(now.disparity[y0:y1, x0:x1])
        return Reading(found, np.ones_like(found))
    assert now.right is not None
    return Reading(*k.gradient_disparity(now.gray, now.right, expected, p.disparity_levels, region=region))


def own_disparity(k: Kernels, now: View, region: Region) -> float | None:
    """The disparity, places, that most of a region has; None where hardly anything has any, and in an empty
    region.
    """
    x0, y0, x1, y1 = region
    if x0 >= x1 or y0 >= y1:
        return None
    found = _searched(k, now, region)
    found = found[np.isfinite(found)]
    if found.size < LEAST:
        return None
    candidates = np.unique(np.round(found))
    together = [np.abs(found - candidate) <= TOGETHER for candidate in candidates]
    most: NDArray[np.bool_] = max(together, key=np.count_nonzero)
    return float(np.median(found[most])) if np.count_nonzero(most) >= SOLID * found.size else None


def _searched(k: Kernels, now: View, region: Region) -> Plane:
    if now.disparity is not None:
        x0, y0, x1, y1 = region
        return now.disparity[y0:y1, x0:x1]
    assert now.right is not None
    last = max(int(WIDEST * now.gray.shape[1]), 1)
    first, last = (bound - round(now.shift) for bound in (-last // 8, last))
    return k.sad_disparity(now.gray, now.right, region, False, first, last, WINDOW, UNIQUENESS)
