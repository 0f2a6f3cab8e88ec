# SPDX-License-Identifier: MIT
"""The mixture proposal for 100 ellipses: native, reference, and a NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
random = np.random.default_rng(0)
ARGUMENTS = (
    random.normal(100, 20, (100, 4)),
    (np.array([3.0, -2.0, 0.0, 0.0]), np.array([8.0, 8.0, 1.0, 1.0])),
    random.normal(size=(100, 4)),
    (np.array([110.0, 95.0]), np.array([[8.0, 0.0], [-3.0, 5.0]]), 0.25),
    (np.array([0.0, 0.0, 5.0, 5.0]), np.array([320.0, 240.0, 60.0, 60.0])),
)


def script(
    particles: Floats,
    dynamics: tuple[Floats, Floats],
    noise: Floats,
    detection: tuple[Floats, Floats, float],
    bounds: tuple[Floats, Floats],
) -> Floats:
    """The baseline: the same without checks of arguments."""
    (drift, scale), (mean, root, share), (lower, upper) = dynamics, detection, bounds
    moved = particles + drift + scale * noise
    every = round(1 / share)
    moved[every - 1 :: every, :2] = mean + noise[every - 1 :: every, :2] @ root.T
    return np.minimum(np.maximum(moved, lower), upper)


IMPLEMENTATIONS = {"native": _core.propose, "reference": reference.propose, "baseline": script}


@pytest.mark.benchmark(group="propose")
@pytest.mark.work(flops64=4 * 100 * 4, why="the call takes a third")
@pytest.mark.parametrize("propose", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_propose(benchmark: Any, propose: Callable[..., Floats]) -> None:
    """All draw the same particles."""
    moved = benchmark(propose, *ARGUMENTS)
    assert_allclose(moved, reference.propose(*ARGUMENTS), rtol=1e-14)
