# SPDX-License-Identifier: MIT
"""A step of the color particle tracker's filter, 100 particles: native, reference, a cv2 and NumPy script."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid, ring

from benchmarks.cues.color import bench_rank_likelihood

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
N = 100


def script(
    image: Image,
    last: tuple[Floats, Floats, float],
    noise: tuple[Floats, float],
    dynamics: Any,
    bounds: Any,
    detection: Any,
    pattern: Any,
    appearance: Any,
    *others: Any,
) -> tuple[Any, ...]:
    """The baseline: the same equations in NumPy."""
    (particles, weights, offset), (white, correlation), (factors, flat) = last, noise, others
    drift, scale = map(np.array, dynamics)
    mean, root, share = np.array(detection[0]), detection[1], detection[2]
    root = np.array([[root[0], 0], root[1:]])
    look = pattern, appearance, factors
    particles = particles[np.searchsorted(np.cumsum(weights) / weights.sum(), (np.arange(N) + offset) / N)]
    white = white.copy()
    white[:, 3] = correlation * white[:, 2] + np.sqrt(1 - correlation**2) * white[:, 3]
    moved = particles + drift + scale * white
    drawn = np.diff(np.floor(np.arange(N + 1) * share)) > 0
    moved[drawn, :2] = mean + white[drawn, :2] @ root.T
    moved = np.clip(moved, *bounds)
    log_weights = bench_rank_likelihood.script(image, moved, *look)
    detected = (((moved[:, :2] - mean) @ np.linalg.inv(root).T) ** 2).sum(axis=1)
    expected = (((moved - particles - drift) / scale)[:, :2] ** 2).sum(axis=1)
    ratio = (expected - detected) / 2 + np.log(scale[:2].prod() / np.linalg.det(root))
    log_weights -= np.logaddexp(np.log(share) + ratio, np.log1p(-share))
    weights = np.exp(log_weights - log_weights.max())
    weights /= weights.sum()
    ellipse = weights @ moved
    its_own = bench_rank_likelihood.script(image, ellipse[None], *look)[0]
    window = reference.rank_window(image, ellipse, pattern[0], appearance[0], flat)
    return moved, weights, 1 / (weights**2).sum(), ellipse, its_own, *window


@pytest.mark.benchmark(group="rank_filter")
@pytest.mark.work(counts=(N + 1) * 3 * 96, lookups=2 * (N + 1) * (96 + 40))
@pytest.mark.parametrize(
    "rank_filter", [_core.rank_filter, reference.rank_filter, script], ids=["native", "reference", "baseline"]
)
def bench_rank_filter(benchmark: Any, rank_filter: Callable[..., Any], frame: Image) -> None:
    """The twins agree; the script rounds places to 1/32 pixel, which changes the estimate slightly."""
    rng = np.random.default_rng(0)
    particles = rng.normal([160, 120, 25, 31], [5, 5, 1, 1], (N, 4))
    maps, table = rng.random((2, 3, 96), np.float32), rng.random((16, 16, 16), np.float32)
    arguments = (
        frame,
        (particles, rng.random(N), 0.3),
        (rng.standard_normal((N, 4)), 0.96),
        ((1.0, 0.0, 0.0, 0.0), (3.0, 3.0, 0.5, 0.6)),
        ((0.0,) * 4, (320.0, 240.0, 90.0, 90.0)),
        ((162.0, 121.0), (9.0, 2.0, 8.0), 0.1),
        (grid(12, 8), ring(40, 1.3, 1.8)),
        (maps, np.array([0.6, 0.4]), False, table),
        (110.0, 8.0),
        0.1,
    )
    moved, _, _, ellipse, *_ = benchmark(rank_filter, *arguments)
    expected = reference.rank_filter(*arguments)
    assert_allclose(moved, expected[0], rtol=0, atol=1e-10)
    assert_allclose(ellipse, expected[3], rtol=0, atol=1.0 if rank_filter is script else 1e-9)
