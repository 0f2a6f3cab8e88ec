# SPDX-License-Identifier: MIT
"""The cells of a search for a head, 60x56 with 9 disparities: native, reference, and an OpenCV script."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]

REGION = (60, 30, 120, 86)
SPACE = (16, 16, 8), 64
DISPARITY, TOLERANCE, FILL = 8.0, 0.6, 7
SEARCH = (4, 12), (5, 5, True)


def pair() -> tuple[Image, Image]:
    """A pair of 160x120: colored texture with a disparity of 8 pixels."""
    noise = cv2.GaussianBlur(np.random.default_rng(0).normal(0, 1, (120, 200, 3)), (0, 0), 1.2)
    texture = (128 + 45 * noise / noise.std()).clip(0, 255).astype(np.uint8)
    return np.ascontiguousarray(texture[:, 10:170]), np.ascontiguousarray(texture[:, 18:178])


def script(left: Image, right: Image, *arguments: Any) -> tuple[NDArray[np.uint16], Image]:
    """The baseline: cv2's gray levels and box filter, and our block matching, as StereoBM has no regions."""
    bins = _core.color_bins(left, REGION, SPACE, 1)
    gray = cv2.cvtColor(left, cv2.COLOR_BGR2GRAY), cv2.cvtColor(right, cv2.COLOR_BGR2GRAY)
    disparities = _core.sad_disparity(*gray, REGION, False, *SEARCH)
    off = np.abs(disparities - np.float32(DISPARITY))
    near, beyond = off <= np.float32(TOLERANCE), off > np.float32(TOLERANCE)
    votes = (near.view(np.int8) - beyond.view(np.int8)).astype(np.int16)
    majority = cv2.boxFilter(votes, -1, (FILL, FILL), normalize=False, borderType=cv2.BORDER_CONSTANT)
    return bins, np.asarray(near | ((majority > 0) > beyond)).view(np.uint8)


@pytest.mark.benchmark(group="head_cells, 60x56")
@pytest.mark.work(ops8=60 * 56 * (20 * 9 + 2 * 12 + 20), why="rows of 60 cells, in stages")
@pytest.mark.parametrize(
    "head_cells", [_core.head_cells, reference.head_cells, script], ids=["native", "reference", "baseline"]
)
def bench_head_cells(benchmark: Any, head_cells: Callable[..., Any]) -> None:
    """All find the same cells."""
    arguments = (*pair(), REGION, 1, SPACE, None, (DISPARITY, TOLERANCE, FILL), *SEARCH)
    for found, expected in zip(
        benchmark(head_cells, *arguments), reference.head_cells(*arguments), strict=True
    ):
        assert_array_equal(found, expected)
