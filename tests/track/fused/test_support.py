# SPDX-License-Identifier: MIT
"""The plane that a target stands on, in depths whose planes are known."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.support import MAX_SUPPORT_DEPTH, SUPPORT_TOLERANCE, find_support

K = kernel_sets.load("native")
CAMERA = Intrinsics.from_fov(400, 300, 60)
SIDE, STEP = 64, 3.0
GRID = (104.0, 54.0, STEP)  # around the camera's middle
SIZE = (21.0, 21.0)
Z = 2.0
BOX = slice(22, 42)
RNG = np.random.default_rng(0)


def slanted(below: float = 0.0, across: float = 0.0, z: float = Z) -> np.ndarray:
    """(64, 64) depths of a plane, z in the middle; below, across: change of its inverse, of 1/z per side."""
    offset = (np.arange(SIDE) + 0.5) / SIDE - 0.5
    return (z / (1 + below * offset[:, None] + across * offset)).astype(np.float32)


@pytest.mark.parametrize("slant", [(0.4, 0.0), (-0.3, 0.2), (0.0, 0.5), (0.0, 0.0)], ids=str)
def test_a_plane_around_a_target_is_found(slant, kernels):
    """Every pixel of a slanted plane with noise of 3 mm, and no pixel of the target 10 cm before it."""
    depths = slanted(*slant) + RNG.normal(0, 0.003, (SIDE, SIDE)).astype(np.float32)
    depths[BOX, BOX] = depths[BOX, BOX] - 0.1
    found = find_support(kernels, depths, GRID, SIZE, Z, CAMERA)
    outside = np.ones((SIDE, SIDE), bool)
    outside[BOX, BOX] = False
    assert found[outside].mean() > 0.99
    assert found[BOX, BOX].mean() < 0.01


def test_a_target_as_flat_as_the_plane_is_kept():
    """None where the target is the plane: a book on a table, or a poster."""
    assert find_support(K, slanted(0.4), GRID, SIZE, Z, CAMERA) is None


def test_no_plane_no_support():
    """None among scattered depths, far away, without any measurement or with a few."""
    scattered = RNG.uniform(1, 3, (SIDE, SIDE)).astype(np.float32)
    assert find_support(K, scattered, GRID, SIZE, Z, CAMERA) is None
    wall = slanted(0.2, z=1.5 * MAX_SUPPORT_DEPTH * Z)
    wall[BOX, BOX] = Z
    assert find_support(K, wall, GRID, SIZE, Z, CAMERA) is None
    nothing = np.full((SIDE, SIDE), np.nan, np.float32)
    assert find_support(K, nothing, GRID, SIZE, Z, CAMERA) is None
    nothing[:4, :4] = Z
    assert find_support(K, nothing, GRID, SIZE, Z, CAMERA) is None


def test_what_is_not_measured_is_not_on_it():
    """A fifth of the pixels without a measurement, and infinite ones, aren't the plane's."""
    depths = slanted(0.3)
    depths[BOX, BOX] = 0.9 * Z
    holes = RNG.random((SIDE, SIDE)) < 0.2
    depths[holes] = np.where(RNG.random(holes.sum()) < 0.5, np.nan, np.inf)
    found = find_support(K, depths, GRID, SIZE, Z, CAMERA)
    assert not found[holes].any()
    assert found[:20][~holes[:20]].mean() > 0.99


@pytest.mark.parametrize("size", [(0.1, 60.0), (60.0, 0.1), (21.0, 21.0)], ids=str)
def test_targets_of_any_shape(size):
    """Also of a target that is thinner than a pixel."""
    depths = slanted(0.4)
    rows, columns = (slice(32 - round(length / 2) - 1, 33 + round(length / 2)) for length in size[::-1])
    depths[rows, columns] = 0.8 * Z
    found = find_support(K, depths, GRID, size, Z, CAMERA)
    assert found is not None
    assert not found[rows, columns].any()


def test_near_the_plane_within_the_tolerance():
    """Pixels so near the plane as SUPPORT_TOLERANCE are the plane's, those twice as far aren't."""
    depths = slanted()
    depths[BOX, BOX] = Z - 0.2
    depths[5, 5], depths[5, 7] = Z - 0.8 * SUPPORT_TOLERANCE * Z, Z - 2 * SUPPORT_TOLERANCE * Z
    found = find_support(K, depths, GRID, SIZE, Z, CAMERA)
    assert found[5, 5]
    assert not found[5, 7]
