# SPDX-License-Identifier: MIT
"""The three weighted histograms of a frame, 64 bins each: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]
Histogram = Callable[..., NDArray[np.float64]]
RANGES = [(-4.0, 4.0), (-4.0, 4.0), (0.0, 16.0)]


def script(
    values: Plane, weights: Plane, region: Any, low: float, high: float, bins: int, mask: NDArray[np.uint8]
) -> NDArray[np.float64]:
    """The baseline: NumPy's histogram, because OpenCV's has no weights."""
    x0, y0, x1, y1 = map(int, region)
    part = np.s_[y0:y1, x0:x1]
    seen = (mask[part] > 0) & np.isfinite(values[part])
    return np.histogram(values[part][seen], bins, (low, high), weights=weights[part][seen])[0]


def run(histogram: Histogram, target: Any, mask: NDArray[np.uint8]) -> list[NDArray[np.float64]]:
    """The histograms of u, v and d."""
    return [
        histogram(values, weights, target.window, *limits, 64, mask)
        for values, weights, limits in zip(target.planes, target.weights, RANGES, strict=True)
    ]


IMPLEMENTATIONS = {
    "native": _core.weighted_histogram,
    "reference": reference.weighted_histogram,
    "baseline": script,
}


def check(benchmark: Any, histogram: Histogram, target: Any) -> None:
    """All sum the same, except for a few values whose bin depends on rounding."""
    mask = (np.random.default_rng(1).random(target.mask.shape) < 0.8).astype(np.uint8)
    found = benchmark(run, histogram, target, mask)
    for ours, theirs in zip(found, run(reference.weighted_histogram, target, mask), strict=True):
        assert theirs.sum() > 500
        assert abs(ours - theirs).sum() < 1e-4 * theirs.sum() + 2


@pytest.mark.benchmark(group="weighted_histogram, 3 of 160x120")
@pytest.mark.work(counts=3 * 40 * 60 // 2, why="sums in one order")
@pytest.mark.parametrize("histogram", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_weighted_histogram(benchmark: Any, histogram: Histogram, small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, histogram, small)


@pytest.mark.benchmark(group="weighted_histogram, 3 of 640x480")
@pytest.mark.work(counts=3 * 160 * 240 // 2, why="sums in one order")
@pytest.mark.parametrize("histogram", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_weighted_histogram_of_many(benchmark: Any, histogram: Histogram, large: Any) -> None:
    """In a frame of 640x480."""
    check(benchmark, histogram, large)
