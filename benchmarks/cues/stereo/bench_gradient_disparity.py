# SPDX-License-Identifier: MIT
"""Gradient disparity near a prediction: native, reference, a script on cv2 and NumPy, cv2.StereoBM."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.flow_depth.cues import GradientMatching

Image = NDArray[np.uint8]
Floats = NDArray[np.float32]
Measure = Callable[[Image, Image], Floats]

TRUTH, PREDICTION = 8.4, 7.0
COUNT = 16  # disparities of StereoBM: those within 8 px of the prediction


def pair(height: int) -> tuple[Image, Image]:
    """A pair of aspect ratio 4:3: texture with a disparity of 8.4 pixels, and a noisy right image."""
    width = height * 4 // 3
    rng = np.random.default_rng(0)
    texture = cv2.GaussianBlur(rng.normal(0, 1, (height, width + 40)), (0, 0), 1.5)
    texture = 128 + 45 * texture / texture.std()
    move = np.array([[1, 0, 10 + TRUTH], [0, 1, 0]])
    moved = cv2.warpAffine(texture, move, (width, height), flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP)
    noisy = moved + rng.normal(0, 2, moved.shape)
    return texture[:, 10 : 10 + width].clip(0, 255).astype(np.uint8), noisy.clip(0, 255).astype(np.uint8)


def kernel(measure: Callable[..., tuple[Floats, Floats]]) -> Measure:
    """The disparities that a kernel measures."""
    return lambda left, right: measure(left, right, PREDICTION, GradientMatching())[0]


def script(left: Image, right: Image) -> Floats:
    """The baseline: cv2's pyramid, filters and warp, with three levels and the same limits."""
    lefts, rights = [left.astype(np.float32)], [right.astype(np.float32)]
    for _ in range(2):
        lefts.append(cv2.pyrDown(lefts[-1]))
        rights.append(cv2.pyrDown(rights[-1]))
    known = np.full(lefts[-1].shape, PREDICTION / 4, np.float32)
    for one, other in zip(lefts[::-1], rights[::-1], strict=True):
        height, width = one.shape
        if known.shape != one.shape:
            known = 2 * cv2.resize(known, (width, height), interpolation=cv2.INTER_NEAREST)
        slopes = [
            cv2.Sobel(cv2.GaussianBlur(each, (7, 7), 1), cv2.CV_32F, 1, 0, scale=1 / 8)
            for each in (one, other)
        ]
        x, y = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
        f_left, f_right = slopes[0], cv2.remap(slopes[1], x - known, y, cv2.INTER_LINEAR)
        x_left, x_right = (cv2.Sobel(f, cv2.CV_32F, 1, 0, ksize=1, scale=0.5) for f in (f_left, f_right))
        s = (x_left + x_right) / 2
        t = f_right - f_left
        ss, st, tt, power, reliability = (
            cv2.blur(each, (5, 5))
            for each in (s * s, s * t, t * t, f_left**2 + f_right**2, x_left**2 + x_right**2)
        )
        step = st / (ss + np.float32(0.01))
        known = known + step.clip(-1.5, 1.5)
    left_over = tt - 2 * step * st + step**2 * ss
    kept = (reliability >= 0.3) & (left_over <= 0.2 * power) & (abs(step) <= 1)
    return np.where(kept, known, np.float32(np.nan))


def block_matching() -> Measure:
    """StereoBM from 0 to 15 px, 5x5."""
    matcher = cv2.StereoBM.create(COUNT, 5)

    def compute(left: Image, right: Image) -> Floats:
        found = matcher.compute(left, right)
        return np.asarray(np.where(found >= 0, found, np.nan) / np.float32(16))

    return compute


IMPLEMENTATIONS = {
    "native": kernel(_core.gradient_disparity),
    "reference": kernel(reference.gradient_disparity),
    "script": script,
    "StereoBM": block_matching(),
}


def check(benchmark: Any, measure: Measure, height: int) -> None:
    """Of the pixels that the right image shows, nearly all are measured within 1 px, half within 0.15 px."""
    left, right = pair(height)
    found = benchmark(measure, left, right)[8:-8, 24:-8]
    errors = abs(found[np.isfinite(found)] - TRUTH)
    assert errors.size > 0.85 * found.size
    assert (errors < 1).mean() > 0.97
    assert np.median(errors) < 0.15


@pytest.mark.benchmark(group="gradient_disparity, 160x120")
@pytest.mark.work(flops32=130 * 160 * 120 * 21 // 16)
@pytest.mark.parametrize("measure", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_gradient_disparity(benchmark: Any, measure: Measure) -> None:
    """All find the same."""
    check(benchmark, measure, 120)


@pytest.mark.benchmark(group="gradient_disparity, 640x480")
@pytest.mark.work(flops32=130 * 640 * 480 * 21 // 16)
@pytest.mark.parametrize("measure", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_gradient_disparity_large(benchmark: Any, measure: Measure) -> None:
    """All find the same."""
    check(benchmark, measure, 480)
