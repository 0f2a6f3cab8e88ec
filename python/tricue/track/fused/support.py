# SPDX-License-Identifier: MIT
"""The plane that a target stands on, lies on or leans against: it is at its depth, but not the target."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.depth_sources import Grid

SUPPORT_TOLERANCE = 0.015  # of the target's depth, of a point on the plane
TRIALS = 64  # planes tried
DRAWS: Floats = np.random.default_rng(0).integers(2**32, size=(TRIALS, 3)) / 2**32  # the same for each frame


def find_support(
    k: Kernels, depth: Plane, grid: Grid, side: int, size: tuple[float, float], z: float, camera: Intrinsics
) -> NDArray[np.bool_]:
    """The pixels (side, side) of a target's surround, and of its box, that lie on one plane.

    depth: (H, W) meters, of which the target at depth z has a grid of squares around it. size: the target's
    width and height in squares.
    None of them if no plane holds enough of the target's surround, or if it holds the target itself.
    """
    on_plane = k.support_pixels(depth, *grid, side, *size, z, camera.vector, DRAWS, SUPPORT_TOLERANCE * z)
    return on_plane.view(np.bool_)
