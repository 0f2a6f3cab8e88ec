# SPDX-License-Identifier: MIT
"""Learning of colors from a patch of 64x64 pixels: native, reference, and a script on OpenCV and NumPy."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tricue import _core, reference

random = np.random.default_rng(0)
PATCH = random.integers(0, 256, (64, 64, 3), np.uint8)
OTHER = random.random((64, 64), np.float32)
TARGET, SURROUND = random.random((2, 16, 16, 16), np.float32)


def script(patch: Any, other: Any, pixels: Any, target: Any, surround: Any, rate: float, rare: float) -> Any:
    """The baseline: masks of the pixels, calcHist and NumPy."""
    width, height, min_surround_size, min_target_posterior, max_surround_posterior = pixels
    y, x = np.indices(patch.shape[:2])
    u, v = abs(x - 31.5) / (width / 2), abs(y - 31.5) / (height / 2)
    inside, around = u * u + v * v <= 1, np.maximum(u, v) > min_surround_size
    own = inside & (other > min_target_posterior)
    if 2 * own.sum() > inside.sum():
        inside, around = own, around | inside & (other < max_surround_posterior)
    learned = []
    for colors, old in ((patch[inside], target), (patch[around], surround)):
        seen = cv2.calcHist([colors[None]], [0, 1, 2], None, 3 * [16], 3 * [0, 256]) / len(colors)
        learned.append(old + np.float32(rate) * (seen - old))
    return *learned, (learned[0] + np.float32(rare / 2)) / (learned[0] + learned[1] + np.float32(rare))


@pytest.mark.benchmark(group="learn_patch_colors, 64x64")
@pytest.mark.work(bytes=3 * 4096 + 5 * 4 * 4096, why="counts, pixel by pixel")
@pytest.mark.parametrize(
    "learn_patch_colors",
    [_core.learn_patch_colors, reference.learn_patch_colors, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_patch_colors(benchmark: Any, learn_patch_colors: Callable[..., Any]) -> None:
    """All learn the same."""
    arguments = PATCH, OTHER, (17.4, 26.1, 1.1, 0.4, 0.1), TARGET, SURROUND, 0.1, 1e-4
    for found, expected in zip(
        benchmark(learn_patch_colors, *arguments), reference.learn_patch_colors(*arguments), strict=True
    ):
        assert_array_equal(found, expected)
