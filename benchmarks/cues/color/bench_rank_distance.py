# SPDX-License-Identifier: MIT
"""Two rank maps against 251 samples of 100 ellipses: native, reference, and a script on OpenCV and NumPy."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Maps = NDArray[np.float32]


def script(samples: Image, models: Maps) -> Maps:
    """The baseline: a look-up table by calcHist and cumsum, channel by channel."""
    ellipses, _, n = samples.shape
    distances = np.empty((ellipses, len(models)), np.float32)
    ranks = np.empty((3, n), np.float32)
    for i in range(ellipses):
        for k in range(3):
            counts = cv2.calcHist([samples[i, k]], [0], None, [256], [0, 256]).ravel()
            ranks[k] = ((np.cumsum(counts) - counts / 2) / n)[samples[i, k]]
        distances[i] = 2 * np.abs(ranks - models).mean(axis=(1, 2))
    return distances


@pytest.mark.benchmark(group="rank_distance")
@pytest.mark.work(counts=100 * 3 * 251)
@pytest.mark.parametrize(
    "rank_distance",
    [_core.rank_distance, reference.rank_distance, script],
    ids=["native", "reference", "baseline"],
)
def bench_rank_distance(benchmark: Any, rank_distance: Callable[..., Any], samples: Image) -> None:
    """All measure the same."""
    models = np.random.default_rng(2).random((2, 3, samples.shape[2]), np.float32)
    distances = benchmark(rank_distance, samples, models)
    # The script doesn't round the models to the ranks that 251 samples can have.
    assert_allclose(distances, reference.rank_distance(samples, models), rtol=0, atol=0.5 / 251)
