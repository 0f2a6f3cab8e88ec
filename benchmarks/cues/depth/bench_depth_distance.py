# SPDX-License-Identifier: MIT
"""Distances of 100 rectangles of 192 places: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
LEVELS, REACH, NEARER = 64, 0.5, 0.2


def script(
    depth: Depth, rectangles: Floats, model: tuple[Floats, float], pattern: Floats, occluder_margin: float
) -> Floats:
    """The baseline: one remap of all places, which rounds where we take the floor, and calcHist of each."""
    reference_histogram, reach = model
    places = (rectangles[:, None, :2] + rectangles[:, None, 2:4] / 2 * pattern - 0.5).astype(np.float32)
    seen = cv2.remap(depth, places, None, cv2.INTER_NEAREST, borderValue=np.nan)
    # calcHist counts NaN, so unmeasured depths are put beyond the reach.
    relative = np.nan_to_num(seen - rectangles[:, 4:], nan=2 * reach).astype(np.float32)
    measured = np.empty((len(rectangles), 3))
    for i, row in enumerate(relative):
        histogram = cv2.calcHist([row], [0], None, [len(reference_histogram)], [-reach, reach]).ravel()
        counted = histogram.sum()
        distance = np.linalg.norm(histogram / counted - reference_histogram) / np.sqrt(2) if counted else 1
        measured[i] = distance, counted / len(row), np.count_nonzero(row < -occluder_margin) / len(row)
    return measured


@pytest.mark.benchmark(group="depth_distance")
@pytest.mark.work(lookups=100 * 192, counts=100 * 150)
@pytest.mark.parametrize(
    "depth_distance",
    [_core.depth_distance, reference.depth_distance, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_distance(benchmark: Any, depth_distance: Callable[..., Any]) -> None:
    """The twins measure the same; remap rounds places to 1/32 pixel, so a few differ."""
    rng = np.random.default_rng(0)
    depth = np.full((144, 176), 5, np.float32)
    depth[30:, 60:110] = 2.5
    depth += rng.normal(0, 0.05, depth.shape).astype(np.float32)
    depth[rng.random(depth.shape) < 0.05] = np.nan
    rectangles = rng.normal([85, 85, 50, 100, 2.5], [8, 8, 3, 6, 0.1], (100, 5))
    model = np.histogram(rng.normal(0, 0.05, 5000), LEVELS, (-REACH, REACH))[0] / 5000
    pattern = grid(16, 12)
    arguments = (depth, rectangles, (model, REACH), pattern, NEARER)
    measured = benchmark(depth_distance, *arguments)
    expected = reference.depth_distance(*arguments)
    assert_allclose(
        measured, expected, **({"atol": 0.02} if depth_distance is script else {"rtol": 100 * 2.0**-52})
    )
