# SPDX-License-Identifier: MIT
"""The pixels of 100 blocks: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Mask = NDArray[np.uint8]


def script(blocks: NDArray[np.float64], height: int, width: int) -> Mask:
    """The baseline: cv2.rectangle; corners are integers here."""
    mask = np.zeros((height, width), np.uint8)
    for x0, y0, x1, y1 in blocks.astype(int).tolist():
        cv2.rectangle(mask, (x0, y0), (x1 - 1, y1 - 1), 1, cv2.FILLED)
    return mask


IMPLEMENTATIONS = {"native": _core.block_mask, "reference": reference.block_mask, "baseline": script}


def check(benchmark: Any, block_mask: Callable[..., Mask], size: int) -> None:
    """All mark the same 10 x 10 adjacent blocks, all in the image."""
    x, y = (each.ravel() * size for each in np.meshgrid(np.arange(10), np.arange(10)))
    blocks = np.column_stack([x + 5, y, x + size + 5, y + size]).astype(float)
    mask = benchmark(block_mask, blocks, 10 * size, 10 * size + 40)
    expected = np.zeros((10 * size, 10 * size + 40), np.uint8)
    expected[:, 5 : 10 * size + 5] = 1
    assert_array_equal(mask, expected)


@pytest.mark.benchmark(group="block_mask, 100 of 6x6")
@pytest.mark.work(bytes=60 * 100, why="rows of 6 bytes")
@pytest.mark.parametrize("block_mask", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_block_mask(benchmark: Any, block_mask: Callable[..., Mask]) -> None:
    """Of a target in the paper's frame: 60x100 pixels round it."""
    check(benchmark, block_mask, 6)


@pytest.mark.benchmark(group="block_mask, 100 of 24x24")
@pytest.mark.work(bytes=240 * 280, why="rows of 24 bytes")
@pytest.mark.parametrize("block_mask", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_block_mask_of_many(benchmark: Any, block_mask: Callable[..., Mask]) -> None:
    """Of a target in a usual frame."""
    check(benchmark, block_mask, 24)
