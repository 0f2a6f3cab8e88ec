# SPDX-License-Identifier: MIT
"""The ranks of 96 pixels in an ellipse, and two correlations: native, reference, and a script."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


def script(
    image: Image, ellipse: Floats, pattern: Floats, models: Singles, flat: float
) -> tuple[Singles, Floats]:
    """The baseline: remap reads the pixels, calcHist and cumsum rank them, corrcoef compares."""
    places = (ellipse[:2] + ellipse[2:] * pattern - 0.5).astype(np.float32)[None]
    samples = cv2.remap(image, places, None, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)[0]
    ranks = np.empty((3, len(pattern)), np.float32)
    for k in range(3):
        levels = np.ascontiguousarray(samples[:, k])
        counts = cv2.calcHist([levels], [0], None, [256], [0, 256]).ravel()
        ranks[k] = ((np.cumsum(counts) - counts / 2) / len(pattern))[levels]
    return ranks, np.array([max(np.corrcoef(ranks.ravel(), each.ravel())[0, 1], 0) for each in models])


@pytest.mark.benchmark(group="rank_window")
@pytest.mark.work(counts=3 * 96, flops64=2 * 5 * 3 * 96, why="the call takes a third, sums are in one order")
@pytest.mark.parametrize(
    "rank_window",
    [_core.rank_window, reference.rank_window, script],
    ids=["native", "reference", "baseline"],
)
def bench_rank_window(benchmark: Any, rank_window: Callable[..., Any], frame: Image) -> None:
    """The twins agree; the script rounds places to 1/32 pixel, which moves a few samples by a pixel."""
    rng = np.random.default_rng(0)
    ellipse, pattern = np.array([160.3, 120.7, 25, 31]), grid(12, 8)
    seen = reference.rank_window(frame, ellipse + 2, pattern, np.empty((0, 3, 96), np.float32), 0.1)[0]
    models = np.stack([seen, rng.permuted(seen, axis=1)])
    ranks, correlations = benchmark(rank_window, frame, ellipse, pattern, models, 0.1)
    expected, alike = reference.rank_window(frame, ellipse, pattern, models, 0.1)
    near = 0.05 if rank_window is script else 1e-11
    assert np.abs(ranks - expected).mean() <= near
    assert_allclose(correlations, alike, rtol=0, atol=near)
