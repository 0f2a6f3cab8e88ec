# SPDX-License-Identifier: MIT
"""The input of searches for a head: the bins of a region, and the ellipse in its middle."""

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core


@pytest.fixture(scope="session")
def region_bins(frame: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """60x56 pixels over 32 x 32 x 4 bins: room for an ellipse of 30x36, its ring, and 16x4 places of it."""
    return _core.color_bins(frame, (100, 80, 160, 136), ((32, 32, 4), 64), 1)


@pytest.fixture(scope="session")
def ellipse() -> NDArray[np.float64]:
    """30 pixels wide, 36 high."""
    return np.array([30.3, 27.8, 15.0, 18.0])


@pytest.fixture(scope="session")
def model(region_bins: NDArray[np.uint16], ellipse: NDArray[np.float64]) -> NDArray[np.float64]:
    """(4096,) the number of pixels of each bin in the ellipse."""
    y, x = np.mgrid[: region_bins.shape[0], : region_bins.shape[1]] + 0.5
    x0, y0, minor, major = ellipse
    inside = ((x - x0) / minor) ** 2 + ((y - y0) / major) ** 2 <= 1
    return np.bincount(region_bins[inside], minlength=4096).astype(np.float64)
