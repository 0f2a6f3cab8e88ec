# SPDX-License-Identifier: MIT
"""The best of 32 windows around an ellipse: native, reference, and a script on OpenCV and NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid, ring

from benchmarks.cues.color import bench_rank_likelihood

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]


def script(image: Image, ellipse: Floats, offsets: Floats, *look: Any) -> tuple[Floats, float, float]:
    """The baseline: that of rank_likelihood, and the maximum."""
    moved = np.hstack([ellipse[:2] + ellipse[2:] * offsets[:, :2], ellipse[2:] * offsets[:, 2:]])
    windows = np.vstack([ellipse, moved])
    log_likelihood = bench_rank_likelihood.script(image, windows, *look)
    best = log_likelihood.argmax()
    return windows[best], log_likelihood[best], log_likelihood[0]


@pytest.mark.benchmark(group="rank_search")
@pytest.mark.work(counts=32 * 3 * 96, lookups=2 * 32 * (96 + 40))
@pytest.mark.parametrize(
    "rank_search", [_core.rank_search, reference.rank_search, script], ids=["native", "reference", "baseline"]
)
def bench_rank_search(benchmark: Any, rank_search: Callable[..., Any], frame: Image) -> None:
    """The twins agree; the script rounds places to 1/32 pixel, which moves a few samples by a pixel."""
    rng = np.random.default_rng(0)
    offsets = np.hstack([rng.normal(0, 0.4, (31, 2)), np.exp(rng.normal(0, 0.05, (31, 2)))])
    maps, table = rng.random((2, 3, 96), np.float32), rng.random((16, 16, 16), np.float32)
    pattern, appearance = (grid(12, 8), ring(40, 1.3, 1.8)), (maps, np.array([0.6, 0.4]), False, table)
    arguments = frame, np.array([160.0, 120.0, 25.0, 31.0]), offsets, pattern, appearance, (110.0, 8.0)
    _, highest, here = benchmark(rank_search, *arguments)
    _, expected, expected_here = reference.rank_search(*arguments)
    near = 0.02 * (2 * 110 + 2 * 8) if rank_search is script else 1e-11
    assert_allclose([highest, here], [expected, expected_here], rtol=0, atol=near)
