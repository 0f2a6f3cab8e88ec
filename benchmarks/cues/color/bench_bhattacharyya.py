# SPDX-License-Identifier: MIT
"""Bhattacharyya distance of 100 histograms of 3 x 16 bins: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(histograms: NDArray[np.float32], model: NDArray[np.float32], groups: int) -> NDArray[np.float64]:
    """The baseline: compareHist for each histogram and channel; the squares are averaged."""
    split, target = histograms.reshape(len(histograms), groups, -1), model.reshape(groups, -1)
    squares = [
        [cv2.compareHist(row[k], target[k], cv2.HISTCMP_BHATTACHARYYA) ** 2 for k in range(groups)]
        for row in split
    ]
    result: NDArray[np.float64] = np.sqrt(np.mean(squares, axis=1))
    return result


@pytest.mark.benchmark(group="bhattacharyya")
@pytest.mark.work(bytes=4 * 100 * 48, divs64=100 * 48)
@pytest.mark.parametrize(
    "bhattacharyya",
    [_core.bhattacharyya, reference.bhattacharyya, script],
    ids=["native", "reference", "baseline"],
)
def bench_bhattacharyya(benchmark: Any, bhattacharyya: Callable[..., Any], samples: Image) -> None:
    """All measure the same; near 0 the square root amplifies the rounding of float histograms."""
    histograms = reference.color_histogram(samples, 16)
    distances = benchmark(bhattacharyya, histograms, histograms[0], 3)
    assert_allclose(
        distances**2, reference.bhattacharyya(histograms, histograms[0], 3) ** 2, rtol=0, atol=1e-6
    )
