# SPDX-License-Identifier: MIT
"""The target's part of a histogram of 64 bins: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
RIPPLE = 0.05


def script(
    histogram: Floats, smoothing: float, min_prominence: float, expected: float, spread: float
) -> tuple[Floats, float]:
    """The baseline: blurred as an image of one row, then a search for the minimum on each side."""
    size = (2 * int(np.ceil(4 * smoothing)) + 1, 1)
    smooth, ones = (
        cv2.GaussianBlur(values[None], size, smoothing, borderType=cv2.BORDER_CONSTANT)[0]
        for values in (histogram, np.ones(len(histogram)))
    )
    smooth /= ones
    values = smooth
    if not np.isnan(expected):
        values = smooth * np.exp(-0.5 * ((np.arange(len(smooth)) + 0.5 - expected) / spread) ** 2)
    top = int(values.argmax())
    before, at, after = values[top - 1 : top + 2]
    peak = top + (before - after) / (2 * (before - 2 * at + after))
    density, at = smooth.copy(), smooth[top]
    for step in (-1, 1):
        least = i = top
        while 0 <= i < len(smooth) and smooth[i] <= smooth[least] + min_prominence * at:
            least = i if smooth[i] < smooth[least] else least
            i += step
        if 0 <= i < len(smooth):
            slope = (smooth[least] - at) / (least - peak)
            beyond = np.arange(len(smooth))[least + 1 :] if step > 0 else np.arange(least)
            density[beyond] = np.maximum(at + slope * (beyond - peak), 0)
    return density / density.sum(), peak + 0.5


IMPLEMENTATIONS = {
    "native": _core.target_distribution,
    "reference": reference.target_distribution,
    "baseline": script,
}


def check(benchmark: Any, target_distribution: Callable[..., Any], expected: float) -> float:
    """All cut the same histogram of three bumps on both sides, within rounding; returns the peak."""
    bins = np.arange(64)
    bumps = [(300, 30, 3), (120, 18, 3), (150, 45, 4)]
    histogram = sum(weight * np.exp(-0.5 * ((bins - mean) / width) ** 2) for weight, mean, width in bumps)
    histogram = np.random.default_rng(0).poisson(histogram).astype(float)
    arguments = histogram, 1.5, RIPPLE, expected, 8.0
    density, peak = benchmark(target_distribution, *arguments)
    theirs = reference.target_distribution(*arguments)
    assert_allclose(density, theirs[0], rtol=1e-9, atol=1e-12)
    assert_allclose(peak, theirs[1], rtol=1e-9)
    assert np.count_nonzero(density < 1e-3) > 20
    return float(peak)


@pytest.mark.benchmark(group="target_distribution")
@pytest.mark.work(flops64=64 * 6 * 4, why="the call, and bins searched one by one")
@pytest.mark.parametrize("target_distribution", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_distribution(benchmark: Any, target_distribution: Callable[..., Any]) -> None:
    """The highest of three bumps."""
    assert abs(check(benchmark, target_distribution, np.nan) - 30.5) < 1


@pytest.mark.benchmark(group="target_distribution, expected")
@pytest.mark.work(flops64=64 * (6 * 4 + 20), why="the call, and bins searched one by one")
@pytest.mark.parametrize("target_distribution", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_distribution_expected(benchmark: Any, target_distribution: Callable[..., Any]) -> None:
    """A lower bump, at the expected place."""
    assert abs(check(benchmark, target_distribution, 46.0) - 45.5) < 1
