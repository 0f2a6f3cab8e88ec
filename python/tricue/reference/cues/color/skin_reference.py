# SPDX-License-Identifier: MIT
"""The reference color of a skin patch, its most frequent one (Sabeti, Parvizi, Wu 2008, equation (3))."""

import numpy as np
from numpy.typing import NDArray


def skin_reference(patch: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Averages the pixels in the largest bin of the joint histogram."""
    if patch.size == 0:
        raise ValueError("patch: expected at least one pixel, got none")
    pixels = patch.reshape(-1, 3).astype(np.int64)
    blue, green, red = (pixels // 8).T
    cells = (blue * 32 + green) * 32 + red
    mode = np.argmax(np.bincount(cells))  # the first of equals
    mean: NDArray[np.float64] = pixels[cells == mode].mean(axis=0)
    return np.floor(mean + 0.5).astype(np.uint8)
