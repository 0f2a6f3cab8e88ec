# SPDX-License-Identifier: MIT
"""Windows on a grid: native, reference, and OpenCV's resize of each window, rounded to whole pixels."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]

ONE = np.array([[70.0, 40.0, 150.0, 150.0]])
SCALES = np.array([[160 - s, 120 - s, 2 * s, 2 * s] for s in 37.5 * 1.03 ** np.arange(-5, 6)])


def script(image: Image, windows: Floats, rows: int, columns: int) -> Image:
    """The baseline: INTER_AREA, as all windows are scaled down here."""
    samples = []
    for x, y, width, height in np.rint(windows).astype(int).tolist():
        part = image[y : y + height, x : x + width]
        samples.append(cv2.resize(part, (columns, rows), interpolation=cv2.INTER_AREA))
    return np.stack(samples)


IMPLEMENTATIONS = {"native": _core.sample_windows, "reference": reference.sample_windows, "baseline": script}


@pytest.mark.parametrize("sample_windows", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
@pytest.mark.parametrize(
    ("windows", "side"),
    [
        pytest.param(
            ONE,
            64,
            marks=[
                pytest.mark.benchmark(group="sample_windows, one of 150 px to 64x64"),
                pytest.mark.work(flops32=64 * 64 * 3 * 12, ops8=4 * 64 * 6 * 450, why="3 of 8 lanes"),
            ],
        ),
        pytest.param(
            SCALES,
            12,
            marks=[
                pytest.mark.benchmark(group="sample_windows, 11 of 75 px to 12x12"),
                pytest.mark.work(
                    flops32=11 * 12 * 12 * 4 * 12, ops8=4 * 11 * 12 * 8 * 225, why="3 of 8 lanes"
                ),
            ],
        ),
    ],
    ids=["one", "scales"],
)
def bench_sample_windows(
    benchmark: Any, sample_windows: Callable[..., Image], frame: Image, windows: Floats, side: int
) -> None:
    """The twins give the same bytes. The baseline's windows are off by up to half a pixel, which on smooth
    images is one gray level on average.
    """
    samples = benchmark(sample_windows, frame, windows, side, side)
    differences = abs(samples.astype(int) - reference.sample_windows(frame, windows, side, side))
    assert differences.mean() < 2 if sample_windows is script else not differences.any()
