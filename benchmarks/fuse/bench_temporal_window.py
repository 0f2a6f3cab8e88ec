# SPDX-License-Identifier: MIT
"""The rectangle around target pixels, among as many wrong ones: native, reference, an OpenCV script."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Mask = NDArray[np.uint8]
AROUND = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]], np.float32)
NEIGHBORS, SHARE, TRIM = 3, 0.2, 0.02


def script(mask: Mask, neighbors: int, share: float, trim: float) -> tuple[Any, int, Mask]:
    """The baseline: filter2D for neighbors, connected components, cumulative sums over rows and columns."""
    counts = cv2.filter2D(mask, cv2.CV_8U, AROUND, borderType=cv2.BORDER_CONSTANT)
    enough = mask * (counts >= neighbors)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(enough, ltype=cv2.CV_32S)
    large = stats[:, cv2.CC_STAT_AREA] >= share * stats[1:, cv2.CC_STAT_AREA].max()
    large[0] = False
    left = large.astype(np.uint8)[labels]
    count = cv2.countNonZero(left)
    out = int(trim * count)
    box = []
    for axis in (0, 1):
        places = np.cumsum(left.sum(axis=axis))
        box.append(np.searchsorted(places, [out, count - 1 - out], side="right") + [0, 1])
    return (box[0][0], box[1][0], box[0][1], box[1][1]), count, left


IMPLEMENTATIONS = {
    "native": _core.temporal_window,
    "reference": reference.temporal_window,
    "baseline": script,
}


def check(benchmark: Any, temporal_window: Callable[..., Any], target: Any) -> None:
    """All keep the same pixels and find the same box.

    Some pixels are kept and some removed, and though half of the pixels are anywhere in the frame, the box is
    in the candidate region.
    """
    wrong = np.random.default_rng(1).random(target.mask.shape) < target.mask.mean()
    mask = target.mask | wrong.astype(np.uint8)
    box, count, left = benchmark(temporal_window, mask, NEIGHBORS, SHARE, TRIM)
    expected = reference.temporal_window(mask, NEIGHBORS, SHARE, TRIM)
    assert tuple(box) == expected[0]
    assert count == expected[1] == np.count_nonzero(left)
    assert_array_equal(left, expected[2])
    assert 0 < count < np.count_nonzero(mask)
    x0, y0, x1, y1 = target.candidate
    assert x0 <= box[0] < box[2] <= x1
    assert y0 <= box[1] < box[3] <= y1


@pytest.mark.benchmark(group="temporal_window, 160x120")
@pytest.mark.work(ops8=12 * 160 * 120, bytes=2 * 160 * 120, why="runs are joined one by one")
@pytest.mark.parametrize("temporal_window", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_temporal_window(benchmark: Any, temporal_window: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, temporal_window, small)


@pytest.mark.benchmark(group="temporal_window, 640x480")
@pytest.mark.work(ops8=12 * 640 * 480, bytes=2 * 640 * 480, why="runs are joined one by one")
@pytest.mark.parametrize("temporal_window", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_temporal_window_of_many(benchmark: Any, temporal_window: Callable[..., Any], large: Any) -> None:
    """In a frame of 640x480."""
    check(benchmark, temporal_window, large)
