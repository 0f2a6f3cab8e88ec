# SPDX-License-Identifier: MIT
"""Learning of colors in and around a target, 600 samples each: native, reference, and an OpenCV script."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import ring

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Cube = NDArray[np.float32]


def script(
    image: Image,
    ellipse: Floats,
    pattern: tuple[Floats, Floats],
    target: Cube,
    surround: Cube,
    rate: float,
    rare: float,
) -> list[Cube]:
    """The baseline: indices, calcHist and NumPy."""
    learned = []
    for places, old in zip(pattern, (target, surround), strict=True):
        columns, rows = (ellipse[:2] + ellipse[2:] * places).astype(int).T
        samples = image[rows, columns][None]
        seen = cv2.calcHist([samples], [0, 1, 2], None, 3 * [len(old)], 3 * [0, 256]) / samples.shape[1]
        learned.append(old + np.float32(rate) * (seen - old))
    own, other = learned
    return [own, other, own / (own + other + np.float32(rare))]


@pytest.mark.benchmark(group="learn_contrast")
@pytest.mark.work(
    bytes=5 * 4 * 4096, divs32=4096, counts=2 * 600, lookups=2 * 600, why="a cube for 600 counts"
)
@pytest.mark.parametrize(
    "learn_contrast",
    [_core.learn_contrast, reference.learn_contrast, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_contrast(benchmark: Any, learn_contrast: Callable[..., Any], frame: Image) -> None:
    """All learn the same, except for samples that rounding moves to the next pixel."""
    rng = np.random.default_rng(0)
    target, surround = (cube / cube.sum() for cube in rng.random((2, 16, 16, 16), np.float32))
    ellipse, pattern = np.array([160.0, 120, 25, 31]), (ring(600, 0.0, 1.0), ring(600, 1.15, 2.0))
    arguments = (frame, ellipse, pattern, target, surround, 0.06, 1e-4)
    expected = reference.learn_contrast(*arguments)
    learned = benchmark(learn_contrast, *arguments)
    for found, other in zip(learned[:2], expected[:2], strict=True):
        assert_allclose(found, other, rtol=1e-5, atol=0.06 * 4 / 600 if learn_contrast is script else 1e-7)
    assert_allclose(learned[2], learned[0] / (learned[0] + learned[1] + np.float32(1e-4)), rtol=1e-5)
