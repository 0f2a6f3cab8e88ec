# SPDX-License-Identifier: MIT
"""Edges of a depth image of 176x144: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
GAP, SLOPE = 0.1, 0.02


def script(depth: Depth, gap: float, slope: float) -> NDArray[np.uint8]:
    """The baseline: the minimum of 3x3 pixels by erosion, then NumPy."""
    nearest = cv2.erode(np.where(depth > 0, depth, np.float32(1e9)), np.ones((3, 3), np.uint8))
    return (depth - nearest > np.float32(gap) + np.float32(slope) * (nearest * nearest)).view(np.uint8)


@pytest.mark.benchmark(group="depth_edges")
@pytest.mark.work(bytes=5 * 176 * 144, flops32=8 * 176 * 144, why="rows of 176")
@pytest.mark.parametrize(
    "depth_edges", [_core.depth_edges, reference.depth_edges, script], ids=["native", "reference", "baseline"]
)
def bench_depth_edges(benchmark: Any, depth_edges: Callable[..., Any], room: Depth) -> None:
    """All find the same edges."""
    edges = benchmark(depth_edges, room, GAP, SLOPE)
    assert edges.sum() > 50
    assert_array_equal(edges, reference.depth_edges(room, GAP, SLOPE))
