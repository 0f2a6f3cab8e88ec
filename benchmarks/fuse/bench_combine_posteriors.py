# SPDX-License-Identifier: MIT
"""Posteriors of two cues at 64x64 places: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]


def script(first: Plane, second: Plane) -> Plane:
    """The baseline: whole planes by OpenCV's arithmetic."""
    target, rest = cv2.multiply(first, second), cv2.multiply(1 - first, 1 - second)
    return np.asarray(cv2.divide(target, cv2.max(cv2.add(target, rest), 1e-9)))


@pytest.mark.benchmark(group="combine_posteriors, 64x64")
@pytest.mark.work(bytes=3 * 4 * 64 * 64, divs32=64 * 64)
@pytest.mark.parametrize(
    "combine",
    [_core.combine_posteriors, reference.combine_posteriors, script],
    ids=["native", "reference", "baseline"],
)
def bench_combine_posteriors(benchmark: Any, combine: Callable[..., Plane]) -> None:
    """All combine the same."""
    planes = np.random.default_rng(0).random((2, 64, 64), np.float32)
    assert_allclose(benchmark(combine, *planes), reference.combine_posteriors(*planes), rtol=1e-6)
