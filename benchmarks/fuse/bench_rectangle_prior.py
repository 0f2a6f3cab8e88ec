# SPDX-License-Identifier: MIT
"""The prior of 100 rectangles: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
STATE = np.array([0.1, -0.2, 3.0, 0.6, 1.7])
ARGUMENTS = (
    random.normal(STATE, [0.2, 0.05, 0.2, 0.06, 0.1], (100, 5)),
    (np.array([0.55, 1.75]), np.array([0.25, 0.2])),
    (STATE, 1.2 * np.array([0.05, 0.06, 0.06, 0.06, 0.08]), 12.0),
)


def script(
    states: Floats, mean_size: tuple[Floats, Floats], measured: tuple[Floats, Floats, float]
) -> Floats:
    """The baseline: the same without checks of arguments."""
    (size, spread), (state, deviation, most) = mean_size, measured
    off, away = np.log(states[:, 3:] / size) / spread, (states - state) / deviation
    return -(off * off).sum(axis=1) / 2 - np.minimum((away * away).sum(axis=1) / 2, most)


IMPLEMENTATIONS = {
    "native": _core.rectangle_prior,
    "reference": reference.rectangle_prior,
    "baseline": script,
}


@pytest.mark.benchmark(group="rectangle_prior")
@pytest.mark.work(flops64=100 * (2 * 20 + 20), why="logarithms, one by one")
@pytest.mark.parametrize("rectangle_prior", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_rectangle_prior(benchmark: Any, rectangle_prior: Callable[..., Floats]) -> None:
    """All compute the same prior, within the rounding of seven squares."""
    prior = benchmark(rectangle_prior, *ARGUMENTS)
    assert_allclose(prior, reference.rectangle_prior(*ARGUMENTS), rtol=20 * 2.0**-52)
    assert prior.min() < -12  # some reach the largest cost
