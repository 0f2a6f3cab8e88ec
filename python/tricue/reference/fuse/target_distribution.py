# SPDX-License-Identifier: MIT
"""The target's part of a histogram (Okada, Shirai, Miura 1996, section 4.2 and figure 6)."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse

EQUAL = 1e-9  # of the peak; heights that differ by less are equal


def target_distribution(
    histogram: Floats,
    smoothing: float,
    min_prominence: float = 0.05,
    expected: float = np.nan,
    spread: float = 1.0,
) -> tuple[Floats, float]:
    """Smooths, finds the peak, then cuts off each side at its minimum."""
    _require(histogram, smoothing, min_prominence, expected, spread)
    if not histogram.any():
        return np.zeros(len(histogram)), np.nan
    smooth = _smoothed(histogram / histogram.max(), smoothing)
    at, peak = _peak(smooth * _closeness(smooth, expected, spread))
    height = float(smooth[peak])  # P_obj is (at, height)
    density = smooth.copy()
    for bins in (np.arange(peak, -1, -1), np.arange(peak, len(smooth))):
        minimum = _minimum(smooth[bins], height, max(min_prominence, EQUAL))
        if minimum is not None:
            beyond, least = bins[minimum + 1 :], smooth[bins[minimum]]  # P_+ or P_-
            density[beyond] = 0
            if minimum > 0:  # else the peak is a shoulder of a higher one
                slope = (least - height) / (bins[minimum] - at)
                density[beyond] = np.maximum(height + slope * (beyond - at), 0)  # down to P_0
    return density / density.sum(), at + 0.5


def _smoothed(histogram: Floats, smoothing: float) -> Floats:
    """The mean with Gaussian weights over the bins that exist, fewer at the ends.

    Bins at the same distance on both sides are added first, so that smoothing a mirrored histogram gives the
    mirrored result, bit for bit.
    """
    total, weights = histogram.copy(), np.ones(len(histogram))
    for j in range(1, int(np.ceil(4 * smoothing)) + 1):
        step = j / smoothing
        weight = np.exp(-0.5 * (step * step))
        total += weight * _beside(histogram, j)
        weights += weight * _beside(np.ones(len(histogram)), j)
    smooth: Floats = total / weights
    return smooth


def _beside(values: Floats, j: int) -> Floats:
    """values[i - j] + values[i + j] for each i; values outside the array are 0."""
    padded = np.pad(values, j)
    return np.asarray(padded[: len(values)] + padded[2 * j :])


def _closeness(smooth: Floats, expected: float, spread: float) -> Floats:
    """exp(-((center - expected) / spread)² / 2) divided by its value in the nearest bin that isn't empty; at
    most 1.

    So some product with the histogram is above 0, however far away the expected peak is.
    """
    center = np.arange(len(smooth)) + 0.5
    if np.isnan(expected) or np.isinf(spread):
        return np.ones(len(smooth))
    there = center[smooth > 0]
    nearest = there[np.abs(there - np.clip(expected, 0, len(smooth))).argmin()]
    # ((center - expected)² - (nearest - expected)²) / 2, without the squares, which would overflow.
    with np.errstate(over="ignore"):
        farther = (center - nearest) * ((center + nearest) / 2 - expected)
        return np.asarray(np.exp(-np.maximum(farther, 0) / spread / spread))


def _peak(values: Floats) -> tuple[float, int]:
    """The place of the peak, in bins from the middle of the first, and the bin that the peak is in.

    Of the first stretch of highest bins, it is the middle; if the stretch is one bin, the top of the parabola
    through it and its neighbors.
    """
    top = values.max()
    high = values >= top - EQUAL * top
    begin = int(high.argmax())
    length = int(np.argmin(np.append(high[begin:], False)))
    end = begin + length - 1
    if length > 1 or begin == 0 or end == len(values) - 1:
        return (begin + end) / 2, (begin + end + 1) // 2
    before, at, after = values[begin - 1 : begin + 2]
    return float(begin + (before - after) / (2 * (before - 2 * at + after))), begin


def _minimum(side: Floats, height: float, rise: float) -> int | None:
    """The index of the minimum before the values, from the peak outward, rise; None if they don't rise."""
    least = 0
    for i in range(len(side)):
        if side[i] < side[least] - EQUAL * height:
            least = i
        elif side[i] > side[least] + rise * height:
            return least
    return None


def _require(
    histogram: Floats, smoothing: float, min_prominence: float, expected: float, spread: float
) -> None:
    if len(histogram) < 1:
        refuse("histogram", "at least one bin", "none")
    strange = histogram[~(np.isfinite(histogram) & (histogram >= 0))]
    if strange.size:
        refuse("histogram", "finite numbers, none negative", float(strange[0]))
    if not 0 <= smoothing <= len(histogram):
        refuse("smoothing", f"a number in [0, {len(histogram)}]", float(smoothing))
    if not 0 <= min_prominence < 1:
        refuse("min_prominence", "a number in [0, 1)", float(min_prominence))
    if np.isinf(expected):
        refuse("expected", "a finite number or NaN", float(expected))
    if not spread > 0:
        refuse("spread", "a number above 0", float(spread))
