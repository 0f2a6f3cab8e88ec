# SPDX-License-Identifier: MIT
"""The gradient at 64 points of an outline at 16x4 places: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
Grid = tuple[int, int, int]


def script(gray: NDArray[np.uint8], ellipse: Floats, grid: Grid, pattern: Floats) -> Floats:
    """The baseline: Sobel of a part of the picture, and one fancy index for all places."""
    rows, cols, step = grid
    reach = np.ceil(ellipse[2:] + step * np.array([cols, rows])).astype(int) + 1
    left, top = ellipse[:2].astype(int) - reach
    right, bottom = ellipse[:2].astype(int) + reach
    part = gray[top:bottom, left:right]
    gx, gy = (cv2.Sobel(part, cv2.CV_32F, *order, ksize=1, scale=0.5) for order in ((1, 0), (0, 1)))
    normals = pattern / ellipse[2:]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    place = (ellipse[:2] + pattern * ellipse[2:]).astype(int) - np.array([left, top])
    x = place[:, 0] + step * (np.arange(cols)[:, None] - cols // 2)
    y = place[:, 1] + step * (np.arange(rows)[:, None, None] - rows // 2)
    return np.asarray(np.abs(normals[:, 0] * gx[y, x] + normals[:, 1] * gy[y, x]).mean(axis=2))


@pytest.mark.benchmark(group="ellipse_gradient")
@pytest.mark.parametrize(
    "ellipse_gradient",
    [_core.ellipse_gradient, reference.ellipse_gradient, script],
    ids=["native", "reference", "baseline"],
)
def bench_ellipse_gradient(
    benchmark: Any, ellipse_gradient: Callable[..., Floats], frame: NDArray[np.uint8]
) -> None:
    """All find the same, within sums of float32."""
    angles = (np.arange(64) + 0.5) * np.pi / 32
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    pattern = np.column_stack([np.cos(angles), np.sin(angles)])
    arguments = (gray, np.array([130.3, 107.8, 15, 18]), (4, 16, 1), pattern)
    found = benchmark(ellipse_gradient, *arguments)
    assert_allclose(found, reference.ellipse_gradient(*arguments), rtol=0, atol=1e-3)
