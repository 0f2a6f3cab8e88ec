# SPDX-License-Identifier: MIT
"""The target's velocity and disparity, and their densities, sections 4.2 and 4.3."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, moved

Floats = NDArray[np.float64]
Range = tuple[float, float]


class ExpectedPeak(NamedTuple):
    """The expected peak of one observation's histogram.

    deviation: the peak's standard deviation from this value. half_range: half the range of the histograms.
    """

    value: float
    deviation: float
    half_range: float


class TargetModel(NamedTuple):
    """Two densities, their range, and the target's peak, for each of the K used observations of u, v, d.

    densities: (K, bins) of the target, with sum 1. alternatives: (K, bins) of its surround. ranges: of the
    histograms. peaks: the representative velocity or disparity.
    """

    densities: Floats
    alternatives: Floats
    ranges: tuple[Range, ...]
    peaks: tuple[float, ...]


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
    mine = blocks and (blocks.corners, blocks.place_in(cues.region), blocks.states, blocks.trusted)
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
    ranges = tuple((value - half_range, value + half_range) for value, _, half_range in expected)
    return TargetModel(densities, alternatives, ranges, tuple(peaks.tolist()))
