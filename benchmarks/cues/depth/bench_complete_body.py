# SPDX-License-Identifier: MIT
"""A body joined with a leg and an arm, among eight objects: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
Shares = NDArray[np.float32]
Flags = NDArray[np.bool_]
COUNT, BINS = 8, 16
random = np.random.default_rng(0)
EXPECTED = np.array([0.0, 0.0, 3.0, 0.7, 1.8])
BODY, LEG, ARM = [0.0, -0.3, 3.0, 0.6, 1.2], [0.1, 0.6, 3.0, 0.2, 0.5], [-0.32, -0.2, 3.0, 0.1, 0.6]
STATES = np.array([BODY, LEG, ARM, *(EXPECTED + [1.5 + i, 0, 1, 0, 0] for i in range(COUNT - 3))])
OBJECTS = (
    np.column_stack([STATES, random.normal(0, 0.05, (COUNT, 2)), 0.6 * STATES[:, 3] * STATES[:, 4]]),
    np.arange(4 * COUNT).reshape(COUNT, 4) == 7,
    random.dirichlet(np.ones(BINS), COUNT).astype(np.float32),
    random.dirichlet(np.ones(BINS), COUNT).astype(np.float32),
)
ARGUMENTS = OBJECTS, 0, (EXPECTED, EXPECTED[3:].copy(), np.array([True, True])), (1.3, 0.8, 1.15, 0.4)


def script(
    objects: tuple[Floats, Flags, Shares, Shares],
    index: int,
    body: tuple[Floats, Floats, Flags],
    limits: tuple[float, float, float, float],
) -> tuple[Floats, Flags, Floats, Floats]:
    """The baseline: all objects in the region at once, cut at most at the bottom, without checks."""
    measured, cut, columns, rows = objects
    (expected, size, _), (region, inside, _, reach) = body, limits
    centers, extents, z = measured[:, :2], measured[:, 3:5], measured[:, 2]
    low = np.maximum(centers - extents / 2, expected[:2] - region * expected[3:] / 2)
    high = np.minimum(centers + extents / 2, expected[:2] + region * expected[3:] / 2)
    share = (np.maximum(high - low, 0) / extents).prod(axis=1)
    own = (share > inside) & (abs(z - z[index]) < reach)
    scale = (z[index] / z[own])[:, None]
    first = ((centers - extents / 2)[own] * scale).min(axis=0)
    last = ((centers + extents / 2)[own] * scale).max(axis=0)
    sides = cut[own].any(axis=0)
    middle = (first + last) / 2
    centroid = np.average((centers + measured[:, 5:7])[own], axis=0, weights=measured[own, 7])
    state = np.array([*middle, z[index], *(last - first)])
    if sides[3] and state[4] < size[1]:
        state[[1, 4]] = state[1] + (size[1] - state[4]) / 2, size[1]
    signature = np.concatenate([columns[index], rows[index], centroid - middle], dtype=np.float64)
    return state, ~(sides[::2] | sides[1::2]), size, signature


@pytest.mark.benchmark(group="complete_body")
@pytest.mark.work(flops64=COUNT * 24 + 2 * 60, why="the call takes most")
@pytest.mark.parametrize(
    "complete_body",
    [_core.complete_body, reference.complete_body, script],
    ids=["native", "reference", "baseline"],
)
def bench_complete_body(benchmark: Any, complete_body: Callable[..., Any]) -> None:
    """All join both pieces, one of which is cut; they differ by the rounding of lengths below 8 m."""
    body = benchmark(complete_body, *ARGUMENTS)
    for one, other in zip(body, reference.complete_body(*ARGUMENTS), strict=True):
        assert_allclose(one, other, rtol=1e-12, atol=1e-13)
    assert_allclose(body[0], [-0.035, 0.0, 3.0, 0.67, 1.8], atol=1e-12)
    assert body[1].tolist() == [True, False]
