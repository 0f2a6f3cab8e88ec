# SPDX-License-Identifier: MIT
"""The disparity of a head of 60x72 pixels among 33 candidates: native, reference, and cv2.StereoBM."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]

ELLIPSE = np.array([170.0, 96, 30, 36])
REGION = (140, 60, 200, 132)  # around it
FIRST, LAST, WINDOW = 16, 48, 11


def pair() -> tuple[Image, Image]:
    """A pair of 320x200: colored texture with a disparity of 32 pixels."""
    noise = cv2.GaussianBlur(np.random.default_rng(0).normal(0, 1, (200, 400, 3)), (0, 0), 1.2)
    texture = (128 + 45 * noise / noise.std()).clip(0, 255).astype(np.uint8)
    return np.ascontiguousarray(texture[:, 10:330]), np.ascontiguousarray(texture[:, 42:362])


def script(left: Image, right: Image, *arguments: Any) -> tuple[float, int, int]:
    """The baseline: StereoBM on the part of the images that it needs, and NumPy."""
    x0, y0, x1, y1 = REGION
    part = np.s_[y0 - 6 : y1 + 6, x0 - 16 - 48 : x1 + 6]
    matcher = cv2.StereoBM_create(48, WINDOW)
    matcher.setMinDisparity(FIRST)
    gray = [cv2.cvtColor(each[part], cv2.COLOR_BGR2GRAY) for each in (left, right)]
    found = matcher.compute(*gray)[6:-6, -66:-6]
    y, x = np.mgrid[: y1 - y0, : x1 - x0] + 0.5
    inside = ((x - 30) / 30) ** 2 + ((y - 36) / 36) ** 2 <= 1
    matched = found[inside & (found >= 16 * FIRST)] / 16
    middle = float(np.median(matched))
    return middle, matched.size, int(np.count_nonzero(abs(matched - middle) <= 2.4))


@pytest.mark.benchmark(group="ellipse_disparity, 60x72")
@pytest.mark.work(ops8=20 * 60 * 72 * 33 * 3 // 4, why="rows of 60 pixels, windows of 11")
@pytest.mark.parametrize(
    "ellipse_disparity",
    [_core.ellipse_disparity, reference.ellipse_disparity, script],
    ids=["native", "reference", "baseline"],
)
def bench_ellipse_disparity(benchmark: Any, ellipse_disparity: Callable[..., Any]) -> None:
    """All find the same disparity, with nearly all pixels close to it."""
    search = (FIRST, LAST), (WINDOW, 5, True)
    found = benchmark(ellipse_disparity, *pair(), ELLIPSE, *search, (True, True, 2.4))
    assert abs(found[0] - 32) < 0.1
    assert found[2] > 0.95 * found[1] > 0.9 * np.pi * 30 * 36 * 0.95
