# SPDX-License-Identifier: MIT
"""A turned window on a grid: native, reference, and OpenCV's mean over squares and warpAffine."""

import math
from collections.abc import Callable
from itertools import cycle
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]

ANGLE = math.radians(33)
X, Y = 160.3, 119.6
SIDES = np.array([math.cos(ANGLE), math.sin(ANGLE), -math.sin(ANGLE), math.cos(ANGLE)])


def script(image: Image, windows: Floats, rows: int, columns: int) -> Image:
    """The baseline: a box filter, then warpAffine."""
    side = round(math.hypot(*windows[0, 2:4]) / columns)
    axes = np.column_stack([windows[0, 2:4] / columns, windows[0, 4:] / rows])
    corner = windows[0, :2] - 0.5 * side - axes @ [columns / 2 - 0.5, rows / 2 - 0.5]
    means = cv2.blur(image, (side, side), anchor=(0, 0)) if side > 1 else image
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return cv2.warpAffine(means, np.column_stack([axes, corner]), (columns, rows), flags=flags)[None]


IMPLEMENTATIONS = {
    "native": _core.sample_turned_windows,
    "reference": reference.sample_turned_windows,
    "baseline": script,
}


@pytest.mark.parametrize("sample_turned_windows", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
@pytest.mark.parametrize(
    "length",
    [
        pytest.param(
            75.0,
            marks=[
                pytest.mark.benchmark(group="sample_turned_windows, 75 px to 64x64"),
                pytest.mark.work(ops8=64 * 64 * 54, why="6 of 8 lanes, addresses one by one"),
            ],
        ),
        pytest.param(
            150.0,
            marks=[
                pytest.mark.benchmark(group="sample_turned_windows, 150 px to 64x64"),
                pytest.mark.work(ops8=64 * 64 * 126, why="9 of 16 lanes, addresses one by one"),
            ],
        ),
    ],
    ids=["75", "150"],
)
def bench_sample_turned_windows(
    benchmark: Any, sample_turned_windows: Callable[..., Image], frame: Image, length: float
) -> None:
    """The twins give the same bytes; the baseline rounds places and means differently."""
    windows = np.array([[X, Y, *(length * SIDES)]])
    samples = benchmark(sample_turned_windows, frame, windows, 64, 64)
    differences = abs(samples.astype(int) - reference.sample_turned_windows(frame, windows, 64, 64))
    assert differences.mean() < 1 if sample_turned_windows is script else not differences.any()


@pytest.mark.parametrize("sample_turned_windows", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
@pytest.mark.benchmark(group="sample_turned_windows, 260 px to 64x64, new frames")
@pytest.mark.work(bytes=260 * 260 * 3, ops8=64 * 64 * 315, why="rows across lines of the cache")
def bench_sample_turned_windows_of_new_frames(
    benchmark: Any, sample_turned_windows: Callable[..., Image], new_frames: list[Image]
) -> None:
    """As in video, no frame is in the cache. On noise, the baseline's rounding of places differs by more than
    on smooth images.
    """
    windows, frames = np.array([[320.3, 239.6, *(260.0 * SIDES)]]), cycle(new_frames)
    benchmark(lambda: sample_turned_windows(next(frames), windows, 64, 64))
    samples = sample_turned_windows(new_frames[0], windows, 64, 64)
    differences = abs(samples.astype(int) - reference.sample_turned_windows(new_frames[0], windows, 64, 64))
    assert differences.mean() < 3 if sample_turned_windows is script else not differences.any()
