# SPDX-License-Identifier: MIT
"""Colors in and round a target, 600 samples each, learned: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]
Cube = NDArray[np.float32]


def script(
    inside: Image, around: Image, target: Cube, surround: Cube, rate: float, rare: float
) -> list[Cube]:
    """The baseline: calcHist and addWeighted."""
    learned = []
    for samples, old in ((inside, target), (around, surround)):
        planes = list(samples[0][:, None])
        seen = cv2.calcHist(planes, [0, 1, 2], None, 3 * [len(old)], 3 * [0, 256]) / samples.shape[2]
        learned.append(old + np.float32(rate) * (seen - old))
    own, other = learned
    return [own, other, own / (own + other + np.float32(rare))]


@pytest.mark.benchmark(group="learn_contrast")
@pytest.mark.work(bytes=5 * 4 * 4096, divs32=4096, counts=2 * 600, why="a cube for 600 counts")
@pytest.mark.parametrize(
    "learn_contrast",
    [_core.learn_contrast, reference.learn_contrast, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_contrast(benchmark: Any, learn_contrast: Callable[..., Any]) -> None:
    """All learn the same."""
    rng = np.random.default_rng(0)
    inside, around = (rng.normal(m, 40, (1, 3, 600)).clip(0, 255).astype(np.uint8) for m in (90, 150))
    target, surround = (cube / cube.sum() for cube in rng.random((2, 16, 16, 16), np.float32))
    arguments = (inside, around, target, surround, 0.06, 1e-4)
    for learned, expected in zip(
        benchmark(learn_contrast, *arguments), reference.learn_contrast(*arguments), strict=True
    ):
        assert_allclose(learned, expected, rtol=1e-5, atol=1e-7)
