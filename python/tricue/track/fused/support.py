# SPDX-License-Identifier: MIT
"""The support: a plane that the target stands on, lies on or leans against.

It is at the target's depth, so depth alone would take it for the target.
"""

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Plane
from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.fused.depth_sources import Grid

SUPPORT_TOLERANCE = 0.015  # largest distance of a point from the plane, as a share of the target's depth
TRIALS = 64  # planes that RANSAC tries
DRAWS: Floats = np.random.default_rng(0).integers(2**32, size=(TRIALS, 3)) / 2**32  # the same for each frame


def find_support(
    k: Kernels, depth: Plane, grid: Grid, side: int, size: tuple[float, float], z: float, camera: Intrinsics
) -> NDArray[np.bool_]:
    """The squares of a grid around a target that lie on the plane that supports it, (side, side).

    depth: (H, W) meters. size: the target's width and height in squares. z: the target's depth, meters.
    No square is on the plane if no plane has enough of the target's surround, or if it has the target, too.
    """
    squares, target, tolerance = (*grid, side, side), (*size, z), SUPPORT_TOLERANCE * z
    on_plane = k.support_pixels(depth, squares, target, camera.vector, DRAWS, tolerance)
    return on_plane.view(np.bool_)
