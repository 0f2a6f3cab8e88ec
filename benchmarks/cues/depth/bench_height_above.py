# SPDX-License-Identifier: MIT
"""Height above the floor of a depth image of 176x144: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]


def script(depth: Depth, camera: Floats, plane: Floats) -> Depth:
    """The baseline: back-project all pixels, then one product."""
    fx, fy, cx, cy = camera.astype(np.float32)
    v, u = np.indices(depth.shape, np.float32)
    points = np.dstack([(u - cx) / fx * depth, (v - cy) / fy * depth, depth])
    return points @ plane[:3].astype(np.float32) + np.float32(plane[3])


@pytest.mark.benchmark(group="height_above")
@pytest.mark.parametrize(
    "height_above",
    [_core.height_above, reference.height_above, script],
    ids=["native", "reference", "baseline"],
)
def bench_height_above(benchmark: Any, height_above: Callable[..., Any], room: Depth, camera: Floats) -> None:
    """All give the same heights, within the rounding of float32."""
    floor = np.array([0.0, -1.0, 0.0, 1.0])
    height = benchmark(height_above, room, camera, floor)
    assert_allclose(height, reference.height_above(room, camera, floor), atol=1e-5)
