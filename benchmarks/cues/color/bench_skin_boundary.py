# SPDX-License-Identifier: MIT
"""Boundary values of a frame of 320x240: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(image: Image, color: Image) -> NDArray[np.int16]:
    """The baseline: differences and maxima of whole planes."""
    b, g, r = cv2.split(image)
    eta = cv2.max(cv2.max(b, g), r)
    b, g, r = cv2.split(cv2.absdiff(image, np.array([*color, 0.0])))
    return cv2.subtract(eta, cv2.max(cv2.max(b, g), r), dtype=cv2.CV_16S).astype(np.int16, copy=False)


@pytest.mark.benchmark(group="skin_boundary")
@pytest.mark.work(bytes=5 * 320 * 240, ops8=16 * 320 * 240)
@pytest.mark.parametrize(
    "skin_boundary",
    [_core.skin_boundary, reference.skin_boundary, script],
    ids=["native", "reference", "baseline"],
)
def bench_skin_boundary(
    benchmark: Any, skin_boundary: Callable[..., Any], frame: Image, color: Image
) -> None:
    """All measure the same."""
    boundary = benchmark(skin_boundary, frame, color)
    assert_array_equal(boundary, reference.skin_boundary(frame, color))
