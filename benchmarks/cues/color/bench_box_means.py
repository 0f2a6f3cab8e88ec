# SPDX-License-Identifier: MIT
"""Means of a map in 13 boxes: native, reference, and OpenCV's integral image."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]

PLANE = np.random.default_rng(0).random((64, 64)).astype(np.float32)
MIDDLE = 33.7, 30.2
STEPS = 1.03 ** np.arange(-6, 7)


def script(plane: NDArray[np.float32], x: float, y: float, widths: Floats, heights: Floats) -> Floats:
    """Do it as one would without the kernel: corners between pixels are read from the integral image."""
    integral = cv2.integral(plane, sdepth=cv2.CV_64F).astype(np.float32)
    rows, columns = plane.shape
    left, right = (np.clip(x + side * widths / 2, 0, columns) for side in (-1, 1))
    top, bottom = (np.clip(y + side * heights / 2, 0, rows) for side in (-1, 1))
    across = np.stack([left, right, left, right]).astype(np.float32)
    down = np.stack([top, top, bottom, bottom]).astype(np.float32)
    corners = cv2.remap(integral, across, down, cv2.INTER_LINEAR).astype(np.float64)
    return (corners[3] - corners[2] - corners[1] + corners[0]) / (widths * heights)


IMPLEMENTATIONS = {"native": _core.box_means, "reference": reference.box_means, "baseline": script}


@pytest.mark.benchmark(group="box_means, 64x64")
@pytest.mark.parametrize("means_of", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_box_means(benchmark: Any, means_of: Callable[..., Floats]) -> None:
    """All agree; remap's places are rounded to 1/32 pixel, which is a hundredth of a box."""
    found = benchmark(means_of, PLANE, *MIDDLE, 23.4 * STEPS, 30.1 * STEPS)
    expected = reference.box_means(PLANE, *MIDDLE, 23.4 * STEPS, 30.1 * STEPS)
    assert_allclose(found, expected, atol=0.01 if means_of is script else 1e-9)
