# SPDX-License-Identifier: MIT
"""Distances along the ground in a room of 176x144: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]


def script(depth: Depth, camera: Floats, up: Floats, near: float, far: float) -> Depth:
    """The baseline: factors by broadcasting, then OpenCV's arithmetic."""
    fx, fy, cx, cy = camera
    ahead = np.array([0.0, 0.0, 1.0]) - up[2] * up
    ahead /= np.linalg.norm(ahead)
    x, y = (np.arange(depth.shape[1]) - cx) / fx, (np.arange(depth.shape[0]) - cy) / fy
    factors = (ahead[0] * x + (ahead[1] * y + ahead[2])[:, None]).astype(np.float32)
    distance = cv2.multiply(depth, factors)
    return np.asarray(np.clip(distance, np.float32(near), np.nextafter(np.float32(far), np.float32(0))))


@pytest.mark.benchmark(group="ground_distance, 176x144")
@pytest.mark.work(bytes=8 * 176 * 144, flops32=4 * 176 * 144)
@pytest.mark.parametrize(
    "measure",
    [_core.ground_distance, reference.ground_distance, script],
    ids=["native", "reference", "baseline"],
)
def bench_ground_distance(benchmark: Any, measure: Callable[..., Depth], room: Depth, camera: Floats) -> None:
    """All measure the same."""
    arguments = room, camera, np.array([0.0, -0.9, -(0.19**0.5)]), 0.5, 8.0
    assert_allclose(benchmark(measure, *arguments), reference.ground_distance(*arguments), rtol=1e-6)
