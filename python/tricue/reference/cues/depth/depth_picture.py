# SPDX-License-Identifier: MIT
"""A gray picture of depth relative to the target's, in which a target looks the same at any distance."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

MIDDLE, CONTRAST = 128, 127  # gray level of the target's depth, and levels from there to black or white


def depth_picture(depth: NDArray[np.float32], z: float, reach: float) -> NDArray[np.uint8]:
    """Clips and scales the whole image at once."""
    if not np.isfinite(z):
        refuse("z", "a finite number", float(z))
    if not 0 < reach < np.inf:
        refuse("reach", "a finite number above 0", float(reach))
    inside = np.maximum(np.fmin(depth, np.float32(z + reach)), np.float32(z - reach))
    levels = (inside - np.float32(z)) * np.float32(CONTRAST / reach) + np.float32(MIDDLE)
    picture: NDArray[np.uint8] = levels.astype(np.uint8)
    return picture
