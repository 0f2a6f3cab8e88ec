# SPDX-License-Identifier: MIT
"""Density of 256 depth levels, bandwidth 4: native, reference, and OpenCV's GaussianBlur."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
BANDWIDTH = 4.0


def script(histogram: Floats, bandwidth: float) -> Floats:
    """The baseline: the histogram as an image of one row, blurred."""
    size = (2 * int(np.ceil(4 * bandwidth)) + 1, 1)
    shares = histogram[None] / histogram.sum()
    return cv2.GaussianBlur(shares, size, bandwidth, borderType=cv2.BORDER_REFLECT)[0]


@pytest.mark.benchmark(group="depth_density")
@pytest.mark.work(flops64=2 * 33 * 256, why="the Gaussian's weights and the mirrored ends")
@pytest.mark.parametrize(
    "depth_density",
    [_core.depth_density, reference.depth_density, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_density(benchmark: Any, depth_density: Callable[..., Any]) -> None:
    """All have the same density, within rounding."""
    histogram = np.random.default_rng(0).poisson(np.linspace(0, 300, 256) % 80).astype(float)
    density = benchmark(depth_density, histogram, BANDWIDTH)
    assert_allclose(density, reference.depth_density(histogram, BANDWIDTH), rtol=1e-12)
