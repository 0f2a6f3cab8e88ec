# SPDX-License-Identifier: MIT
"""Regions of a divided depth image of 176x144: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Labels = NDArray[np.uint8]
Depth = NDArray[np.float32]
NEAR, FAR, LEVELS, BINS, MIN_AREA = 0.3, 7.5, 64, 16, 30


@pytest.fixture(scope="module")
def scene() -> tuple[Labels, Depth]:
    """Smooth random depths of 1 to 6 m, 5 % not measured, divided at 2.5, 3.5 and 4.5 m."""
    rng = np.random.default_rng(0)
    clouds = cv2.GaussianBlur(rng.normal(0, 1, (144, 176)), (0, 0), 9)
    depth = np.interp(clouds, [clouds.min(), clouds.max()], [1, 6]).astype(np.float32)
    depth[rng.random(depth.shape) < 0.05] = np.nan
    return (np.digitize(depth, [2.5, 3.5, 4.5]) % 4).astype(np.uint8), depth


def script(
    labels: Labels, depth: Depth, near: float, far: float, levels: int, bins: int, min_area: int, image: bool
) -> tuple[Any, ...]:
    """The baseline: connectedComponentsWithStats for every label, then masks, calcHist and bincount."""
    found = []
    for label in np.unique(labels[labels > 0]):
        _, image, stats, _ = cv2.connectedComponentsWithStats((labels == label).astype(np.uint8))
        found += [(*stats[i], label, image == i) for i in range(1, len(stats)) if stats[i, 4] >= min_area]
    found.sort(key=lambda each: -each[4])
    table, histograms, spreads = np.empty((len(found), 7)), [], []
    components = np.zeros(labels.shape, np.int32)
    for k, (x, y, width, height, area, label, inside) in enumerate(found):
        box = inside[y : y + height, x : x + width]
        seen = (box & (depth[y : y + height, x : x + width] > 0)).view(np.uint8)
        meters = depth[y : y + height, x : x + width]
        histogram = cv2.calcHist([meters], [0], seen, [levels], [near, far]).ravel()
        histograms.append(histogram / max(histogram.sum(), 1))
        table[k] = x, y, width, height, area, meters[seen > 0].mean(dtype=np.float64), label
        for axis in (0, 1):
            counts = box.sum(axis=axis)
            parts = np.repeat(counts, bins).reshape(bins, -1)  # each pixel is cut into as many
            spreads.append(parts.sum(axis=1) / (bins * area))
        components[inside] = k + 1
    return table, np.array(histograms), np.array(spreads[::2]), np.array(spreads[1::2]), components


@pytest.mark.benchmark(group="depth_components")
@pytest.mark.work(bytes=9 * 176 * 144, counts=176 * 144 * 2 // 3, why="runs are joined one by one")
@pytest.mark.parametrize(
    "depth_components",
    [_core.depth_components, reference.depth_components, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_components(
    benchmark: Any, depth_components: Callable[..., Any], scene: tuple[Labels, Depth]
) -> None:
    """All find the same regions. OpenCV's calcHist rounds differently, so a pixel at the edge of a level may
    be in the next.
    """
    arguments = (*scene, NEAR, FAR, LEVELS, BINS, MIN_AREA, True)
    found = benchmark(depth_components, *arguments)
    expected = reference.depth_components(*arguments)
    assert len(found[0]) > 5
    assert_allclose(found[0], expected[0], rtol=1e-12)
    assert_allclose(found[1], expected[1], atol=0.01)
    assert_allclose(found[2], expected[2], atol=1e-6)
    assert_allclose(found[3], expected[3], atol=1e-6)
    assert_array_equal(found[4], expected[4])
