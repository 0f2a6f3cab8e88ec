# SPDX-License-Identifier: MIT
"""Eight objects of a depth image in meters: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
Shares = NDArray[np.float32]
random = np.random.default_rng(0)
DEPTH, SIZE = random.uniform(2, 6, 8), random.integers(8, 60, (8, 2))
LOW = (2 - 0.28 * DEPTH) / 0.96 - random.uniform(0, 0.5, 8)  # meters: lower edges near the floor
OBJECTS = (
    np.column_stack(
        [
            random.integers(0, 120, 8),
            LOW * 190 / DEPTH + 71 - SIZE[:, 1],
            SIZE,
            random.integers(60, 2000, 8),
            DEPTH,
            np.ones(8),
        ]
    ),
    random.dirichlet(np.ones(16), 8).astype(np.float32),
    random.dirichlet(np.ones(16), 8).astype(np.float32),
    random.random((8, 4)) < 0.2,
)
CAMERA, FEET = np.array([190.0, 190.0, 87.5, 70.5]), 0.35
ARGUMENTS = OBJECTS, CAMERA, (np.array([0.0, -0.96, -0.28, 2.0]), FEET)


def script(
    objects: tuple[Floats, Shares, Shares, NDArray[np.bool_]], camera: Floats, ground: tuple[Floats, float]
) -> Floats:
    """The baseline: the same by way of corners; arguments aren't checked."""
    (table, columns, rows, cut), (plane, feet) = objects, ground
    z = table[:, 5]
    scale = z[:, None] / camera[:2]
    low = (table[:, :2] - 0.5 - camera[2:]) * scale
    size = table[:, 2:4] * scale
    middles = (np.arange(columns.shape[1]) + 0.5) / columns.shape[1] - 0.5
    centroid = low + size / 2 + np.column_stack([columns @ middles, rows @ middles]) * size
    bottom = low[:, 1] + size[:, 1]
    foot = np.column_stack([low[:, 0] + size[:, 0] / 2, bottom, z])
    up = plane[:3]
    ahead = np.array([0.0, 0.0, 1.0]) - up[2] * up
    upright = foot * ((foot - np.outer(size[:, 1] / 2, [0, 1, 0])) @ ahead / (foot @ ahead))[:, None]
    above = upright @ up + plane[3]
    stand = upright - np.outer(above, up)
    reach = np.maximum(stand[:, 1] * z / stand[:, 2] - bottom, 0)
    strip = np.where((above > 0) & (above < feet) & ~cut[:, 3], reach, 0)
    y = low[:, 1:] + np.outer(size[:, 1], middles + 0.5)
    weights = rows / (
        low[:, :1] * ahead[0] + size[:, :1] / 2 * ahead[0] + y * ahead[1] + z[:, None] * ahead[2]
    )
    feet_y = bottom + strip / 2
    feet_weight = 1 / ((low[:, 0] + size[:, 0] / 2) * ahead[0] + feet_y * ahead[1] + z * ahead[2])
    size[:, 1] += strip
    share = strip / size[:, 1]
    below = (1 - share) * (weights * y).sum(axis=1) + share * feet_weight * feet_y
    centroid[:, 1] = below / weights.sum(axis=1)
    center = low + size / 2
    return np.column_stack([center, z, size, centroid - center, table[:, 4] * scale.prod(axis=1)])


@pytest.mark.benchmark(group="measure_objects")
@pytest.mark.work(flops64=8 * 250, why="the call takes a third")
@pytest.mark.parametrize(
    "measure_objects",
    [_core.measure_objects, reference.measure_objects, script],
    ids=["native", "reference", "baseline"],
)
def bench_measure_objects(benchmark: Any, measure_objects: Callable[..., Any]) -> None:
    """All measure the same, within the rounding of lengths below 8 m; some objects stand on the floor."""
    measured = benchmark(measure_objects, *ARGUMENTS)
    assert_allclose(measured, reference.measure_objects(*ARGUMENTS), rtol=1e-12, atol=1e-13)
    without = reference.measure_objects(OBJECTS, CAMERA, (np.zeros(4), FEET))
    assert 0 < np.count_nonzero(measured[:, 4] - without[:, 4] > 0.01) < 8
