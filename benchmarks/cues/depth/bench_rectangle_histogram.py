# SPDX-License-Identifier: MIT
"""The histogram of a rectangle's depths at 140 places: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid

Floats = NDArray[np.float64]


def script(
    depth: NDArray[np.float32], rectangle: Floats, levels: int, pattern: Floats, reach: float
) -> Floats:
    """The baseline: indexing, a difference and numpy.histogram."""
    x, y, width, height, z = rectangle
    rows = np.clip((y + height / 2 * pattern[:, 1]).astype(int), 0, depth.shape[0] - 1)
    columns = np.clip((x + width / 2 * pattern[:, 0]).astype(int), 0, depth.shape[1] - 1)
    counts, _ = np.histogram(depth[rows, columns].astype(float) - z, levels, (-reach, reach))
    return np.asarray(counts / max(counts.sum(), 1))


@pytest.mark.benchmark(group="rectangle_histogram")
@pytest.mark.work(lookups=140, counts=140, why="the call takes a third")
@pytest.mark.parametrize(
    "rectangle_histogram",
    [_core.rectangle_histogram, reference.rectangle_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_rectangle_histogram(benchmark: Any, rectangle_histogram: Callable[..., Floats]) -> None:
    """All count the same."""
    depth = np.random.default_rng(0).uniform(2.6, 3.4, (144, 176)).astype(np.float32)
    arguments = (depth, np.array([90.0, 70.0, 25.0, 75.0, 3.0]), 64, grid(14, 10), 0.5)
    histogram = benchmark(rectangle_histogram, *arguments)
    assert_array_equal(histogram, reference.rectangle_histogram(*arguments))
