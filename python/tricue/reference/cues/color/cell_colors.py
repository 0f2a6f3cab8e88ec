# SPDX-License-Identifier: MIT
"""Every step-th pixel of an image, and their mean."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def cell_colors(image: NDArray[np.uint8], step: int) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """Slices."""
    if not 1 <= step <= 1024:
        refuse("step", "1 to 1024", step)
    colors = np.ascontiguousarray(image[step // 2 :: step, step // 2 :: step])
    count = colors.shape[0] * colors.shape[1]
    return colors, colors.sum(axis=(0, 1), dtype=np.int64) * (1 / count if count else 0.0)
