# SPDX-License-Identifier: MIT
"""Where a depth image of 176x144 differs from an earlier one: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
NOISE, SLOPE = 0.02, 0.005


def script(depth: Depth, before: Depth, noise: float, slope: float) -> NDArray[np.uint8]:
    """The baseline: a difference and a limit by OpenCV, compared by NumPy."""
    limit = cv2.multiply(cv2.multiply(depth, slope), depth) + np.float32(noise)
    same = cv2.absdiff(depth, before) <= limit
    return (~same).view(np.uint8)


@pytest.mark.benchmark(group="changed_depth")
@pytest.mark.work(bytes=9 * 176 * 144, flops32=5 * 176 * 144)
@pytest.mark.parametrize(
    "changed_depth",
    [_core.changed_depth, reference.changed_depth, script],
    ids=["native", "reference", "baseline"],
)
def bench_changed_depth(benchmark: Any, changed_depth: Callable[..., Any], room: Depth) -> None:
    """All find the same pixels, except for a few next to the limit."""
    before = room + np.random.default_rng(1).normal(0, 0.03, room.shape).astype(np.float32)
    changed = benchmark(changed_depth, room, before, NOISE, SLOPE)
    different = changed != reference.changed_depth(room, before, NOISE, SLOPE)
    assert different.mean() < 1e-3
    if changed_depth is not script:
        assert_array_equal(different, False)
