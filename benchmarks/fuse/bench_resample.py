# SPDX-License-Identifier: MIT
"""Systematic resampling of 100 particles: native, reference, and a few lines of NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

WEIGHTS = np.random.default_rng(0).exponential(size=100)
OFFSET = 0.3


def script(weights: NDArray[np.float64], offset: float) -> NDArray[np.int64]:
    """The baseline: searchsorted in the cumulative sum."""
    cumulative = np.cumsum(weights / weights.sum())
    cumulative[-1] = 1.0
    teeth = (np.arange(len(weights)) + offset) / len(weights)
    return np.searchsorted(cumulative, teeth, side="right")


IMPLEMENTATIONS = {"native": _core.resample, "reference": reference.resample, "baseline": script}


@pytest.mark.benchmark(group="resample")
@pytest.mark.work(in_turn=100, why="the call takes half")
@pytest.mark.parametrize("resample", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_resample(benchmark: Any, resample: Callable[..., NDArray[np.int64]]) -> None:
    """All choose the same particles."""
    chosen = benchmark(resample, WEIGHTS, OFFSET)
    assert_array_equal(chosen, reference.resample(WEIGHTS, OFFSET))
