# SPDX-License-Identifier: MIT
"""The mean color of 60 rows of 640x480: native, reference, cv2.mean."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]


def baseline(rows: Image) -> Floats:
    """cv2.mean, which takes the rows as they are."""
    return np.array(cv2.mean(rows)[:3])


@pytest.mark.benchmark(group="image_mean, 640x480")
@pytest.mark.work(bytes=60 * 640 * 3)
@pytest.mark.parametrize(
    "image_mean",
    [_core.image_mean, reference.image_mean, baseline],
    ids=["native", "reference", "baseline"],
)
def bench_image_mean(benchmark: Any, image_mean: Callable[..., Floats]) -> None:
    """All give the same mean, except for its last bit."""
    image = np.random.default_rng(0).integers(0, 256, (480, 640, 3), np.uint8)
    rows = image[4::8]
    assert_allclose(benchmark(image_mean, rows), reference.image_mean(rows), rtol=1e-15)
