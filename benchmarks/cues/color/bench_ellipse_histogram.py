# SPDX-License-Identifier: MIT
"""4096 bins inside an ellipse of 30x36 pixels and in its ring: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Bins = NDArray[np.uint16]
Floats = NDArray[np.float64]


def script(bins: Bins, ellipses: Floats, size: int, margin: float) -> tuple[Floats, Floats]:
    """The baseline: masks from the equation of an ellipse, calcHist."""
    y, x = np.mgrid[: bins.shape[0], : bins.shape[1]] + 0.5
    x0, y0, minor, major = ellipses[0]
    distance = ((x - x0) / minor) ** 2 + ((y - y0) / major) ** 2
    masks = (distance <= 1, (distance > 1) & (distance <= margin**2))
    inside, around = (
        cv2.calcHist([bins], [0], mask.astype(np.uint8), [size], [0, size]).reshape(1, size) for mask in masks
    )
    return inside, around


@pytest.mark.benchmark(group="ellipse_histogram")
@pytest.mark.work(counts=1600, bytes=2 * 4 * 4096, why="rows of 30 pixels")
@pytest.mark.parametrize(
    "ellipse_histogram",
    [_core.ellipse_histogram, reference.ellipse_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_ellipse_histogram(
    benchmark: Any, ellipse_histogram: Callable[..., Any], region_bins: Bins, ellipse: Floats
) -> None:
    """All count the same."""
    arguments = (region_bins, ellipse[None], 4096, 1.4)
    counts = benchmark(ellipse_histogram, *arguments)
    assert_array_equal(counts, reference.ellipse_histogram(*arguments))
