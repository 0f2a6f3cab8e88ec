# SPDX-License-Identifier: MIT
"""The color tracker's measurement of 100 ellipses: native, reference, and a script on OpenCV and NumPy."""

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
    image: Image, ellipses: Floats, inside: Floats, around: Floats, maps: Singles, table: Singles
) -> tuple[Floats, Floats]:
    """The baseline: remap reads the pixels, calcHist and cumsum rank them, a table is indexed."""
    cells = (image >> 4).astype(np.int32)
    likely = table[cells[..., 0], cells[..., 1], cells[..., 2]]
    means = []
    for pattern in (inside, around):
        places = (ellipses[:, None, :2] + ellipses[:, None, 2:] * pattern - 0.5).astype(np.float32)
        means.append(cv2.remap(likely, places, None, cv2.INTER_NEAREST).mean(axis=1))
        if pattern is inside:
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
    return distances, means[0] - means[1]


@pytest.mark.benchmark(group="rank_contrast")
@pytest.mark.work(counts=100 * 3 * 96, lookups=2 * 100 * (96 + 40))
@pytest.mark.parametrize(
    "rank_contrast",
    [_core.rank_contrast, reference.rank_contrast, script],
    ids=["native", "reference", "baseline"],
)
def bench_rank_contrast(benchmark: Any, rank_contrast: Callable[..., Any], frame: Image) -> None:
    """Twins agree; the script's places are rounded to 1/32 of a pixel, which moves a few samples by one."""
    rng = np.random.default_rng(0)
    ellipses = rng.normal([160, 120, 25, 31], [20, 20, 1, 1], (100, 4))
    inside, around = grid(12, 8), ring(40, 1.3, 1.8)
    maps, table = rng.random((2, 3, 96), np.float32), rng.random((16, 16, 16), np.float32)
    arguments = (frame, ellipses, inside, around, maps, table)
    distances, contrast = benchmark(rank_contrast, *arguments)
    expected = reference.rank_contrast(*arguments)
    near = 0.02 if rank_contrast is script else 1e-12
    assert_allclose(distances, expected[0], rtol=0, atol=near)
    assert_allclose(contrast, expected[1], rtol=0, atol=2 * near)
