# SPDX-License-Identifier: MIT
"""Histograms of 16 bins of 100 ellipses: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(samples: Image, bins: int) -> NDArray[np.float32]:
    """The baseline: calcHist, plane by plane."""
    ellipses, _, n = samples.shape
    histograms = np.empty((ellipses, 3, bins), np.float32)
    for i in range(ellipses):
        for k in range(3):
            histograms[i, k] = cv2.calcHist([samples[i, k]], [0], None, [bins], [0, 256]).ravel() / n
    return histograms.reshape(ellipses, 3 * bins)


@pytest.mark.benchmark(group="color_histogram")
@pytest.mark.work(counts=100 * 3 * 251)
@pytest.mark.parametrize(
    "color_histogram",
    [_core.color_histogram, reference.color_histogram, script],
    ids=["native", "reference", "baseline"],
)
def bench_color_histogram(benchmark: Any, color_histogram: Callable[..., Any], samples: Image) -> None:
    """All count the same."""
    histograms = benchmark(color_histogram, samples, 16)
    assert_allclose(histograms, reference.color_histogram(samples, 16), rtol=1e-6)
