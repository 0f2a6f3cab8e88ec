# SPDX-License-Identifier: MIT
"""The target's velocity and disparity, and their densities, sections 4.2 and 4.3."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, moved

Range = tuple[float, float]

MIN_DENSITY_SUM = 1e-300  # keeps a density of zeros from a division by 0


class ExpectedPeak(NamedTuple):
    """The expected peak of one observation's histogram.

    deviation: the peak's standard deviation from this value. half_range: half the range of the histograms.
    """

    value: float
    deviation: float
    half_range: float


class TargetModel(NamedTuple):
    """What the kernel ``target_model`` estimates, for each of the K used observations of u, v, d.

    densities: (K, bins) of the target, with sum 1. alternatives: (K, bins) of its surround. ranges: of the
    histograms. peaks: the representative velocity or disparity. disparity_scale: of the cues.
    """

    densities: Floats
    alternatives: Floats
    ranges: tuple[Range, ...]
    peaks: tuple[float, ...]
    disparity_scale: float

    def with_disparity_range(self, new: Range) -> "TargetModel":
        """The model with the disparity's density, the last one, in the bins of another range."""
        *flow, density = self.densities
        middles, old_middles = (_bin_middles(each, len(density)) for each in (new, self.ranges[-1]))
        density = np.interp(middles, old_middles, density, left=0.0, right=0.0)
        densities = np.array([*flow, density / max(density.sum(), MIN_DENSITY_SUM)])
        return self._replace(densities=densities, ranges=(*self.ranges[:-1], new))


def estimate_model(
    k: Kernels,
    cues: Cues,
    expected: Sequence[ExpectedPeak],
    window: Rectangle,
    blocks: Blocks | None,
    same_depth: Range | None,
    before: TargetModel | None,
    p: FlowDepthParams,
) -> TargetModel:
    """The model from the histograms in a window, mixed with the previous model, moved to the new peaks.

    Histograms are over the cells of trusted target blocks, or over all. Flow counts only where the disparity
    is unknown or within a tolerance of the target's (``same_depth``).
    """
    x, y = cues.region[:2]
    mine = blocks and (blocks.grid_in(cues.region), blocks.states, blocks.trusted)
    ranges = tuple((value - half_range, value + half_range) for value, _, half_range in expected)
    if before and before.disparity_scale != cues.disparity_scale:  # of the other kind: bins differ in width
        before = before.with_disparity_range(ranges[-1])
    former = before and (before.densities, [low for low, _ in before.ranges], before.peaks)
    densities, alternatives, peaks = k.target_model(
        cues.maps,
        expected,
        moved(window, -x, -y),
        mine,
        same_depth,
        former,
        (p.bins, p.smoothing, p.min_prominence, p.density_memory, p.surround_weight),
    )
    return TargetModel(densities, alternatives, ranges, tuple(peaks.tolist()), cues.disparity_scale)


def _bin_middles(ends: Range, bins: int) -> Floats:
    low, high = ends
    return np.asarray(low + (np.arange(bins) + 0.5) * ((high - low) / bins))
