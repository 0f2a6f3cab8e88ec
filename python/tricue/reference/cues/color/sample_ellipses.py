# SPDX-License-Identifier: MIT
"""The pixels under ellipses, read at corresponding places of every ellipse."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_finite, require_shape


def sample_ellipses(
    image: NDArray[np.uint8], ellipses: NDArray[np.float64], pattern: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """Reads all places of one ellipse at a time by indexing the image."""
    require_shape("ellipses", ellipses, (len(ellipses), 4))
    require_shape("pattern", pattern, (len(pattern), 2))
    height, width = image.shape[:2]
    if height < 1 or width < 1:
        refuse("image", "at least one pixel", "none")
    require_finite("ellipses", ellipses)
    require_finite("pattern", pattern)

    samples = np.empty((len(ellipses), 3, len(pattern)), np.uint8)
    with np.errstate(over="ignore"):
        u, v = pattern.astype(np.float32).T
        ellipses = ellipses.astype(np.float32)
    for i, (x, y, minor, major) in enumerate(ellipses):
        # What overflows float32 is read at the border, and NaN at 0.
        with np.errstate(invalid="ignore", over="ignore"):
            columns, rows = np.fmax(x + minor * u, 0), np.fmax(y + major * v, 0)
        samples[i] = image[np.fmin(rows, height - 1).astype(int), np.fmin(columns, width - 1).astype(int)].T
    return samples
