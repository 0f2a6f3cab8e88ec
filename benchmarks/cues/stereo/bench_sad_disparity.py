# SPDX-License-Identifier: MIT
"""Block matching: native, reference and cv2.StereoBM; in whole images and, as in a tracker, in a head."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Disparity = NDArray[np.float32]
Matcher = Callable[[Image, Image], Disparity]

COUNT, WINDOW = 16, 5
MATCHING = WINDOW, 15, True
WHOLE = (COUNT - 1, 0, 160, 120)  # the columns that StereoBM computes
HEAD = (70, 40, 100, 76)


def pair() -> tuple[Image, Image]:
    """A pair of 160x120: texture with a disparity of 8 pixels, and a noisy right image."""
    rng = np.random.default_rng(0)
    texture = cv2.GaussianBlur(rng.normal(0, 1, (120, 200)), (0, 0), 1.2)
    texture = 128 + 45 * texture / texture.std()
    noisy = texture[:, 18:178] + rng.normal(0, 2, (120, 160))
    return texture[:, 10:170].astype(np.uint8), noisy.clip(0, 255).astype(np.uint8)


def whole(kernel: Callable[..., Disparity]) -> Matcher:
    """The part of the image that StereoBM computes."""
    return lambda left, right: kernel(left, right, WHOLE, False, (0, COUNT - 1), MATCHING)


def head(kernel: Callable[..., Disparity]) -> Matcher:
    """An ellipse, and 9 disparities."""
    return lambda left, right: kernel(left, right, HEAD, True, (4, 12), MATCHING)


def baseline(region: tuple[int, int, int, int]) -> Matcher:
    """StereoBM on the whole image: it has no regions, and at least 16 disparities."""
    matcher = cv2.StereoBM_create(COUNT, WINDOW)
    x0, y0, x1, y1 = region

    def compute(left: Image, right: Image) -> Disparity:
        found = matcher.compute(left, right)[y0:y1, x0:x1]
        return np.asarray(np.where(found >= 0, found, np.nan) / np.float32(16))

    return compute


IMPLEMENTATIONS = {"native": _core.sad_disparity, "reference": reference.sad_disparity}


def check(benchmark: Any, match: Matcher) -> None:
    """Nearly all pixels are matched, nearly all of these within 1 px, half within 0.15 px."""
    left, right = pair()
    found = benchmark(match, left, right)
    errors = abs(found[np.isfinite(found)] - 8)
    assert errors.size > 0.9 * np.pi / 4 * found.size
    assert (errors < 1).mean() > 0.98  # except beside the edge
    assert np.median(errors) < 0.15


@pytest.mark.benchmark(group="sad_disparity, 160x120")
@pytest.mark.work(ops8=20 * 145 * 120 * 16)
@pytest.mark.parametrize(
    "match", [*map(whole, IMPLEMENTATIONS.values()), baseline(WHOLE)], ids=[*IMPLEMENTATIONS, "baseline"]
)
def bench_sad_disparity(benchmark: Any, match: Matcher) -> None:
    """All find the same."""
    check(benchmark, match)


@pytest.mark.benchmark(group="sad_disparity, head of 30x36")
@pytest.mark.work(ops8=20 * 30 * 36 * 9 * 3 // 4, why="rows of 30 pixels")
@pytest.mark.parametrize(
    "match", [*map(head, IMPLEMENTATIONS.values()), baseline(HEAD)], ids=[*IMPLEMENTATIONS, "baseline"]
)
def bench_sad_disparity_head(benchmark: Any, match: Matcher) -> None:
    """All find the same."""
    check(benchmark, match)
