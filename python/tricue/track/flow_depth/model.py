# SPDX-License-Identifier: MIT
"""The target's velocity and disparity, and their densities, sections 4.2 and 4.3."""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.cues import CueMap, Cues
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle

Floats = NDArray[np.float64]
Mask = NDArray[np.uint8]
Range = tuple[float, float]

MAX_OBSERVATION = 1e6  # cells: no observation is beyond
MIN_DENSITY_SUM = 1e-300  # keeps a density of zeros from a division by 0


class ExpectedPeak(NamedTuple):
    """Where the peak of one observation's histogram is expected.

    value: the expected peak. deviation: the standard deviation of the peak from there. half_range: half the
    range of the histograms.
    """

    value: float
    deviation: float
    half_range: float

    @property
    def range(self) -> Range:
        """The range of the histograms."""
        return self.value - self.half_range, self.value + self.half_range


class TargetModel(NamedTuple):
    """For each observation of u, v, d that is used: two densities, their range, and the target's peak.

    densities: (bins,) of the target, of sum 1. alternatives: (bins,) of what is around it. peaks: the
    representative velocity or disparity.
    """

    densities: tuple[Floats, ...]
    alternatives: tuple[Floats, ...]
    ranges: tuple[Range, ...]
    peaks: tuple[float, ...]


class HistogramMasks(NamedTuple):
    """The cells that count in histograms, (h, w) of 0 and 1 each.

    target: the cells of the target's blocks; the others are its surround.
    same_depth: the cells whose disparity is the target's or isn't known; flow counts only there.
    """

    target: Mask
    same_depth: Mask


def estimate_model(
    k: Kernels,
    cues: Cues,
    expected: Sequence[ExpectedPeak],
    window: Rectangle,
    masks: HistogramMasks,
    before: TargetModel | None,
    p: FlowDepthParams,
) -> TargetModel:
    """The model from the histograms in a window, mixed with the model before, moved to the new peaks."""
    surround = 1 - masks.target
    densities, alternatives, peaks = [], [], []
    for i, (cue, at) in enumerate(zip(cues.maps, expected, strict=True)):
        is_flow = cues.flow is not None and i < len(cues.flow)
        counted = masks.target & masks.same_depth if is_flow else masks.target
        histogram = k.weighted_histogram(*cue, window, *at.range, p.bins, counted)
        width = 2 * at.half_range / p.bins
        density, peak = k.target_distribution(
            histogram, p.smoothing, p.min_prominence, p.bins / 2, at.deviation / width
        )
        if np.isnan(peak):
            peak = p.bins / 2
        elif before is not None and p.density_memory:
            old_peak = (before.peaks[i] - before.ranges[i][0]) / width  # bins
            density = _blend(density, before.densities[i], old_peak - peak, p.density_memory)
        densities.append(density)
        alternatives.append(_estimate_alternative(k, cue, surround, at, p))
        peaks.append(at.range[0] + peak * width)
    return TargetModel(
        tuple(densities), tuple(alternatives), tuple(at.range for at in expected), tuple(peaks)
    )


def _blend(density: Floats, before: Floats, shift: float, memory: float) -> Floats:
    """The density mixed with the one before, moved down by ``shift`` bins; of sum 1."""
    bins = np.arange(len(density))
    moved = np.interp(bins + shift, bins, before, left=0, right=0)
    both = memory * moved + (1 - memory) * density
    return np.asarray(both / max(both.sum(), MIN_DENSITY_SUM))


def _estimate_alternative(
    k: Kernels, cue: CueMap, surround: Mask, at: ExpectedPeak, p: FlowDepthParams
) -> Floats:
    """P(F) of what isn't the target: partly that of its surround, partly uniform, as that may change."""
    height, width = surround.shape
    whole = 0.0, 0.0, float(width), float(height)
    uniform = np.full(p.bins, 1 / p.bins)
    total = float(k.weighted_histogram(*cue, whole, -MAX_OBSERVATION, MAX_OBSERVATION, 1, surround)[0])
    if not (p.surround_weight and total > 0):
        return uniform
    histogram = k.weighted_histogram(*cue, whole, *at.range, p.bins, surround)
    gaussian = _gaussian(p.smoothing)
    first = len(gaussian) // 2  # not mode="same", whose result may be longer than the histogram
    smooth = np.convolve(histogram, gaussian)[first : first + p.bins]
    return p.surround_weight * smooth / total + (1 - p.surround_weight) * uniform


@lru_cache(maxsize=16)
def _gaussian(deviation: float) -> Floats:
    """A Gaussian of sum 1; its deviation in bins."""
    radius = math.ceil(3 * deviation)
    gaussian = np.exp(-0.5 * (np.arange(-radius, radius + 1) / deviation) ** 2)
    return np.asarray(gaussian / gaussian.sum())
