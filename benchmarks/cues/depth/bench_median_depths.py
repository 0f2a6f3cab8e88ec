# SPDX-License-Identifier: MIT
"""Depths of six targets in a room of 176x144, 48x48 samples each: native, reference, a script on OpenCV."""

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

BOXES = np.array([[90.0 + 2 * i, 60.0 - i, 30.0 + i, 40.0] for i in range(6)])


def script(depth: Depth, boxes: Floats, samples: int, expected: float, offset: float, share: float) -> Floats:
    """The baseline: nearest samples by remap, masks and NumPy's medians, near a given expected depth."""
    found = np.full((len(boxes), 3), np.nan)
    halves = 2 * ((np.arange(samples) + 0.5) / samples - 0.5)
    for i, (x, y, width, height) in enumerate(boxes):
        side = max(width, height)
        across, down = (np.floor(c + halves * side / 2).astype(np.float32) for c in (x, y))
        inside = np.add.outer((halves * side / height) ** 2, (halves * side / width) ** 2) <= 1
        z = cv2.remap(depth, *np.meshgrid(across, down), cv2.INTER_NEAREST, borderValue=np.nan)[inside]
        near = z[abs(z - expected) < offset]
        if len(near) and len(near) >= share * len(z):
            middle = np.median(near)
            found[i] = middle, 1.4826 * np.median(abs(near - middle)), len(near) / len(z)
    return found


@pytest.mark.benchmark(group="median_depths, 6 boxes")
@pytest.mark.work(lookups=6 * 1800, counts=6 * 1800, why="each median, bin by bin")
@pytest.mark.parametrize(
    "measure",
    [_core.median_depths, reference.median_depths, script],
    ids=["native", "reference", "baseline"],
)
def bench_median_depths(benchmark: Any, measure: Callable[..., Floats], room: Depth) -> None:
    """All measure the same."""
    arguments = room, BOXES, 48, 2.5, 0.2, 0.1
    found, expected = benchmark(measure, *arguments), reference.median_depths(*arguments)
    assert_allclose(found, expected, atol=1e-5)
    assert (expected[:, 2] > 0.5).all()
