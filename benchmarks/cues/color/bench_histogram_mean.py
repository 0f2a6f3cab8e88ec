# SPDX-License-Identifier: MIT
"""The mean color of 4096 bins: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
SPACE = (32, 32, 4), 64


def script(histogram: Floats, space: tuple[tuple[int, int, int], int]) -> Floats:
    """The baseline: the marginals, one tensor product per axis."""
    bins, chroma = space
    cube = histogram.reshape(bins)
    chromas = [-chroma + (np.arange(n) + 0.5) * 2 * chroma / n - 0.5 for n in bins[:2]]
    light = (np.arange(bins[2]) + 0.5) * 766 / bins[2] - 0.5
    marginals = (cube.sum(axis=(1, 2)), cube.sum(axis=(0, 2)), cube.sum(axis=(0, 1)))
    return np.array([m @ c for m, c in zip(marginals, (*chromas, light), strict=True)]) / histogram.sum()


@pytest.mark.benchmark(group="histogram_mean")
@pytest.mark.work(bytes=8 * 4096, flops64=3 * 4096, why="sums in one order")
@pytest.mark.parametrize(
    "histogram_mean",
    [_core.histogram_mean, reference.histogram_mean, script],
    ids=["native", "reference", "baseline"],
)
def bench_histogram_mean(
    benchmark: Any, histogram_mean: Callable[..., Floats], region_bins: NDArray[np.uint16]
) -> None:
    """All find the same mean."""
    histogram = np.bincount(region_bins.ravel(), minlength=4096).astype(np.float64)
    mean = benchmark(histogram_mean, histogram, SPACE)
    assert_allclose(mean, reference.histogram_mean(histogram, SPACE), rtol=0, atol=1e-9)
