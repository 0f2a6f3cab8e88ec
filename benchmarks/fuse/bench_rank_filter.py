# SPDX-License-Identifier: MIT
"""A step of the color particle tracker's filter, 100 particles: native, reference, a cv2 and NumPy script."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.track.base.ellipse_pattern import grid, ring

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
N = 100


def log_likelihoods(
    image: Image,
    ellipses: Floats,
    inside: Floats,
    around: Floats,
    maps: Singles,
    shares: Floats,
    table: Singles,
    sharpness: float,
    contrast_weight: float,
) -> Floats:
    """Log-likelihoods by remap, calcHist and an indexed table."""
    cells = (image >> 4).astype(np.int32)
    likely = table[cells[..., 0], cells[..., 1], cells[..., 2]]
    means = []
    for pattern in (inside, around):
        places = (ellipses[:, None, :2] + ellipses[:, None, 2:] * pattern - 0.5).astype(np.float32)
        means.append(cv2.remap(likely, places, None, cv2.INTER_NEAREST).mean(axis=1))
        if pattern is inside:
            samples = cv2.remap(image, places, None, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
    ranks = np.empty((3, len(inside)), np.float32)
    distance = np.empty(len(ellipses))
    for i, sampled in enumerate(samples):
        for k in range(3):
            levels = np.ascontiguousarray(sampled[:, k])
            counts = cv2.calcHist([levels], [0], None, [256], [0, 256]).ravel()
            ranks[k] = ((np.cumsum(counts) - counts / 2) / len(inside))[levels]
        distance[i] = shares @ (2 * np.abs(ranks - maps).mean(axis=(1, 2)))
    log_likelihood: Floats = contrast_weight * (means[0] - means[1]) - sharpness * distance**2
    return log_likelihood


def script(
    image: Image,
    particles: Floats,
    weights: Floats,
    offset: float,
    noise: Floats,
    correlation: float,
    *others: Any,
) -> tuple[Any, ...]:
    """The baseline: the same equations in NumPy."""
    *moves, root, share, inside, around, maps, shares, _, table, sharpness, contrast_weight, _ = others
    drift, scale, lower, upper, mean = map(np.array, moves)
    root = np.array([[root[0], 0], root[1:]])
    color = table, sharpness, contrast_weight
    particles = particles[np.searchsorted(np.cumsum(weights) / weights.sum(), (np.arange(N) + offset) / N)]
    noise = noise.copy()
    noise[:, 3] = correlation * noise[:, 2] + np.sqrt(1 - correlation**2) * noise[:, 3]
    moved = particles + drift + scale * noise
    drawn = np.diff(np.floor(np.arange(N + 1) * share)) > 0
    moved[drawn, :2] = mean + noise[drawn, :2] @ root.T
    moved = np.clip(moved, lower, upper)
    log_weights = log_likelihoods(image, moved, inside, around, maps, shares, *color)
    detected = (((moved[:, :2] - mean) @ np.linalg.inv(root).T) ** 2).sum(axis=1)
    expected = (((moved - particles - drift) / scale)[:, :2] ** 2).sum(axis=1)
    ratio = (expected - detected) / 2 + np.log(scale[:2].prod() / np.linalg.det(root))
    log_weights -= np.logaddexp(np.log(share) + ratio, np.log1p(-share))
    weights = np.exp(log_weights - log_weights.max())
    weights /= weights.sum()
    ellipse = weights @ moved
    its_own = log_likelihoods(image, ellipse[None], inside, around, maps, shares, *color)[0]
    window = reference.rank_window(image, ellipse, inside, maps, 0.1)
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
    moves = (1.0, 0.0, 0.0, 0.0), (3.0, 3.0, 0.5, 0.6), (0.0,) * 4, (320.0, 240.0, 90.0, 90.0)
    detection = (162.0, 121.0), (9.0, 2.0, 8.0), 0.1
    look = (grid(12, 8), ring(40, 1.3, 1.8), maps, np.array([0.6, 0.4]), False, table, 110.0, 8.0, 0.1)
    before = frame, particles, rng.random(N), 0.3, rng.standard_normal((N, 4)), 0.96
    arguments = (*before, *moves, *detection, *look)
    moved, _, _, ellipse, *_ = benchmark(rank_filter, *arguments)
    expected = reference.rank_filter(*arguments)
    assert_allclose(moved, expected[0], rtol=0, atol=1e-10)
    assert_allclose(ellipse, expected[3], rtol=0, atol=1.0 if rank_filter is script else 1e-9)
