# SPDX-License-Identifier: MIT
"""Distances and contrasts of 100 rectangles in meters: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
LEVELS, PLACES, REACH, NEARER = 64, (14, 10, 1.3, 12), 0.5, 0.2


def read(depth: Depth, camera: Floats, states: Floats, u: Floats, v: Floats) -> Depth:
    """Depths minus Z at places (u, v), in half sizes; larger than the reach where nothing is measured."""
    half = states[:, None, 3:] / 2 * np.stack([u, v], axis=-1)
    places = (states[:, None, :2] + half) / states[:, None, 2:3] * camera[:2] + camera[2:]
    seen = cv2.remap(depth, places.astype(np.float32), None, cv2.INTER_NEAREST, borderValue=np.nan)
    return np.nan_to_num(seen - states[:, 2:3], nan=2 * REACH).astype(np.float32)


def script(
    depth: Depth,
    camera: Floats,
    states: Floats,
    model: tuple[Floats, float],
    places: tuple[int, int, float, int],
    occluder_margin: float,
) -> Floats:
    """The baseline: two remaps, which round where we take the floor, and calcHist of each rectangle."""
    (reference_histogram, reach), (rows, columns, margin, n) = model, places
    v, u = middles((rows, columns))
    along, off = (2 * np.arange(n) + 1) / n - 1, np.full(n, margin)
    inside = read(depth, camera, states, u, v)
    around = read(
        depth,
        camera,
        states,
        np.concatenate([-off, off, along, along]),
        np.concatenate([along, along, -off, off]),
    )
    measured = np.empty((len(states), 4))
    measured[:, 2] = (inside < -occluder_margin).mean(axis=1)
    measured[:, 3] = ((around >= -reach) & (around < reach)).mean(axis=1)
    for i, row in enumerate(inside):
        histogram = cv2.calcHist([row], [0], None, [len(reference_histogram)], [-reach, reach]).ravel()
        counted = histogram.sum()
        distance = np.linalg.norm(histogram / counted - reference_histogram) / np.sqrt(2) if counted else 1
        measured[i, :2] = distance, counted / len(row)
    return measured


def middles(grid: tuple[int, int]) -> tuple[Floats, Floats]:
    """v and u of a grid's places."""
    v, u = ((2 * np.arange(n) + 1) / n - 1 for n in grid)
    return np.repeat(v, grid[1]), np.tile(u, grid[0])


@pytest.mark.benchmark(group="depth_contrast")
@pytest.mark.work(lookups=100 * (140 + 48), counts=100 * 100)
@pytest.mark.parametrize(
    "depth_contrast",
    [_core.depth_contrast, reference.depth_contrast, script],
    ids=["native", "reference", "baseline"],
)
def bench_depth_contrast(benchmark: Any, depth_contrast: Callable[..., Any], camera: Floats) -> None:
    """The twins measure the same; remap rounds places to 1/32 pixel, so a few differ."""
    rng = np.random.default_rng(0)
    depth = np.full((144, 176), 5, np.float32)
    depth[30:, 60:110] = 2.5
    depth += rng.normal(0, 0.05, depth.shape).astype(np.float32)
    depth[rng.random(depth.shape) < 0.05] = np.nan
    states = rng.normal([-0.03, 0.58, 2.5, 0.65, 1.3], [0.1, 0.1, 0.1, 0.04, 0.08], (100, 5))
    model = np.histogram(rng.normal(0, 0.05, 5000), LEVELS, (-REACH, REACH))[0] / 5000
    arguments = (depth, camera, states, (model, REACH), PLACES, NEARER)
    measured = benchmark(depth_contrast, *arguments)
    expected = reference.depth_contrast(*arguments)
    assert np.median(expected[:, 1] - expected[:, 3]) > 0.3
    assert_allclose(
        measured, expected, **({"atol": 0.05} if depth_contrast is script else {"rtol": 100 * 2.0**-52})
    )
