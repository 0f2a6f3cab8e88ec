# SPDX-License-Identifier: MIT
"""The last depths that weren't the target's, 176x144: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
PERSON = (66, 10, 115, 125)


def script(depth: Depth, before: Depth, region: tuple[int, int, int, int], z: float, reach: float) -> Depth:
    """The baseline: a copy, changed only in the region."""
    x0, y0, x1, y1 = region
    seen = depth.copy()
    inside = seen[y0:y1, x0:x1]
    own = np.abs(inside - np.float32(z)) < reach
    inside[own] = before[y0:y1, x0:x1][own]
    return seen


@pytest.mark.benchmark(group="remember_depth")
@pytest.mark.work(bytes=12 * 176 * 144)
@pytest.mark.parametrize(
    "remember_depth",
    [_core.remember_depth, reference.remember_depth, script],
    ids=["native", "reference", "baseline"],
)
def bench_remember_depth(benchmark: Any, remember_depth: Callable[..., Any], room: Depth) -> None:
    """All remember the same."""
    before = np.full(room.shape, 5, np.float32)
    seen = benchmark(remember_depth, room, before, PERSON, 2.5, 0.5)
    assert_array_equal(seen, reference.remember_depth(room, before, PERSON, 2.5, 0.5))
    assert 1000 < np.count_nonzero(seen == 5) < room.size / 2
