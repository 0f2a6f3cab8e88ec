# SPDX-License-Identifier: MIT
"""The part of a depth image of 176x144 above the floor: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
NEAR, FAR, CLEAR = 0.3, 7.5, 0.12


def script(depth: Depth, camera: Floats, plane: Floats, near: float, far: float, clear: float) -> Depth:
    """The baseline: back-projection of all pixels, one product, and np.where."""
    fx, fy, cx, cy = camera.astype(np.float32)
    v, u = np.indices(depth.shape, np.float32)
    points = np.dstack([(u - cx) / fx * depth, (v - cy) / fy * depth, depth])
    height = points @ plane[:3].astype(np.float32) + np.float32(plane[3])
    return np.where((height > clear) & (depth >= near) & (depth < far), depth, np.float32(np.nan))


@pytest.mark.benchmark(group="above_floor")
@pytest.mark.work(bytes=8 * 176 * 144, flops32=8 * 176 * 144)
@pytest.mark.parametrize(
    "above_floor", [_core.above_floor, reference.above_floor, script], ids=["native", "reference", "baseline"]
)
def bench_above_floor(benchmark: Any, above_floor: Callable[..., Any], room: Depth, camera: Floats) -> None:
    """All keep the same pixels, none of which is within float32's rounding of the limit."""
    arguments = room, camera, np.array([0.0, -1.0, 0.0, 1.0]), NEAR, FAR, CLEAR
    kept = benchmark(above_floor, *arguments)
    assert_array_equal(kept, reference.above_floor(*arguments))
    assert 0.2 < np.isfinite(kept).mean() < 0.9
