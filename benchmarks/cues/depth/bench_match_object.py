# SPDX-License-Identifier: MIT
"""The target among eight objects: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
Shares = NDArray[np.float32]
Flags = NDArray[np.bool_]
COUNT, BINS = 8, 16
random = np.random.default_rng(3)
TARGET = np.array([0.2, -0.1, 3.0, 0.6, 1.7])
STATES = TARGET + random.normal(0, [0.3, 0.1, 0.2, 0.1, 0.2], (COUNT, 5))
OBJECTS = (
    np.column_stack([STATES, random.normal(0, 0.1, (COUNT, 2)), np.ones(COUNT)]),
    random.random((COUNT, 4)) < 0.1,
    random.dirichlet(np.ones(BINS), COUNT).astype(np.float32),
    random.dirichlet(np.ones(BINS), COUNT).astype(np.float32),
)
ARGUMENTS = (
    OBJECTS,
    np.empty(0),
    (TARGET, TARGET[3:].copy(), np.array([True, True])),
    np.append(np.full(2 * BINS, 1 / BINS), [0.0, 0.0]),
    ((0.2, 0.4, 0.2, 0.2, 0.05), (0.5, 0.3), 3.0, 8.0, 0.2),
    True,
)


def script(
    objects: tuple[Floats, Flags, Shares, Shares],
    _: Floats,
    body: tuple[Floats, Floats, Flags],
    signature: Floats,
    costs: tuple[tuple[float, ...], Any, float, float, float],
    __: bool,
) -> int:
    """The baseline: all objects at once, for a target of known size; arguments aren't checked."""
    measured, cut, columns, rows = objects
    (expected, size, _), (deviation, _, signature_cost, max_cost, min_area) = body, costs
    states = measured[:, :5].copy()
    half = (size - states[:, 3:]) / 2
    before, after = cut[:, ::2] & (half > 0), cut[:, 1::2] & (half > 0)
    low, high = states[:, :2] - half, states[:, :2] + half
    between = np.clip(expected[:2], np.minimum(low, high), np.maximum(low, high))
    states[:, :2] = np.select([before & after, before, after], [between, low, high], states[:, :2])
    states[:, 3:] = np.where(before | after, size, states[:, 3:])
    off = (states - expected) / np.array([*deviation[:3], *(deviation[3] * size + deviation[4])])
    unlike = np.abs(np.hstack([columns, rows]) - signature[:-2]).sum(axis=1) / 4
    cost = (off**2).sum(axis=1) / 2 + signature_cost * unlike * ~cut.any(axis=1)
    cost[measured[:, 3] * measured[:, 4] < min_area] = np.inf
    best = int(cost.argmin())
    return best if cost[best] < max_cost else -1


@pytest.mark.benchmark(group="match_object")
@pytest.mark.work(flops64=COUNT * (2 * BINS * 3 + 40), why="the call takes most")
@pytest.mark.parametrize(
    "match_object",
    [_core.match_object, reference.match_object, script],
    ids=["native", "reference", "baseline"],
)
def bench_match_object(benchmark: Any, match_object: Callable[..., Any]) -> None:
    """All choose the same object, which isn't the first."""
    assert benchmark(match_object, *ARGUMENTS) == reference.match_object(*ARGUMENTS) > 0
