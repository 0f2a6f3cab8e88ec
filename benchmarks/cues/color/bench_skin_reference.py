# SPDX-License-Identifier: MIT
"""Reference color of a patch of 40x50 pixels: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(patch: Image) -> Image:
    """The baseline: np.unique counts the bins, then the mean of the largest one."""
    pixels = patch.reshape(-1, 3)
    _, inverse, counts = np.unique(
        pixels // 8 @ np.array([1024, 32, 1]), return_inverse=True, return_counts=True
    )
    color: Image = np.floor(pixels[inverse == np.argmax(counts)].mean(axis=0) + 0.5).astype(np.uint8)
    return color


@pytest.mark.benchmark(group="skin_reference")
@pytest.mark.work(counts=40 * 50, bytes=4 * 32768, why="three passes over the pixels, one by one")
@pytest.mark.parametrize(
    "skin_reference",
    [_core.skin_reference, reference.skin_reference, script],
    ids=["native", "reference", "baseline"],
)
def bench_skin_reference(benchmark: Any, skin_reference: Callable[..., Any], frame: Image) -> None:
    """All find the same color."""
    color = benchmark(skin_reference, frame[100:150, 100:140])
    assert_array_equal(color, reference.skin_reference(frame[100:150, 100:140]))
