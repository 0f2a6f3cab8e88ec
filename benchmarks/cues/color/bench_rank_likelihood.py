# SPDX-License-Identifier: MIT
"""The likelihoods of 100 ellipses: native, reference, and a script on OpenCV and NumPy."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid, ring

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


def script(
    image: Image,
    ellipses: Floats,
    pattern: tuple[Floats, Floats],
    appearance: tuple[Singles, Floats, bool, Singles],
    factors: tuple[float, float],
) -> Floats:
    """The baseline: remap reads the pixels, calcHist and cumsum rank them, a table is indexed."""
    inside, _ = pattern
    maps, shares, _, table = appearance
    sharpness, contrast_weight = factors
    cells = (image >> 4).astype(np.int32)
    likely = table[cells[..., 0], cells[..., 1], cells[..., 2]]
    means = []
    for offsets in pattern:
        places = (ellipses[:, None, :2] + ellipses[:, None, 2:] * offsets - 0.5).astype(np.float32)
        means.append(cv2.remap(likely, places, None, cv2.INTER_NEAREST).mean(axis=1))
        if offsets is inside:
            samples = cv2.remap(image, places, None, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
    n = len(inside)
    distances = np.empty((len(ellipses), len(maps)))
    ranks = np.empty((3, n), np.float32)
    for i in range(len(ellipses)):
        for k in range(3):
            levels = np.ascontiguousarray(samples[i, :, k])
            counts = cv2.calcHist([levels], [0], None, [256], [0, 256]).ravel()
            ranks[k] = ((np.cumsum(counts) - counts / 2) / n)[levels]
        distances[i] = 2 * np.abs(ranks - maps).mean(axis=(1, 2))
    distance = distances @ shares
    log_likelihood: Floats = contrast_weight * (means[0] - means[1]) - sharpness * distance**2
    return log_likelihood


@pytest.mark.benchmark(group="rank_likelihood")
@pytest.mark.work(counts=100 * 3 * 96, lookups=2 * 100 * (96 + 40))
@pytest.mark.parametrize(
    "rank_likelihood",
    [_core.rank_likelihood, reference.rank_likelihood, script],
    ids=["native", "reference", "baseline"],
)
def bench_rank_likelihood(benchmark: Any, rank_likelihood: Callable[..., Any], frame: Image) -> None:
    """The twins agree; the script rounds places to 1/32 pixel, which moves a few samples by a pixel."""
    rng = np.random.default_rng(0)
    ellipses = rng.normal([160, 120, 25, 31], [20, 20, 1, 1], (100, 4))
    maps, table = rng.random((2, 3, 96), np.float32), rng.random((16, 16, 16), np.float32)
    pattern, appearance = (grid(12, 8), ring(40, 1.3, 1.8)), (maps, np.array([0.6, 0.4]), False, table)
    arguments = frame, ellipses, pattern, appearance, (110.0, 8.0)
    log_likelihood = benchmark(rank_likelihood, *arguments)
    near = 0.02 * (2 * 110 + 2 * 8) if rank_likelihood is script else 1e-11
    assert_allclose(log_likelihood, reference.rank_likelihood(*arguments), rtol=0, atol=near)
