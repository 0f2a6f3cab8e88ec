# SPDX-License-Identifier: MIT
"""The share of a depth image of 176x144, every other pixel, on a floor: native, reference, a NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
TOLERANCE, STEP = 0.04, 2


def script(depth: Depth, camera: Floats, plane: Floats, tolerance: float, step: int) -> Floats:
    """The baseline: back-projection of the thinned image, one product, two means."""
    fx, fy, cx, cy = camera.astype(np.float32) / step
    thin = depth[::step, ::step]
    v, u = np.indices(thin.shape, np.float32)
    points = np.dstack([(u - cx) / fx * thin, (v - cy) / fy * thin, thin])[thin > 0]
    height = points @ plane[:3].astype(np.float32) + np.float32(plane[3])
    return np.array([np.mean(abs(height) <= tolerance), np.mean(height < -3 * tolerance)])


@pytest.mark.benchmark(group="plane_support")
@pytest.mark.work(flops32=9 * 88 * 72, why="every other pixel")
@pytest.mark.parametrize(
    "plane_support",
    [_core.plane_support, reference.plane_support, script],
    ids=["native", "reference", "baseline"],
)
def bench_plane_support(
    benchmark: Any, plane_support: Callable[..., Any], room: Depth, camera: Floats
) -> None:
    """All count the same, except for up to two of 6000 pixels, which rounding moves across a limit."""
    arguments = room, camera, np.array([0.0, -1.0, 0.0, 1.0]), TOLERANCE, STEP
    support = benchmark(plane_support, *arguments)
    assert support[0] > 0.2
    assert_allclose(support, reference.plane_support(*arguments), rtol=0, atol=2 / 6000)
