# SPDX-License-Identifier: MIT
"""An ellipse of 30x36 pixels at 17x9 places over 4096 bins: native, reference, and a NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Bins = NDArray[np.uint16]
Floats = NDArray[np.float64]

GRID, MARGIN, WEIGHTS, MIN_MARKED = (9, 17, 1), 1.4, (0.6, 0.4, 0.5), 8


def script(
    bins: Bins, ellipse: Floats, grid: Any, model: Floats, margin: float, mask: Any, weights: Any, least: int
) -> tuple[int, int, float, float, float, Floats]:
    """The baseline: the native search, then NumPy for the scores and colors."""
    measured = _core.ellipse_search(bins, ellipse, grid, model, margin, mask)
    ring, depth, depth_ring = weights
    scores = measured[..., 0] - ring * measured[..., 1]
    scores += depth * (measured[..., 2] - depth_ring * measured[..., 3])
    row, col = (int(each) for each in np.unravel_index(scores.argmax(), scores.shape))
    place = ellipse + [col - grid[1] // 2, row - grid[0] // 2, 0, 0]
    y, x = np.mgrid[: bins.shape[0], : bins.shape[1]] + 0.5
    inside = ((x - place[0]) / place[2]) ** 2 + ((y - place[1]) / place[3]) ** 2 <= 1
    counts = np.bincount(bins[inside & (mask != 0)], minlength=model.size)
    best = measured[row, col]
    return row, col, float(scores[row, col]), float(best[0]), float(best[2]), counts / counts.sum()


@pytest.mark.benchmark(group="best_ellipse")
@pytest.mark.work(counts=1600 + 153 * 2 * (36 + 50))
@pytest.mark.parametrize(
    "best_ellipse",
    [_core.best_ellipse, reference.best_ellipse, script],
    ids=["native", "reference", "baseline"],
)
def bench_best_ellipse(
    benchmark: Any, best_ellipse: Callable[..., Any], region_bins: Bins, ellipse: Floats, model: Floats
) -> None:
    """All find the same place, with the same colors."""
    mask = np.ones_like(region_bins, np.uint8)
    arguments = (region_bins, ellipse, GRID, model, MARGIN, mask, WEIGHTS, MIN_MARKED)
    found, expected = benchmark(best_ellipse, *arguments), reference.best_ellipse(*arguments)
    assert found[:2] == expected[:2]
    assert_array_equal(found[5], expected[5])
