# SPDX-License-Identifier: MIT
"""Gray levels of 640x480 in cells of 4x4: native, reference, and two calls of cv2."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def baseline(image: Image, step: int) -> Image:
    """cv2's conversion to gray, and resize."""
    gray = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    size = image.shape[1] // step, image.shape[0] // step
    return np.asarray(cv2.resize(gray, size, interpolation=cv2.INTER_AREA), np.uint8)


@pytest.mark.benchmark(group="reduce_gray, 640x480")
@pytest.mark.work(bytes=3 * 640 * 480 + 160 * 120, why="pixels of 3 bytes are taken apart")
@pytest.mark.parametrize(
    "reduce_gray",
    [_core.reduce_gray, reference.reduce_gray, baseline],
    ids=["native", "reference", "baseline"],
)
def bench_reduce_gray(benchmark: Any, reduce_gray: Callable[..., Image]) -> None:
    """All give the same levels."""
    image = np.random.default_rng(0).integers(0, 256, (480, 640, 3), np.uint8)
    assert_array_equal(benchmark(reduce_gray, image, 4), reference.reduce_gray(image, 4))
