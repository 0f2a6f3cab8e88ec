# SPDX-License-Identifier: MIT
"""The foreground of a depth image of 176x144: native, reference, and the native stages called one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
GAPS, FLOOR, SPACE = (0.06, 0.01, 0.06, 3), (0.04, 2), (0.3, 8.0, 0.12)
PLANE = np.array([0.0, -1.0, 0.0, 1.0])


def script(depth: Depth, step: int, _: Any, camera: Floats, plane: Floats, *__: Any) -> tuple[Any, ...]:
    """The baseline: a call for each stage, and NumPy for the margins."""
    filled = _core.fill_gaps(depth[::step, ::step], *GAPS)
    known = [np.flatnonzero((filled > 0).any(axis=axis)) for axis in (0, 1)]
    (left, right), (top, bottom) = ((int(each[0]), int(each[-1]) + 1) for each in known)
    kept = _core.above_floor(filled, camera, plane, *SPACE)
    return kept, _core.plane_support(filled, camera, plane, *FLOOR), (left, top, right, bottom)


@pytest.mark.benchmark(group="find_foreground")
@pytest.mark.work(bytes=8 * 176 * 144, why="three passes, and pixels are counted as bytes")
@pytest.mark.parametrize(
    "find_foreground",
    [_core.find_foreground, reference.find_foreground, script],
    ids=["native", "reference", "baseline"],
)
def bench_find_foreground(
    benchmark: Any, find_foreground: Callable[..., Any], room: Depth, camera: Floats
) -> None:
    """All find the same."""
    arguments = room, 1, GAPS, camera, PLANE, FLOOR, SPACE, 0.05
    found, expected = benchmark(find_foreground, *arguments), reference.find_foreground(*arguments)
    assert_array_equal(found[0], expected[0])
    assert_allclose(found[1], expected[1], rtol=1e-15)
    assert found[2] == expected[2]
