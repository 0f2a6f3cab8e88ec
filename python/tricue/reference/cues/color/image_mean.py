# SPDX-License-Identifier: MIT
"""The mean color of an image."""

import numpy as np
from numpy.typing import NDArray


def image_mean(image: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Averages all pixels."""
    count = image.shape[0] * image.shape[1]
    return np.asarray(image.sum(axis=(0, 1), dtype=np.int64) * (1 / count if count else 0.0))
