# SPDX-License-Identifier: MIT
"""The mean color of every step-th pixel of an image."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def image_mean(image: NDArray[np.uint8], step: int) -> NDArray[np.float64]:
    """Averages a slice of the image."""
    if not 1 <= step <= 1024:
        refuse("step", "1 to 1024", step)
    colors = image[step // 2 :: step, step // 2 :: step]
    count = colors.shape[0] * colors.shape[1]
    return np.asarray(colors.sum(axis=(0, 1), dtype=np.int64) * (1 / count if count else 0.0))
