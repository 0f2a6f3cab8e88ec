# SPDX-License-Identifier: MIT
"""A patch of 64x64 in log-polar coordinates: native, reference, and OpenCV's remap."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.fused.experts.log_polar import log_polar_pixels

Image = NDArray[np.uint8]

PLACES = log_polar_pixels()
Y, X = (each.astype(np.float32) for each in np.divmod(PLACES, 64))


def script(image: Image, places: NDArray[np.int64]) -> Image:
    """The baseline: maps in float32, made before the clock starts."""
    return cv2.remap(image, X, Y, cv2.INTER_NEAREST)  # type: ignore[return-value]


@pytest.mark.benchmark(group="pick_pixels, 64x64")
@pytest.mark.work(lookups=64 * 64)
@pytest.mark.parametrize(
    "pick_pixels",
    [_core.pick_pixels, reference.pick_pixels, script],
    ids=["native", "reference", "baseline"],
)
def bench_pick_pixels(benchmark: Any, pick_pixels: Callable[..., Image], frame: Image) -> None:
    """All pick the same."""
    patch = np.ascontiguousarray(frame[40:104, 60:124])
    picked = benchmark(pick_pixels, patch, PLACES)
    assert_array_equal(picked, reference.pick_pixels(patch, PLACES))
