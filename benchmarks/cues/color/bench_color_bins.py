# SPDX-License-Identifier: MIT
"""Bins of the region in which a head is searched for, 60x56: native, reference, and a NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(
    image: Image, region: tuple[int, int, int, int], space: tuple[tuple[int, int, int], int], step: int
) -> NDArray[np.uint16]:
    """The baseline: slices and differences, and shifts instead of divisions by powers of two."""
    (x0, y0, x1, y1), (bins, chroma) = region, space
    b, g, r = np.moveaxis(image[y0:y1:step, x0:x1:step].astype(np.int32), 2, 0)
    first = np.clip(b - g + chroma, 0, 2 * chroma - 1) * bins[0] // (2 * chroma)
    second = np.clip(g - r + chroma, 0, 2 * chroma - 1) * bins[1] // (2 * chroma)
    third = (b + g + r) * bins[2] // 766
    return ((first * bins[1] + second) * bins[2] + third).astype(np.uint16)


@pytest.mark.benchmark(group="color_bins")
@pytest.mark.work(flops32=9 * 60 * 56, ops8=60 * 56 * 4 * 15, why="pixels of 3 bytes are taken apart")
@pytest.mark.parametrize(
    "color_bins",
    [_core.color_bins, reference.color_bins, script],
    ids=["native", "reference", "baseline"],
)
def bench_color_bins(benchmark: Any, color_bins: Callable[..., Any], frame: Image) -> None:
    """All find the same bins."""
    arguments = (frame, (100, 80, 160, 136), ((32, 32, 4), 64), 1)
    assert_array_equal(benchmark(color_bins, *arguments), reference.color_bins(*arguments))
