# SPDX-License-Identifier: MIT
"""The colors of cells of 4x4 pixels of 640x480, and their mean: native, reference, NumPy with cv2.mean."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def baseline(image: Image, step: int) -> tuple[Image, NDArray[np.float64]]:
    """A copied slice, and cv2.mean."""
    colors = np.ascontiguousarray(image[step // 2 :: step, step // 2 :: step])
    return colors, np.array(cv2.mean(colors)[:3])


@pytest.mark.benchmark(group="cell_colors, 640x480")
@pytest.mark.work(bytes=120 * 640 * 3 + 160 * 120 * 3, why="3 of 12 bytes at a time")
@pytest.mark.parametrize(
    "cell_colors",
    [_core.cell_colors, reference.cell_colors, baseline],
    ids=["native", "reference", "baseline"],
)
def bench_cell_colors(benchmark: Any, cell_colors: Callable[..., Any]) -> None:
    """All give the same colors, and the same mean but for its last bit."""
    image = np.random.default_rng(0).integers(0, 256, (480, 640, 3), np.uint8)
    colors, mean = benchmark(cell_colors, image, 4)
    expected = reference.cell_colors(image, 4)
    assert_array_equal(colors, expected[0])
    assert_allclose(mean, expected[1], rtol=1e-15)
