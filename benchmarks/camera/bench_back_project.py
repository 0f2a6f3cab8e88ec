# SPDX-License-Identifier: MIT
"""500 points and their covariances: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Floats = NDArray[np.float64]
MEASUREMENTS = np.random.default_rng(0).uniform([0, 0, 2], [640, 480, 60], (500, 3))
VARIANCES = np.array([0.3, 0.3, 0.25]) ** 2
CAMERA, BASELINE = np.array([560.0, 560.0, 319.5, 239.5]), 0.12


def script(measurements: Floats, variances: Floats, camera: Floats, baseline: float) -> tuple[Floats, Floats]:
    """The baseline: all Jacobians at once."""
    fx, fy, cx, cy = camera
    u, v, d = measurements.T
    z = fx * baseline / d
    points = np.stack([(u - cx) * z / fx, (v - cy) * z / fy, z], axis=1)
    jacobians = np.zeros((len(d), 3, 3))
    jacobians[:, 0, 0], jacobians[:, 1, 1] = z / fx, z / fy
    jacobians[:, :, 2] = -points / d[:, None]
    return points, (jacobians * variances) @ jacobians.transpose(0, 2, 1)


IMPLEMENTATIONS = {"native": _core.back_project, "reference": reference.back_project, "baseline": script}


@pytest.mark.benchmark(group="back_project")
@pytest.mark.work(flops64=60 * 500, divs64=500, why="matrices of 3x3, point by point")
@pytest.mark.parametrize("back_project", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_back_project(benchmark: Any, back_project: Callable[..., tuple[Floats, Floats]]) -> None:
    """All compute the same points and covariances."""
    arguments = MEASUREMENTS, VARIANCES, CAMERA, BASELINE
    for ours, theirs in zip(benchmark(back_project, *arguments), script(*arguments), strict=True):
        assert_allclose(ours, theirs, rtol=1e-10, atol=1e-14)
