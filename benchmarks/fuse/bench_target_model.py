# SPDX-License-Identifier: MIT
"""The target's model by three cues: native, reference, and a script on NumPy and SciPy's filter."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.ndimage import gaussian_filter1d
from tricue import _core, reference

BINS = 48
EXPECTED = [(1.4, 0.5, 3.0), (0.1, 0.5, 3.0), (7.8, 0.8, 6.0)]
RULES = (BINS, 1.5, 0.05, 0.8, 0.8)


def script(maps: Any, expected: Any, window: Any, blocks: Any, depth: Any, before: Any, rules: Any) -> Any:
    """The baseline: histograms by NumPy, smoothed; the peak is the highest bin."""
    x0, y0, x1, y1 = map(int, window)
    target = np.zeros(maps[0][0].shape, np.bool_)
    target[y0:y1, x0:x1] = True
    near = ~(np.abs(maps[-1][0] - depth[0]) > depth[1])
    densities, alternatives, peaks = [], [], []
    for i, ((values, weights), (value, _, half)) in enumerate(zip(maps, expected, strict=True)):
        ends = value - half, value + half
        mine = target & near if i < 2 else target
        found, around = (
            np.histogram(values[each], BINS, ends, weights=weights[each])[0] for each in (mine, ~target)
        )
        density = gaussian_filter1d(found, rules[1], mode="constant")
        density = rules[3] * before[0][i] + (1 - rules[3]) * density / density.sum()
        total = weights[~target & np.isfinite(values)].sum()
        smooth = gaussian_filter1d(around, rules[1], mode="constant") / total
        densities.append(density)
        alternatives.append(rules[4] * smooth + (1 - rules[4]) / BINS)
        peaks.append(ends[0] + (density.argmax() + 0.5) * 2 * half / BINS)
    return np.array(densities), np.array(alternatives), np.array(peaks)


IMPLEMENTATIONS = {"native": _core.target_model, "reference": reference.target_model, "baseline": script}


def check(benchmark: Any, target_model: Callable[..., Any], target: Any) -> None:
    """The twins agree; the baseline's peaks are the same within a bin, its alternatives within 1 %."""
    x0, y0, x1, y1 = target.window
    blocks = (np.array([[0.0, 0.0, x1 - x0, y1 - y0]]), (1.0, x0, y0, 0.0, 0.0)), np.array([1]), np.array([3])
    lows = [value - half for value, _, half in EXPECTED]
    former = np.full((3, BINS), 1 / BINS), lows, [value for value, _, _ in EXPECTED]
    maps = list(zip(target.planes, target.weights, strict=True))
    arguments = (maps, EXPECTED, target.window, blocks, (8.0, 1.0), former, RULES)
    densities, alternatives, peaks = benchmark(target_model, *arguments)
    expected = reference.target_model(*arguments)
    if target_model is script:
        assert (np.abs(peaks - expected[2]) <= [0.125, 0.125, 0.25]).all()
        assert_allclose(alternatives, expected[1], atol=0.01 * expected[1].max())
        return
    for one, other in zip((densities, alternatives, peaks), expected, strict=True):
        assert_allclose(one, other, rtol=1e-9, atol=1e-10)


@pytest.mark.benchmark(group="target_model, 160x120")
@pytest.mark.work(lookups=3 * 160 * 120, bytes=3 * 8 * 160 * 120, why="a sum at a time of the bins")
@pytest.mark.parametrize("target_model", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_model(benchmark: Any, target_model: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, target_model, small)
