# SPDX-License-Identifier: MIT
"""A step of the filter with 100 rectangles: native, reference, and the native stages called one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
N, STATE, CAMERA = 100, np.array([0.0, 0.1, 3.0, 0.6, 1.6]), np.array([200.0, 200, 87.5, 71.5])
DEPTH = np.full((144, 176), 5, np.float32)
DEPTH[25:132, 67:108] = 3
DEPTH += random.normal(0, 0.02, DEPTH.shape).astype(np.float32)
PARTICLES = random.normal(STATE, [0.1, 0.05, 0.1, 0.03, 0.05], (N, 5))
NOISE = random.standard_normal((2, N, 5))
DYNAMICS = np.zeros(5), np.array([0.06, 0.03, 0.06, 0.04, 0.1])
BOUNDS = np.array([-np.inf, -np.inf, 0.3, 0.1, 0.1]), np.array([np.inf, np.inf, 8, np.inf, np.inf])
DETECTION = STATE, np.diag([0.05, 0.06, 0.06, 0.06, 0.08]), 0.4
REFINEMENT = np.array([0.06, 0.05, 0.05, 0.03, 0.08]), 0.1
MODEL = random.dirichlet(np.ones(64))
VIEW = (MODEL, 0.5), (14, 10, 1.25, 12), 0.3
PRIOR = (STATE[3:], np.array([0.25, 0.2])), (STATE, 1.2 * DETECTION[1].diagonal(), 12.0)
WEIGHTS = np.full(N, 1 / N)
LIKELIHOOD = MODEL, 0.0, 0.5, VIEW[1], 0.5, 0.3, False, 30.0, 8.0
ARGUMENTS = (
    *(DEPTH, CAMERA, (PARTICLES, WEIGHTS, 0.5), NOISE, DYNAMICS, BOUNDS, DETECTION, REFINEMENT),
    *(LIKELIHOOD, PRIOR),
)


def log_likelihood(states: Floats) -> Floats:
    """The log-likelihood of each rectangle."""
    seen = _core.depth_contrast(DEPTH, CAMERA, states, *VIEW)
    likeness = -30 * seen[:, 0] ** 2 + 8 * (seen[:, 1] - seen[:, 3])
    return likeness + _core.rectangle_prior(states, *PRIOR)


def script(*_: Any) -> tuple[Floats, ...]:
    """The baseline: a call for each stage, and NumPy between them."""
    previous = PARTICLES[_core.resample(WEIGHTS, 0.5)]
    states = _core.propose(previous, DYNAMICS, NOISE[0], DETECTION, BOUNDS)
    weights, _ = _core.reweight(log_likelihood(states), states, previous, DYNAMICS, DETECTION)
    mean, *_ = _core.summarize(states, weights)
    states = mean + REFINEMENT[0] * NOISE[1]
    np.maximum(states[:, 3:], REFINEMENT[1], out=states[:, 3:])
    logs = log_likelihood(states)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    mean, covariance, _ = _core.summarize(states, weights)
    return states, weights, mean, covariance


@pytest.mark.benchmark(group="filter_rectangles")
@pytest.mark.work(flops64=2 * N * (188 * 6 + 64 * 4 + 100), why="each place is read, and counted, by itself")
@pytest.mark.parametrize(
    "filter_rectangles",
    [_core.filter_rectangles, reference.filter_rectangles, script],
    ids=["native", "reference", "baseline"],
)
def bench_filter_rectangles(benchmark: Any, filter_rectangles: Callable[..., Any]) -> None:
    """All find the same, within the rounding of the log-likelihoods."""
    found, expected = benchmark(filter_rectangles, *ARGUMENTS), reference.filter_rectangles(*ARGUMENTS)
    for one, other in zip(found, expected, strict=False):
        assert_allclose(one, other, rtol=1e-11, atol=1e-13)
