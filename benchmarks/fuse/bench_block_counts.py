# SPDX-License-Identifier: MIT
"""200 blocks of a target window: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]


def script(
    mask: NDArray[np.uint8],
    disparity: NDArray[np.float32],
    blocks: Floats,
    expected: float,
    tolerance: float,
) -> tuple[Any, ...]:
    """The baseline: integral images of the part with blocks, whose corners are integers here."""
    corners = blocks.astype(int)
    left, top = corners[:, :2].min(axis=0)
    right, bottom = corners[:, 2:].max(axis=0)
    part = np.s_[top:bottom, left:right]
    x0, y0, x1, y1 = (corners - [left, top, left, top]).T
    read = np.isfinite(disparity[part])
    images = mask[part], read.astype(np.uint8), np.where(read, disparity[part], np.float32(0))
    totals = [cv2.integral(image) for image in images]
    sums = [total[y1, x1] - total[y1, x0] - total[y0, x1] + total[y0, x0] for total in totals]
    mean = np.divide(sums[2], sums[1], out=np.full(len(blocks), np.nan), where=sums[1] > 0)
    near = np.abs(disparity[part] - np.float32(expected)) <= np.float32(tolerance)
    total = cv2.integral(near.astype(np.uint8))
    similar = total[y1, x1] - total[y1, x0] - total[y0, x1] + total[y0, x0]
    return (x1 - x0) * (y1 - y0), sums[0], sums[1], mean, similar


IMPLEMENTATIONS = {"native": _core.block_counts, "reference": reference.block_counts, "baseline": script}


def check(benchmark: Any, block_counts: Callable[..., Any], target: Any, size: int) -> None:
    """All count the same; means differ by the rounding of integral images."""
    x, y = np.meshgrid(np.arange(10) * size, np.arange(20) * size)
    x0, y0 = target.window[0] - size, 0
    low = np.column_stack([x.ravel() + x0, y.ravel() + y0])
    blocks = np.column_stack([low, low + size]).astype(float)
    found = benchmark(block_counts, target.mask, target.planes[2], blocks, 8.0, 1.0)
    expected = reference.block_counts(target.mask, target.planes[2], blocks, 8.0, 1.0)
    assert expected[1].max() > size
    for ours, theirs in zip((*found[:3], found[4]), (*expected[:3], expected[4]), strict=True):
        assert_array_equal(ours, theirs)
    assert_allclose(found[3], expected[3], rtol=1e-9)


@pytest.mark.benchmark(group="block_counts, 200 of 6x6")
@pytest.mark.work(bytes=5 * 200 * 6 * 6, flops64=200 * 6 * 6, why="4 pixels at a time")
@pytest.mark.parametrize("block_counts", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_block_counts(benchmark: Any, block_counts: Callable[..., Any], small: Any) -> None:
    """In a frame of 160x120, as in the paper."""
    check(benchmark, block_counts, small, 6)


@pytest.mark.benchmark(group="block_counts, 200 of 24x24")
@pytest.mark.work(bytes=5 * 200 * 24 * 24, flops64=200 * 24 * 24, why="4 pixels at a time")
@pytest.mark.parametrize("block_counts", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_block_counts_of_many(benchmark: Any, block_counts: Callable[..., Any], large: Any) -> None:
    """In a frame of 640x480."""
    check(benchmark, block_counts, large, 24)
