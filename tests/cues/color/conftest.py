# SPDX-License-Identifier: MIT
"""Pictures and samples that the tests of the color cue share."""

import numpy as np
import pytest
from numpy.typing import NDArray

Image = NDArray[np.uint8]


def _smooth(height: int, width: int, seed: int) -> Image:
    """Colored patches of a few pixels' size, saturated here and there."""
    rng = np.random.default_rng(seed)
    coarse = rng.normal(128, 90, (height // 6 + 2, width // 6 + 2, 3))
    fine = coarse.repeat(6, axis=0).repeat(6, axis=1)[:height, :width]
    return (fine + rng.normal(0, 12, fine.shape)).clip(0, 255).astype(np.uint8)


PICTURES = {
    "patches": _smooth(57, 83, 0),
    "padded rows": _smooth(60, 200, 1)[3:50, 7:150],
    "one row": _smooth(1, 300, 2),
    "one column": _smooth(90, 1, 3),
    "one pixel": _smooth(1, 1, 4),
    "no rows": np.empty((0, 5, 3), np.uint8),
    "no columns": np.empty((5, 0, 3), np.uint8),
    "black": np.zeros((9, 65, 3), np.uint8),
    "saturated": np.full((9, 64, 3), 255, np.uint8),
    "wider than a tile": _smooth(5, 2100, 5),
    "higher than a tile": _smooth(1100, 4, 6),
}


@pytest.fixture(params=list(PICTURES), scope="session")
def picture(request: pytest.FixtureRequest) -> Image:
    """Pictures of awkward sizes: none, less than a vector, views with padded rows, more than a tile."""
    return PICTURES[request.param]


@pytest.fixture(params=[(1, 1), (3, 64), (2, 63), (5, 130), (100, 251), (0, 7)], ids=str, scope="session")
def samples(request: pytest.FixtureRequest) -> Image:
    """Samples (N, 3, n): a single one, a block of 64, one less, more, the usual size, no ellipse."""
    ellipses, n = request.param
    rng = np.random.default_rng(n)
    levels = rng.normal(rng.uniform(0, 255, (ellipses, 3, 1)), 50, (ellipses, 3, n))
    return levels.clip(0, 255).astype(np.uint8)


@pytest.fixture(params=[(60, 90, 160), (0, 0, 0), (255, 255, 255)], ids=str, scope="session")
def color(request: pytest.FixtureRequest) -> Image:
    """Reference colors: skin, black, white."""
    return np.array(request.param, np.uint8)
