# SPDX-License-Identifier: MIT
"""The cells at a head's disparity, 60x56: native, reference, and a script on cv2.boxFilter."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]


def baseline(disparities: Plane, expected: float, tolerance: float, window: int) -> NDArray[np.uint8]:
    """Votes on small integers, summed by cv2."""
    off = np.abs(disparities - np.float32(expected))
    near, beyond = off <= np.float32(tolerance), off > np.float32(tolerance)
    votes = (near.view(np.int8) - beyond.view(np.int8)).astype(np.int16)
    majority = cv2.boxFilter(votes, -1, (window, window), normalize=False, borderType=cv2.BORDER_CONSTANT)
    return np.asarray(near | ((majority > 0) > beyond)).view(np.uint8)


@pytest.mark.benchmark(group="coherent_cells, 60x56")
@pytest.mark.work(flops32=3 * 60 * 56, ops8=2 * 6 * 60 * 56, why="a running sum along each row")
@pytest.mark.parametrize(
    "coherent_cells",
    [_core.coherent_cells, reference.coherent_cells, baseline],
    ids=["native", "reference", "baseline"],
)
def bench_coherent_cells(benchmark: Any, coherent_cells: Callable[..., Any]) -> None:
    """All choose the same cells."""
    rng = np.random.default_rng(0)
    disparities = rng.choice(np.array([5, 5.5, 9, np.nan], np.float32), (56, 60))
    arguments = (disparities, 5.0, 0.75, 7)
    assert_array_equal(benchmark(coherent_cells, *arguments), reference.coherent_cells(*arguments))
