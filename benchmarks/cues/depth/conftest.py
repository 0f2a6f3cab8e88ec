# SPDX-License-Identifier: MIT
"""A room in a depth camera of 176x144 pixels, made before any clock starts."""

import numpy as np
import pytest
from numpy.typing import NDArray


@pytest.fixture(scope="session")
def camera() -> NDArray[np.float64]:
    """fx, fy, cx, cy: a field of view of about 50 by 41 degrees, with the horizon above the middle."""
    return np.array([190.0, 190.0, 87.5, 40.5])


@pytest.fixture(scope="session")
def room(camera: NDArray[np.float64]) -> NDArray[np.float32]:
    """A floor 1 m below the camera, a wall at 5 m, a person at 2.5 m; noise of 1 cm, 5 % not measured."""
    rng = np.random.default_rng(0)
    v, u = np.mgrid[:144, :176]
    below = np.maximum(v - camera[3], 0.5) / camera[1]
    depth = np.minimum(1 / below, 5.0)
    depth[(abs(u - 90) < 20) & (v > 15) & (below < 0.4)] = 2.5
    depth += rng.normal(0, 0.01, depth.shape)
    depth[rng.random(depth.shape) < 0.05] = np.nan
    return depth.astype(np.float32)
