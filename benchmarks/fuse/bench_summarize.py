# SPDX-License-Identifier: MIT
"""Mean, covariance and effective size of 100 ellipses: native, reference, and NumPy's own functions."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
PARTICLES = random.normal(100, 20, (100, 4))
WEIGHTS = random.exponential(size=100)
WEIGHTS /= WEIGHTS.sum()


def script(particles: Floats, weights: Floats) -> tuple[Floats, Floats, float]:
    """The baseline: np.average and np.cov."""
    mean = np.average(particles, axis=0, weights=weights)
    return mean, np.cov(particles.T, aweights=weights, ddof=0), 1 / float(np.square(weights).sum())


IMPLEMENTATIONS = {"native": _core.summarize, "reference": reference.summarize, "baseline": script}


@pytest.mark.benchmark(group="summarize")
@pytest.mark.work(flops64=100 * 42, why="the call takes a third")
@pytest.mark.parametrize("summarize", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_summarize(benchmark: Any, summarize: Callable[..., tuple[Floats, Floats, float]]) -> None:
    """All give the same moments."""
    summary = benchmark(summarize, PARTICLES, WEIGHTS)
    for ours, theirs in zip(summary, script(PARTICLES, WEIGHTS), strict=True):
        assert_allclose(ours, theirs, rtol=1e-10, atol=1e-10)
