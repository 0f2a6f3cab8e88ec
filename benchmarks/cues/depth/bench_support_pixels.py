# SPDX-License-Identifier: MIT
"""The plane around a target, 64x64 places of a room of 176x144: native, reference, and a script on NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
Mask = NDArray[np.uint8]


def script(
    depth: Depth, grid: Any, box: tuple[float, float, float], camera: Floats, draws: Floats, tolerance: float
) -> Mask:
    """The baseline, for a grid of 64x64: NumPy on all triples at once, and an SVD."""
    (x0, y0, step, side, _), (width, height, z) = grid, box
    squares = np.arange(side)
    x, y = (np.floor(start + (squares + 0.5) * step).astype(int) for start in (x0, y0))
    z_of = depth[np.ix_(y.clip(0, depth.shape[0] - 1), x.clip(0, depth.shape[1] - 1))]
    z_of = np.where(z_of < 2 * z, z_of, np.nan)
    rays = [
        (start + squares * step - c) / f
        for start, c, f in ((x0, camera[2], camera[0]), (y0, camera[3], camera[1]))
    ]
    points = np.dstack([rays[0] * z_of, rays[1][:, None] * z_of, z_of])
    offset = np.abs(squares + 0.5 - side / 2)
    target = (offset[:, None] < 1.05 * height / 2) & (offset < 1.05 * width / 2)
    votes = np.where(target[:, :, None], np.nan, points)[::2, ::2].reshape(-1, 3)
    votes = votes[np.isfinite(votes[:, 2])]
    p, q, r = votes[(draws * len(votes)).astype(int)].transpose(1, 0, 2)
    normals = np.cross(q - p, r - p)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]  # a pixel may be drawn twice
    offsets = -np.sum(normals * p, axis=1)
    heights = votes @ normals.T + offsets
    heights *= np.sign(offsets)
    best = np.argmax(np.sum(abs(heights) <= tolerance, axis=0) - 3 * np.sum(heights < -3 * tolerance, axis=0))
    normal, d = normals[best], offsets[best]
    for _ in range(3):
        near = votes[abs(votes @ normal + d) <= tolerance]
        normal = np.linalg.svd(near - near.mean(axis=0), full_matrices=False)[2][2]
        d = -normal @ near.mean(axis=0)
    return np.asarray(abs(points @ normal + d) < tolerance, np.uint8)


@pytest.mark.benchmark(group="support_pixels, 64x64")
@pytest.mark.work(lookups=64 * 64, flops32=6 * 64 * 64 + 36 * 32 * 32, why="three fits, sums in one order")
@pytest.mark.parametrize(
    "find", [_core.support_pixels, reference.support_pixels, script], ids=["native", "reference", "baseline"]
)
def bench_support_pixels(benchmark: Any, find: Callable[..., Mask], camera: Floats) -> None:
    """All find the same table under an object, with noise of 2 mm, except for a few pixels."""
    rng = np.random.default_rng(0)
    below = 1 + 0.3 * (np.arange(144)[:, None] - 72) / 102
    table = np.repeat(2.0 / below, 176, axis=1) + rng.normal(0, 0.002, (144, 176))
    table[52:92, 75:105] = 1.7
    depth = table.astype(np.float32)
    arguments = depth, (37.0, 21.0, 1.6, 64, 64), (20.0, 26.0, 1.7), camera, rng.random((64, 3)), 0.02
    found, expected = benchmark(find, *arguments), reference.support_pixels(*arguments)
    assert np.mean(found != expected) < 0.01
    assert 0.5 < expected.mean() < 0.95
