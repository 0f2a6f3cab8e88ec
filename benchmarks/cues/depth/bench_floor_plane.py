# SPDX-License-Identifier: MIT
"""The floor of a depth image of 88x72 from 100 triples: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
UP = np.array([0.0, -1.0, 0.0])
TOLERANCE, LEAST_COSINE = 0.05, 0.8


def script(
    depth: Depth,
    camera: Floats,
    triples: NDArray[np.int64],
    tolerance: float,
    up: Floats,
    least_cosine: float,
) -> Floats:
    """The baseline: all planes at once, one product for all heights, then an SVD."""
    fx, fy, cx, cy = camera.astype(np.float32)
    v, u = np.indices(depth.shape, np.float32)
    points = np.dstack([(u - cx) / fx * depth, (v - cy) / fy * depth, depth]).reshape(-1, 3)
    p, q, r = points[triples].transpose(1, 0, 2)
    normals = np.cross(q - p, r - p)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    offsets = -np.sum(normals * p, axis=1)
    normals, offsets = normals * np.sign(offsets)[:, None], abs(offsets)
    level = normals @ up >= least_cosine
    normals, offsets, points = normals[level], offsets[level], points[depth.ravel() > 0]
    heights = points @ normals.T + offsets
    score = np.sum(abs(heights) <= tolerance, axis=0) - 3 * np.sum(heights < -3 * tolerance, axis=0)
    normal, d = normals[score.argmax()], offsets[score.argmax()]
    for _ in range(3):
        near = points[abs(points @ normal + d) <= tolerance]
        mean = near.mean(axis=0)
        normal = np.linalg.svd(near - mean, full_matrices=False)[2][2]
        normal *= -np.sign(normal @ mean)
        d = -normal @ mean
    height = points @ normal + d
    return np.array([*normal, d, np.mean(abs(height) <= tolerance), np.mean(height < -3 * tolerance)])


@pytest.mark.benchmark(group="floor_plane")
@pytest.mark.work(flops32=38 * 88 * 72, flops64=3 * 20 * 88 * 72 // 4, why="three fits, sums in one order")
@pytest.mark.parametrize(
    "floor_plane", [_core.floor_plane, reference.floor_plane, script], ids=["native", "reference", "baseline"]
)
def bench_floor_plane(benchmark: Any, floor_plane: Callable[..., Any], room: Depth, camera: Floats) -> None:
    """The twins find the same floor; the script, in float32, within a millimeter."""
    thin, lens = np.ascontiguousarray(room[::2, ::2]), camera / 2
    triples = np.random.default_rng(0).integers(0, thin.size, (100, 3))
    arguments = thin, lens, triples, TOLERANCE, UP, LEAST_COSINE
    plane = benchmark(floor_plane, *arguments)
    assert_allclose(plane[:4], [0, -1, 0, 1], atol=0.01)
    atol = 1e-3 if floor_plane is script else 1e-9
    assert_allclose(plane, reference.floor_plane(*arguments), atol=atol)
