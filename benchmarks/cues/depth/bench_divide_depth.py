# SPDX-License-Identifier: MIT
"""Six divisions of a depth image of 176x144: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]
DIVIDERS = np.array([0.3, 1.5, 2.2, 2.9, 3.7, 4.6, 7.5])


def script(depth: Depth, mask: Mask, dividers: NDArray[np.float64]) -> Mask:
    """The baseline: numpy.digitize."""
    labels = np.digitize(depth, dividers).astype(np.uint8)
    labels[(labels == len(dividers)) | (mask == 0)] = 0
    return labels


@pytest.mark.benchmark(group="divide_depth")
@pytest.mark.work(bytes=6 * 176 * 144, flops32=7 * 176 * 144, why="a pass for each divider")
@pytest.mark.parametrize(
    "divide_depth",
    [_core.divide_depth, reference.divide_depth, script],
    ids=["native", "reference", "baseline"],
)
def bench_divide_depth(benchmark: Any, divide_depth: Callable[..., Any], room: Depth) -> None:
    """All give the same labels."""
    mask = (np.random.default_rng(1).random(room.shape) < 0.8).astype(np.uint8)
    labels = benchmark(divide_depth, room, mask, DIVIDERS)
    assert_array_equal(labels, reference.divide_depth(room, mask, DIVIDERS))
