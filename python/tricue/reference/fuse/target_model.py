# SPDX-License-Identifier: MIT
"""The target's velocity and disparity, and their densities (Okada, Shirai, Miura 1996, section 4.2)."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Plane
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.fuse.block_mask import block_mask
from tricue.reference.fuse.detail.block_grid import BlockGrid, placed, require_numbers
from tricue.reference.fuse.detail.rectangle_pixels import Rectangle, require_finite_corners
from tricue.reference.fuse.detail.value_bins import require_range
from tricue.reference.fuse.target_distribution import target_distribution
from tricue.reference.fuse.weighted_histogram import weighted_histogram

Mask = NDArray[np.uint8]
Counts = NDArray[np.int64]
Peak = tuple[float, float, float]
Blocks = tuple[BlockGrid, Counts, Counts]
Former = tuple[Floats, Sequence[float], Sequence[float]]

MAX_VALUE = 1e6  # pixels: above any disparity or flow
MIN_DENSITY_SUM = 1e-300  # keeps a density of zeros from a division by 0


def target_model(
    maps: Sequence[tuple[Plane, Plane]],
    expected: Sequence[Peak],
    window: Rectangle,
    blocks: Blocks | None,
    depth: tuple[float, float] | None,
    before: Former | None,
    rules: tuple[int, float, float, float, float],
) -> tuple[Floats, Floats, Floats]:
    """Computes the histograms and densities of one map at a time."""
    bins, smoothing, min_prominence, density_memory, surround_weight = rules
    _require(maps, expected, blocks, before, rules, window)
    last = maps[-1][0]
    target = _target_mask(blocks, last.shape)
    near = np.ones_like(target)
    if depth is not None:
        disparity, tolerance = map(np.float32, depth)
        near = (~(np.abs(last - disparity) > tolerance)).astype(np.uint8)
    densities, alternatives, peaks = [], [], []
    for i, ((values, weights), (value, deviation, half_range)) in enumerate(zip(maps, expected, strict=True)):
        low, high, width = value - half_range, value + half_range, 2 * half_range / bins
        counted = target if i + 1 == len(maps) else target & near
        histogram = weighted_histogram(values, weights, window, low, high, bins, counted)
        density, peak = target_distribution(histogram, smoothing, min_prominence, bins / 2, deviation / width)
        if math.isnan(peak):
            peak = bins / 2
        elif before is not None and density_memory:
            former, lows, places = before
            density = _blend(density, former[i], (places[i] - lows[i]) / width - peak, density_memory)
        densities.append(density)
        alternatives.append(
            _alternative(values, weights, (low, high), 1 - target, (bins, smoothing, surround_weight))
        )
        peaks.append(low + peak * width)
    return np.array(densities), np.array(alternatives), np.array(peaks)


def _target_mask(blocks: Blocks | None, shape: tuple[int, ...]) -> Mask:
    if blocks is None:
        return np.ones(shape, np.uint8)
    grid, states, trusted = blocks
    return block_mask(placed(grid)[(states == 1) & (trusted > 0)], *shape)


def _blend(density: Floats, before: Floats, shift: float, memory: float) -> Floats:
    """The density mixed with the previous one, which is moved down by ``shift`` bins; its sum is 1."""
    bins = np.arange(len(density))
    moved = np.interp(bins + shift, bins, before, left=0, right=0)
    both = memory * moved + (1 - memory) * density
    return np.asarray(both / max(both.sum(), MIN_DENSITY_SUM))


def _alternative(
    values: Plane,
    weights: Plane,
    ends: tuple[float, float],
    surround: Mask,
    rules: tuple[int, float, float],
) -> Floats:
    """A mixture of the surround's density and a uniform one."""
    bins, smoothing, share = rules
    height, width = surround.shape
    whole = 0.0, 0.0, float(width), float(height)
    total = weighted_histogram(values, weights, whole, -MAX_VALUE, MAX_VALUE, 1, surround)[0]
    if not (share and total > 0):
        return np.full(bins, 1 / bins)
    histogram = weighted_histogram(values, weights, whole, *ends, bins, surround)
    radius = math.ceil(3 * smoothing)
    gaussian = np.exp(-0.5 * (np.arange(-radius, radius + 1) / smoothing) ** 2)
    smooth = np.convolve(histogram, gaussian / gaussian.sum())[radius : radius + bins]
    return np.asarray(share * smooth / total + (1 - share) / bins)


def _require(
    maps: Sequence[tuple[Plane, Plane]],
    expected: Sequence[Peak],
    blocks: Blocks | None,
    before: Former | None,
    rules: tuple[int, float, float, float, float],
    window: Rectangle,
) -> None:
    _require_maps(maps)
    if len(expected) != len(maps):
        refuse("expected", f"{len(maps)}, as many as maps", len(expected))
    _require_rules(*rules)
    for value, deviation, half_range in expected:
        require_range(value - half_range, value + half_range, rules[0])
        if not deviation > 0:
            refuse("expected", "deviations above 0", float(deviation))
    require_finite_corners(window, "window")
    if blocks is not None:
        grid, states, trusted = blocks
        require_numbers(grid, states, "states")
        require_numbers(grid, trusted, "trusted")
    if before is not None:
        require_shape("before", before[0], (len(maps), rules[0]))
        for numbers in before[1:]:
            if len(numbers) != len(maps):
                refuse("before", f"{len(maps)} lows and peaks", len(numbers))


def _require_maps(maps: Sequence[tuple[Plane, Plane]]) -> None:
    if not 1 <= len(maps) <= 3:
        refuse("maps", "1 to 3", len(maps))
    for each in maps:
        for plane in each:
            if plane.shape != maps[0][0].shape:
                refuse("maps", f"shape {maps[0][0].shape}", plane.shape)


def _require_rules(
    bins: int, smoothing: float, min_prominence: float, density_memory: float, surround_weight: float
) -> None:
    if bins < 2:
        refuse("bins", "2 to 65536", bins)
    if not smoothing > 0:
        refuse("smoothing", "a number above 0", float(smoothing))
    for name, share in (
        ("min_prominence", min_prominence),
        ("density_memory", density_memory),
        ("surround_weight", surround_weight),
    ):
        if not 0 <= share < 1:
            refuse(name, "a number in [0, 1)", float(share))
