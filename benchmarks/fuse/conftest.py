# SPDX-License-Identifier: MIT
"""Flow and disparity around a target, as the flow-depth tracker gets them, made before any clock starts."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import reference

Plane = NDArray[np.float32]
Rectangle = tuple[float, float, float, float]

RANGES = [(-4.0, 4.0), (-4.0, 4.0), (0.0, 16.0)]
BINS = 64


@dataclass(frozen=True)
class Target:
    """A target's planes u, v, d (H, W), with their weights, densities and the target's place."""

    planes: list[Plane]
    weights: list[Plane]
    densities: list[NDArray[np.float64]]
    window: Rectangle
    candidate: Rectangle
    mask: NDArray[np.uint8]


def target(width: int, height: int) -> Target:
    """A target of a quarter of the width and half of the height, in front of a background that moves
    differently; a third of the values is missing.
    """
    rng = np.random.default_rng(0)
    x0, y0, x1, y1 = width * 3 // 8, height // 4, width * 5 // 8, height * 3 // 4
    window = (float(x0), float(y0), float(x1), float(y1))
    candidate = (x0 - width / 16, y0 - height / 16, x1 + width / 16, y1 + height / 16)
    inside = np.zeros((height, width), np.bool_)
    inside[y0:y1, x0:x1] = True
    planes, weights, densities = [], [], []
    for (low, high), (near, far) in zip(RANGES, [(1.5, -0.4), (0.2, 0.0), (8.0, 3.0)], strict=True):
        plane = np.where(inside, near, far) + rng.normal(0, 0.3, inside.shape)
        plane[rng.random(plane.shape) < 1 / 3] = np.nan
        planes.append(plane.astype(np.float32))
        weights.append(rng.random(plane.shape).astype(np.float32))
        histogram = reference.weighted_histogram(planes[-1], weights[-1], window, low, high, BINS)
        densities.append(reference.target_distribution(histogram, 1.5)[0])
    mask, _ = reference.target_pixels(planes, densities, RANGES, window, candidate)
    return Target(planes, weights, densities, window, candidate, mask)


@pytest.fixture(scope="session")
def small() -> Target:
    """160x120, as in the paper."""
    return target(160, 120)


@pytest.fixture(scope="session")
def large() -> Target:
    """640x480."""
    return target(640, 480)
