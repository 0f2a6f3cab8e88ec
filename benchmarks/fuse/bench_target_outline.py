# SPDX-License-Identifier: MIT
"""The outline of the target's pixels in 200 blocks: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tricue import _core, reference


def script(mask: Any, disparity: Any, grid: Any, states: Any, target: float, tolerance: float) -> Any:
    """The baseline: slices, and sorted coordinates."""
    corners, (size, x, y, left, top) = grid
    blocks = np.ceil(corners * size + [x - left, y - top] * 2 - 0.5).astype(int)
    mine = np.zeros(mask.shape, np.bool_)
    for x0, y0, x1, y1 in blocks[states == 1].tolist():
        mine[y0:y1, x0:x1] = True
    mine &= (mask != 0) | (np.abs(disparity - target) <= tolerance)
    ys, xs = map(np.sort, np.nonzero(mine))
    out = int(0.02 * len(xs))
    return tuple(map(int, (xs[out], ys[out], xs[-1 - out] + 1, ys[-1 - out] + 1))), len(xs)


IMPLEMENTATIONS = {"native": _core.target_outline, "reference": reference.target_outline, "baseline": script}


@pytest.mark.benchmark(group="target_outline, 160x120")
@pytest.mark.work(bytes=5 * 160 * 120, why="blocks one after the other; columns sorted by counts")
@pytest.mark.parametrize("target_outline", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_target_outline(benchmark: Any, target_outline: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper: all give the same, exactly."""
    x0, y0, x1, y1 = small.window
    i, j = (each.ravel() for each in np.meshgrid(np.arange(10), np.arange(20)))
    left, top = i * (x1 - x0) / 10, j * (y1 - y0) / 20
    corners = np.stack([left, top, left + (x1 - x0) / 10, top + (y1 - y0) / 20], axis=1)
    states = np.random.default_rng(0).integers(0, 3, len(corners))
    arguments = (small.mask, small.planes[2], (corners, (1.0, x0, y0, 0.0, 0.0)), states, 8.0, 0.5)
    found = benchmark(target_outline, *arguments)
    assert found[1] > 300
    assert found == reference.target_outline(*arguments)
