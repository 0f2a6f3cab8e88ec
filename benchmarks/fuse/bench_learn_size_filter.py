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
PLACES = random.permutation(64 * 64).reshape(64, 64)
TAPER = random.random((32, 32), np.float32)
LABEL = np.ascontiguousarray(np.fft.rfft2(np.exp(-random.random((32, 32)))), np.complex64)
NUMERATORS = np.ascontiguousarray(np.fft.rfft2(random.uniform(-1, 1, (2, 19, 32, 32))), np.complex64)
DENOMINATORS = 1000 * random.random((2, 32, 17), np.float32)
LEARNED, FIRST = zip(NUMERATORS, DENOMINATORS, strict=True)


def script(patch: Any, places: Any, taper: Any, label: Any, before: Any, oldest: Any, *rates: float) -> Any:
    """The baseline: a call for each part, and NumPy."""
    rate, share, ridge = rates
    cells = _core.hog_color_cells(_core.pick_pixels(patch, places), taper)
    learned = _core.correlation_train(cells, label, *before, rate)
    upper, lower = (
        own + np.float32(share) * (first - own) for own, first in zip(learned, oldest, strict=True)
    )
    return learned, (upper / (lower + np.float32(ridge) * lower.mean()))[None]


@pytest.mark.benchmark(group="learn_size_filter, 64x64")
@pytest.mark.work(flops32=19 * 25_600 + 19 * 20 * 32 * 17 + 4096 * 100)
@pytest.mark.parametrize(
    "learn_size_filter",
    [_core.learn_size_filter, reference.learn_size_filter, script],
    ids=["native", "reference", "baseline"],
)
def bench_learn_size_filter(benchmark: Any, learn_size_filter: Callable[..., Any]) -> None:
    """All learn the same, within the rounding of transforms in float32."""
    arguments = PATCH, PLACES, TAPER, LABEL, LEARNED, FIRST, 0.1, 0.2, 0.01
    applied = benchmark(learn_size_filter, *arguments)[1]
    expected = reference.learn_size_filter(*arguments)[1]
    assert_allclose(applied, expected, atol=1e-4 * abs(expected).max())
