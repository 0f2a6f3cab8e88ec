# SPDX-License-Identifier: MIT
"""The target's velocity and disparity, and how they are distributed: sections 4.2 and 4.3."""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.cues import Cues, Reading
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle

Floats = NDArray[np.float64]
Mask = NDArray[np.uint8]
Range = tuple[float, float]

EVER = 1e6  # places: all readings are within
TINY = 1e-300


class Expected(NamedTuple):
    """Of one observation: where the target's is expected, how far it may be from there, and how wide the
    range of histograms is, to each side.
    """

    value: float
    spread: float
    reach: float

    @property
    def range(self) -> Range:
        """Of the histogram."""
        return self.value - self.reach, self.value + self.reach


class Model(NamedTuple):
    """Of each observation u, v, d that is used: the target's density (bins,), that of what is round it,
    their range, and the peak, which is the representative velocity or disparity.
    """

    densities: tuple[Floats, ...]
    alternatives: tuple[Floats, ...]
    ranges: tuple[Range, ...]
    peaks: tuple[float, ...]


class Places(NamedTuple):
    """Where histograms are made, (h, w) each: own, the places of the target's blocks, what is round them
    isn't the target; moving, those whose depth is the target's or isn't known: flow counts only there.
    """

    own: Mask
    moving: Mask


def estimate(
    k: Kernels,
    cues: Cues,
    expected: Sequence[Expected],
    window: Rectangle,
    places: Places,
    before: Model | None,
    p: FlowDepthParams,
) -> Model:
    """The model from the histograms in a window, and from the model before, whose densities are moved to the
    new peaks.
    """
    around = 1 - places.own
    densities, alternatives, peaks = [], [], []
    for i, (reading, at) in enumerate(zip(cues.readings, expected, strict=True)):
        of_flow = cues.flow is not None and i < len(cues.flow)
        mine = places.own & places.moving if of_flow else places.own
        histogram = k.weighted_histogram(*reading, window, *at.range, p.bins, mine)
        width = 2 * at.reach / p.bins
        density, peak = k.target_distribution(histogram, p.smoothing, p.ripple, p.bins / 2, at.spread / width)
        if np.isnan(peak):
            peak = p.bins / 2
        elif before is not None and p.memory:
            old = (before.peaks[i] - before.ranges[i][0]) / width  # the peak then, bins
            density = _blended(density, before.densities[i], old - peak, p.memory)
        densities.append(density)
        alternatives.append(_around(k, reading, around, at, p))
        peaks.append(at.range[0] + peak * width)
    return Model(tuple(densities), tuple(alternatives), tuple(at.range for at in expected), tuple(peaks))


def _blended(density: Floats, before: Floats, ahead: float, memory: float) -> Floats:
    """Both densities, the one before moved by so many bins down; of sum 1."""
    bins = np.arange(len(density))
    moved = np.interp(bins + ahead, bins, before, left=0, right=0)
    both = memory * moved + (1 - memory) * density
    return np.asarray(both / max(both.sum(), TINY))


def _around(k: Kernels, reading: Reading, around: Mask, at: Expected, p: FlowDepthParams) -> Floats:
    """P(F) of what isn't the target: partly as in the surround, partly anything, as that may change."""
    height, width = around.shape
    whole = 0.0, 0.0, float(width), float(height)
    anything = np.full(p.bins, 1 / p.bins)
    total = float(k.weighted_histogram(*reading, whole, -EVER, EVER, 1, around)[0])
    if not (p.surround and total > 0):
        return anything
    histogram = k.weighted_histogram(*reading, whole, *at.range, p.bins, around)
    bell = _bell(p.smoothing)
    first = len(bell) // 2  # not "same": that is as long as the bell where that is the longer one
    smooth = np.convolve(histogram, bell)[first : first + p.bins]
    return p.surround * smooth / total + (1 - p.surround) * anything


@lru_cache(maxsize=16)
def _bell(deviation: float) -> Floats:
    """A Gaussian of sum 1, bins."""
    reach = math.ceil(3 * deviation)
    bell = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    return np.asarray(bell / bell.sum())
