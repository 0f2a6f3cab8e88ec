# SPDX-License-Identifier: MIT
"""How much the flow of a small region stretches: native, reference, and a short NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Plane = NDArray[np.float32]
Scale = Callable[[Plane, Plane, float, int], tuple[float, float, int]]


def script(u: Plane, v: Plane, outliers: float, least: int) -> tuple[float, float, int]:
    """What a competent user would write: the mean taken off, a slope, and again."""
    y, x = np.indices(u.shape, dtype=np.float64)
    points = np.stack([x, y, x - u, y - v]).reshape(4, -1)
    points = points[:, np.isfinite(points).all(axis=0)]
    a = spread = np.nan
    for _ in range(2):
        count = points.shape[1]
        if count < least:
            return np.nan, np.nan, count
        centerd = points - points.mean(axis=1, keepdims=True)
        place, moved = centerd[:2], centerd[2:]
        a = np.vdot(place, moved) / np.vdot(place, place)
        squares = ((moved - a * place) ** 2).sum(axis=0)
        spread = squares.mean()
        points = points[:, squares <= outliers**2 * spread]
    return float(a), float(spread), count


IMPLEMENTATIONS = {"native": _core.flow_scale, "reference": reference.flow_scale, "baseline": script}


@pytest.mark.benchmark(group="flow_scale, 24x24")
@pytest.mark.parametrize("scale", IMPLEMENTATIONS.values(), ids=list(IMPLEMENTATIONS))
def bench_flow_scale(benchmark: Any, scale: Scale) -> None:
    """All find the same scale and spread by the same pixels."""
    rng = np.random.default_rng(0)
    y, x = np.indices((24, 24))
    u, v = ((0.03 * each + rng.normal(0, 0.1, x.shape)).astype(np.float32) for each in (x, y))
    u[4:9, 3:8] += 2
    u[rng.random(x.shape) < 0.1] = np.nan
    found = benchmark(scale, u, v, 2.5, 30)
    assert_allclose(found, script(u, v, 2.5, 30), rtol=1e-9)
    assert found[2] < np.isfinite(u).sum()
