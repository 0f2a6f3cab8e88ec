# SPDX-License-Identifier: MIT
"""Contrast of a box at 32x32 places of a map: native, reference, and OpenCV's integral image and NumPy."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]

PLANE = np.random.default_rng(0).random((64, 64)).astype(np.float32)


def script(plane: Plane, width: float, height: float, surround_size: float, surround_weight: float) -> Plane:
    """The baseline: corners between pixels are read from the integral image by remap."""
    integral = cv2.integral(plane, sdepth=cv2.CV_64F).astype(np.float32)
    rows, columns = plane.shape[0] // 2, plane.shape[1] // 2
    y, x = (n + 2.0 * (np.arange(n) - n // 2) for n in (rows, columns))

    def sums(across: float, down: float) -> NDArray[np.float32]:
        top, bottom = (np.clip(y + side * down / 2, 0, 2 * rows) for side in (-1, 1))
        left, right = (np.clip(x + side * across / 2, 0, 2 * columns) for side in (-1, 1))
        corners = np.meshgrid(np.concatenate([left, right]), np.concatenate([top, bottom]))
        at = cv2.remap(integral, *(each.astype(np.float32) for each in corners), cv2.INTER_LINEAR)
        return np.asarray(
            at[rows:, columns:] - at[:rows, columns:] - at[rows:, :columns] + at[:rows, :columns]
        )

    inner, whole = sums(width, height), sums(width * surround_size, height * surround_size)
    area = width * height
    return inner / area - surround_weight * (whole - inner) / (area * (surround_size * surround_size - 1))


IMPLEMENTATIONS = {"native": _core.box_contrast, "reference": reference.box_contrast, "baseline": script}


@pytest.mark.benchmark(group="box_contrast, 64x64")
@pytest.mark.work(lookups=2 * 4 * 32 * 32, why="the sums, row after row")
@pytest.mark.parametrize("contrast", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_box_contrast(benchmark: Any, contrast: Callable[..., Plane]) -> None:
    """All agree; remap rounds places to 1/32 pixel, a hundredth of the box."""
    found = benchmark(contrast, PLANE, 23.4, 30.1, 1.5, 1.0)
    expected = reference.box_contrast(PLANE, 23.4, 30.1, 1.5, 1.0)
    assert_allclose(found, expected, atol=0.01 if contrast is script else 1e-6)
