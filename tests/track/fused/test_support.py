# SPDX-License-Identifier: MIT
"""The plane that a target stands on, as the tracker asks the kernel support_pixels for it."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.support import DRAWS, SUPPORT_TOLERANCE, TRIALS, find_support

K = kernel_sets.load("native")
CAMERA = Intrinsics.from_fov(400, 300, 60)
SIDE = 64
GRID = (104.0, 54.0, 3.0)  # around the camera's middle
SIZE = (21.0, 21.0)
Z = 2.0
BOX = slice(22, 42)
BOX_PIXELS = slice(54 + 3 * 22, 54 + 3 * 42), slice(104 + 3 * 22, 104 + 3 * 42)


def before_a_wall(z: float) -> np.ndarray:
    """(300, 400) depths of a wall at Z, and of a target at z before it."""
    depth = np.full((300, 400), Z, np.float32)
    depth[BOX_PIXELS] = z
    return depth


def test_a_plane_around_a_target_is_found(kernels):
    """Every pixel of it but the target's, as a mask."""
    found = find_support(kernels, before_a_wall(Z - 0.1), GRID, SIDE, SIZE, Z, CAMERA)
    expected = np.ones((SIDE, SIDE), bool)
    expected[BOX, BOX] = False
    np.testing.assert_array_equal(found, expected, strict=True)


@pytest.mark.parametrize("share", [0.8, 1.2])
def test_near_the_plane_within_the_tolerance(share):
    """The tolerance is SUPPORT_TOLERANCE times the depth of the target, whatever that is."""
    for scale in (0.5, 1.0, 3.0):
        depth = before_a_wall(0.9 * Z)
        depth[54 + 3 * 5 + 1, 104 + 3 * 5 + 1] -= share * SUPPORT_TOLERANCE * Z
        found = find_support(K, np.float32(scale) * depth, GRID, SIDE, SIZE, scale * Z, CAMERA)
        assert found[5, 5] == (share < 1)


def test_draws_are_those_of_the_generator():
    """Of any number of pixels they take the same triples as NumPy's generator of seed 0 does."""
    for count in (60, 437, 1024):
        expected = np.random.default_rng(0).integers(count, size=(TRIALS, 3))
        np.testing.assert_array_equal((DRAWS * count).astype(int), expected)
