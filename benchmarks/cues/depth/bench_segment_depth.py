# SPDX-License-Identifier: MIT
"""The objects of a depth image of 176x144: native, reference, and the native stages called one by one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
NEAR, FAR, LEVELS = 0.3, 8.0, 256
EDGES, DENSITY, CUT = (0.06, 0.01), (4.0, 0.05), (2, 0.08, 0.3, 0.15)
PLANE, FEET, MEASURED = np.array([0.0, -1.0, 0.0, 1.0]), 0.35, (0, 0, 176, 144)


def script(
    depth: Depth,
    searched: tuple[Any, Depth, float, float],
    camera: Floats,
    ground: tuple[Floats, float],
    *__: Any,
) -> tuple[Floats, NDArray[np.bool_], Depth, Depth]:
    """The baseline: a call for each stage, and NumPy between them."""
    (_, before, *noise), (plane, _) = searched, ground
    distance = _core.ground_distance(depth, camera, plane[:3], NEAR, FAR)
    mask = (_core.depth_edges(distance, *EDGES) ^ np.uint8(1)) & _core.changed_depth(depth, before, *noise)
    density = _core.depth_density(_core.depth_histogram(distance, mask, NEAR, FAR, LEVELS), DENSITY[0])
    _, minima = _core.density_extrema(density, DENSITY[1] * float(density.max()))
    dividers = np.array([NEAR, *(NEAR + (minima + 0.5) * ((FAR - NEAR) / LEVELS)), FAR])
    labels = _core.divide_depth(distance, mask, dividers)
    table, _, columns, rows, _ = _core.depth_components(labels, depth, NEAR, FAR, 0, 16, 8, False)
    cut = _core.cut_sides(depth, table, camera, CUT)
    return _core.measure_objects((table, columns, rows, cut), camera, ground), cut, columns, rows


@pytest.mark.benchmark(group="segment_depth")
@pytest.mark.work(flops32=19 * 176 * 144, counts=176 * 144 * 4 // 3, why="runs are joined one by one")
@pytest.mark.parametrize(
    "segment_depth",
    [_core.segment_depth, reference.segment_depth, script],
    ids=["native", "reference", "baseline"],
)
def bench_segment_depth(
    benchmark: Any, segment_depth: Callable[..., Any], room: Depth, camera: Floats
) -> None:
    """All find the same objects."""
    above = _core.above_floor(room, camera, PLANE, NEAR, FAR, 0.12)
    before = np.full_like(room, np.nan)
    searched, divisions = (MEASURED, before, 0.02, 0.005), ((NEAR, FAR, LEVELS), *EDGES, *DENSITY, 8)
    arguments = above, searched, camera, (PLANE, FEET), MEASURED, divisions, CUT
    found, expected = benchmark(segment_depth, *arguments), reference.segment_depth(*arguments)
    assert_allclose(found[0], expected[0], rtol=1e-9, atol=1e-9)
    for one, other in zip(found[1:], expected[1:], strict=True):
        assert_array_equal(one, other)
    assert len(found[0]) > 1
