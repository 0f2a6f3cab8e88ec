# SPDX-License-Identifier: MIT
"""Learning of one of two rank maps of 96 places: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Singles = NDArray[np.float32]


def script(models: Singles, ranks: Singles, rate: float) -> Singles:
    """The baseline: addWeighted."""
    return np.stack([cv2.addWeighted(models[0], 1 - rate, ranks, rate, 0), models[1]])


@pytest.mark.benchmark(group="learn_ranks")
@pytest.mark.work(bytes=5 * 4 * 288, why="the call")
@pytest.mark.parametrize(
    "learn_ranks", [_core.learn_ranks, reference.learn_ranks, script], ids=["native", "reference", "baseline"]
)
def bench_learn_ranks(benchmark: Any, learn_ranks: Callable[..., Any]) -> None:
    """All learn the same, within float32's rounding."""
    rng = np.random.default_rng(0)
    models, ranks = rng.random((2, 3, 96), np.float32), rng.random((3, 96), np.float32)
    learned = benchmark(learn_ranks, models, ranks, 0.14)
    assert_allclose(learned, reference.learn_ranks(models, ranks, 0.14), rtol=0, atol=3e-7)
