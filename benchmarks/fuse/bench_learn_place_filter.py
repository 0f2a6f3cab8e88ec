# SPDX-License-Identifier: MIT
"""Learning of a filter from a patch of 64x64 pixels: native, reference, and its parts one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from tricue import _core, reference

random = np.random.default_rng(0)
PATCH = random.integers(0, 256, (64, 64, 3), np.uint8)
TAPER = random.random((32, 32), np.float32)
PROFILE = np.clip(1.5 - abs(np.arange(32) - 15.5) / 6, 0, 1)
MASK = np.outer(PROFILE, PROFILE).astype(np.float32)
LABEL = np.ascontiguousarray(np.fft.rfft2(np.exp(-random.random((32, 32)))), np.complex64)
WEIGHTS = random.uniform(-1, 1, (2, 19, 32, 32)) / 1024
BEFORE, FIRST = np.ascontiguousarray(np.fft.rfft2(WEIGHTS), np.complex64)


def script(patch: Any, taper: Any, mask: Any, label: Any, before: Any, first: Any, *weights: float) -> Any:
    """The baseline: a call for each part, and NumPy."""
    cells = _core.hog_color_cells(patch, taper)
    learned = _core.regularized_filter(cells, mask, label, before, *weights[:2])
    return learned, np.stack([learned + np.float32(weights[2]) * (first - learned), first])


@pytest.mark.benchmark(group="learn_place_filter, 64x64")
@pytest.mark.work(flops32=95 * 25_600 + 19 * 60 * 32 * 17 + 4096 * 100)
@pytest.mark.parametrize(
    "learn_place_filter",
    [_core.learn_place_filter, reference.learn_place_filter, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_place_filter(benchmark: Any, learn_place_filter: Callable[..., Any]) -> None:
    """All learn the same, within the rounding of transforms in float32."""
    arguments = PATCH, TAPER, MASK, LABEL, BEFORE, FIRST, 2.0, 0.05, 0.2
    applied = benchmark(learn_place_filter, *arguments)[1]
    expected = reference.learn_place_filter(*arguments)[1]
    assert_allclose(applied, expected, atol=1e-4 * abs(expected).max())
