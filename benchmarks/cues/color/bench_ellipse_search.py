# SPDX-License-Identifier: MIT
"""An ellipse of 30x36 pixels at 16x4 places over 4096 bins: native, reference, and a script on OpenCV.
Also natively without sliding: every place is counted from scratch.
"""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Bins = NDArray[np.uint16]
Floats = NDArray[np.float64]
Grid = tuple[int, int, int]


def every_place(ellipse: Floats, grid: Grid) -> Floats:
    """(rows cols, 4): the ellipse at every place of the grid."""
    rows, cols, step = grid
    y, x = np.mgrid[:rows, :cols] - np.array([rows // 2, cols // 2])[:, None, None]
    return ellipse + step * np.stack([x, y, 0 * x, 0 * x], 2).reshape(-1, 4).astype(np.float64)


def full(bins: Bins, ellipse: Floats, grid: Grid, model: Floats, margin: float, mask: None) -> Floats:
    """Each place is a separate native search, so it is counted from scratch."""
    places = every_place(ellipse, grid)
    found = [_core.ellipse_search(bins, place, (1, 1, 1), model, margin, mask) for place in places]
    return np.reshape(found, (*grid[:2], 4))


def script(bins: Bins, ellipse: Floats, grid: Grid, model: Floats, margin: float, mask: None) -> Floats:
    """The baseline: the ellipse's mask moved from place to place, calcHist, and compareHist of shares."""
    size, target = model.size, (model / model.sum()).astype(np.float32)
    found = np.zeros((grid[0] * grid[1], 4))
    y, x = np.mgrid[: bins.shape[0], : bins.shape[1]] + 0.5
    for i, (x0, y0, minor, major) in enumerate(every_place(ellipse, grid)):
        distance = ((x - x0) / minor) ** 2 + ((y - y0) / major) ** 2
        for k, pixels in enumerate((distance <= 1, (distance > 1) & (distance <= margin**2))):
            counts = cv2.calcHist([bins], [0], pixels.astype(np.uint8), [size], [0, size]).ravel()
            found[i, k] = cv2.compareHist(counts / counts.sum(), target, cv2.HISTCMP_INTERSECT)
    return found.reshape(*grid[:2], 4)


@pytest.mark.benchmark(group="ellipse_search")
@pytest.mark.work(counts=1600 + 63 * 2 * (36 + 50))
@pytest.mark.parametrize(
    "ellipse_search",
    [_core.ellipse_search, full, reference.ellipse_search, script],
    ids=["native", "full", "reference", "baseline"],
)
def bench_ellipse_search(
    benchmark: Any, ellipse_search: Callable[..., Floats], region_bins: Bins, ellipse: Floats, model: Floats
) -> None:
    """All find the same: the native search within its own rounding, the script within float32's."""
    arguments = (region_bins, ellipse, (4, 16, 1), model, 1.4, None)
    found = benchmark(ellipse_search, *arguments)
    assert_allclose(found, reference.ellipse_search(*arguments), rtol=0, atol=1e-5)
