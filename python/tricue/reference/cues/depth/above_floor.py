# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.depth.detail.plane_height import height_above


def above_floor(
    depth: NDArray[np.float32],
    camera: NDArray[np.float64],
    plane: NDArray[np.float64],
    near: float,
    far: float,
    clear: float,
) -> NDArray[np.float32]:
    """Masks the depths by their range and by height_above."""
    height = height_above(depth, camera, plane)
    if not 0 <= near < np.inf:
        refuse("near", "a finite number, not negative", float(near))
    if not near < far < np.inf:
        refuse("far", "a finite number above near", float(far))
    if not np.isfinite(clear):
        refuse("clear", "a finite number", float(clear))
    above = height > np.float32(clear) if plane.any() else np.ones(depth.shape, np.bool_)
    inside = (depth > 0) & (depth >= np.float32(near)) & (depth < np.float32(far)) & above
    return np.where(inside, depth, np.float32(np.nan))
