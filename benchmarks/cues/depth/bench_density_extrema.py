# SPDX-License-Identifier: MIT
"""Extrema of a density of 256 levels: native, reference, and a script on SciPy's find_peaks."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from scipy.signal import find_peaks
from tricue import _core, reference

Floats = NDArray[np.float64]
PROMINENCE = 2e-4


def script(density: Floats, prominence: float) -> tuple[Any, Any]:
    """The baseline: find_peaks on the zero-padded density, and the minimum between each two peaks."""
    maxima = find_peaks(np.pad(density, 1), prominence=prominence)[0] - 1
    minima = [a + density[a:b].argmin() for a, b in pairwise(maxima)]
    return maxima, np.array(minima, np.int64)


@pytest.mark.benchmark(group="density_extrema")
@pytest.mark.work(flops64=2 * 256, why="levels are searched one by one")
@pytest.mark.parametrize(
    "density_extrema",
    [_core.density_extrema, reference.density_extrema, script],
    ids=["native", "reference", "baseline"],
)
def bench_density_extrema(benchmark: Any, density_extrema: Callable[..., Any]) -> None:
    """All find the same levels."""
    histogram = np.random.default_rng(0).poisson(np.linspace(0, 300, 256) % 80).astype(float)
    density = reference.depth_density(histogram, 4.0)
    found = benchmark(density_extrema, density, PROMINENCE)
    assert len(found[0]) > 2
    for ours, expected in zip(found, reference.density_extrema(density, PROMINENCE), strict=True):
        assert_array_equal(ours, expected)
