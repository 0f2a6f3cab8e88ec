# SPDX-License-Identifier: MIT
"""256 levels of a depth image of 176x144: native, reference, and OpenCV's calcHist."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]


def script(depth: Depth, mask: Mask, near: float, far: float, levels: int) -> Depth:
    """The baseline: calcHist, which ignores values out of range, but counts NaN in the first level."""
    seen = mask & (depth > 0)
    return cv2.calcHist([depth], [0], seen, [levels], [near, far]).ravel()


@pytest.mark.benchmark(group="depth_histogram")
@pytest.mark.work(counts=176 * 144 * 7 // 10)
@pytest.mark.parametrize(
    "depth_histogram",
    [_core.depth_histogram, reference.depth_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_histogram(benchmark: Any, depth_histogram: Callable[..., Any], room: Depth) -> None:
    """All count the same, except for a few pixels whose level depends on rounding."""
    mask = (np.random.default_rng(1).random(room.shape) < 0.8).astype(np.uint8)
    counts = benchmark(depth_histogram, room, mask, 0.3, 7.5, 256)
    assert counts.sum() > 10_000
    assert abs(counts - reference.depth_histogram(room, mask, 0.3, 7.5, 256)).sum() <= 10
