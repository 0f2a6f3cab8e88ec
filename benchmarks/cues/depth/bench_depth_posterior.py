# SPDX-License-Identifier: MIT
"""P(target | depth) at 64x64 places of a room of 176x144: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Answer = tuple[Depth, NDArray[np.uint8]]


def script(depth: Depth, grid: Any, target: Any) -> Answer:
    """The baseline: nearest samples by remap, then whole planes."""
    (x0, y0, step, rows, columns), (expected, sigma, occluder_margin) = grid, target
    x = np.floor(x0 + (np.arange(columns) + 0.5) * step).astype(np.float32)
    y = np.floor(y0 + (np.arange(rows) + 0.5) * step).astype(np.float32)
    places = np.meshgrid(x, y)
    z = cv2.remap(depth, *places, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=np.nan)
    likelihood = cv2.exp(-0.5 * ((z - np.float32(expected)) / np.float32(sigma)) ** 2)
    posterior = np.where((z > 0) & (z < np.inf), likelihood / (likelihood + np.float32(0.1)), np.float32(0.5))
    return posterior, ((z > 0) & (z < expected - occluder_margin)).astype(np.uint8)


@pytest.mark.benchmark(group="depth_posterior, 64x64")
@pytest.mark.work(flops32=30 * 64 * 64, lookups=64 * 64, why="the samples, one by one")
@pytest.mark.parametrize(
    "judge",
    [_core.depth_posterior, reference.depth_posterior, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_posterior(benchmark: Any, judge: Callable[..., Answer], room: Depth) -> None:
    """All compute the same posteriors."""
    arguments = room, (40.3, -8.2, 1.7, 64, 64), (2.5, 0.3, 0.5)
    found, expected = benchmark(judge, *arguments), reference.depth_posterior(*arguments)
    assert_allclose(found[0], expected[0], atol=2e-6)
    assert_array_equal(found[1], expected[1])
    assert 0.05 < (found[0] > 0.5).mean() < 0.9
