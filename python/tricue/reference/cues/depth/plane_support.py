# SPDX-License-Identifier: MIT
"""How much of a depth image lies on a known plane."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse
from tricue.reference.cues.depth.detail.plane_height import height_above


def plane_support(
    depth: NDArray[np.float32], camera: Floats, plane: Floats, tolerance: float, step: int
) -> Floats:
    """Compares height_above of every step-th pixel with the tolerance."""
    height = height_above(depth, camera, plane)
    if not 0 < tolerance < np.inf:
        refuse("tolerance", "a finite number above 0", float(tolerance))
    if step < 1:
        refuse("step", "at least 1", step)
    sampled = height[::step, ::step]
    measured = sampled[np.isfinite(depth[::step, ::step]) & (depth[::step, ::step] > 0)]
    if measured.size == 0:
        return np.zeros(2)
    within = np.abs(measured) <= np.float32(tolerance)
    below = measured < np.float32(-3 * tolerance)
    return np.array([np.count_nonzero(within), np.count_nonzero(below)]) / measured.size
