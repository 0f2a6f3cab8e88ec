# SPDX-License-Identifier: MIT
"""Moments of skin in a region of 130x143 pixels: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
THRESHOLD, REGION = 0.4, (50, 50, 180, 193)


def script(
    image: Image, color: Image, threshold: float, region: tuple[int, int, int, int], step: int
) -> NDArray[np.float64]:
    """The baseline, of all rows: classification of the region's planes, then cv2.moments of the mask."""
    x0, y0, x1, y1 = region
    part = image[y0:y1, x0:x1]
    b, g, r = cv2.split(part)
    eta = cv2.max(cv2.max(b, g), r)
    b, g, r = cv2.split(cv2.absdiff(part, np.array([*color, 0.0])))
    boundary = cv2.subtract(eta, cv2.max(cv2.max(b, g), r), dtype=cv2.CV_16S)
    m = cv2.moments((boundary > 255 * threshold).view(np.uint8), binaryImage=True)
    center = [x0 + m["m10"] / m["m00"] + 0.5, y0 + m["m01"] / m["m00"] + 0.5]
    return np.array([m["m00"], *center, *(m[name] / m["m00"] for name in ("mu20", "mu02", "mu11"))])


@pytest.mark.benchmark(group="skin_moments")
@pytest.mark.work(ops8=24 * 130 * 143, why="pixels of 3 bytes are taken apart")
@pytest.mark.parametrize(
    "skin_moments",
    [_core.skin_moments, reference.skin_moments, script],
    ids=["native", "reference", "baseline"],
)
def bench_skin_moments(benchmark: Any, skin_moments: Callable[..., Any], frame: Image, color: Image) -> None:
    """All have the same moments, within rounding."""
    moments = benchmark(skin_moments, frame, color, THRESHOLD, REGION, 1)
    assert moments[0] > 1000
    assert_allclose(moments, reference.skin_moments(frame, color, THRESHOLD, REGION, 1), rtol=1e-10)
