# SPDX-License-Identifier: MIT
"""Height above a plane."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
ONE = np.ones((1, 1), np.float32)
LENS, LEVEL = np.array([1.0, 1.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0, 1.5])
# Heights of points up to 8 m away and 20 m aside: about ten roundings of numbers below 32 m.
ROUNDING = 10 * 32 * float(np.finfo(np.float32).eps)

depths = arrays(np.float32, st.tuples(st.integers(0, 3), st.integers(0, 70)))
planes = arrays(np.float64, 4, elements=st.floats(-10, 10))


@given(depths, planes)
def test_twin_measures_the_same(depth: Depth, plane: Floats) -> None:
    """Native and reference agree to the last bit for any depth: both compute in float32, in one order."""
    lens = np.array([150.0, 151.0, 31.5, 0.7])
    assert_array_equal(
        _core.height_above(depth, lens, plane), reference.height_above(depth, lens, plane), strict=True
    )


def test_twin_measures_the_same_in_pictures(picture: Depth, camera: Floats, floor: Floats) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    native = _core.height_above(picture, camera, floor)
    assert_array_equal(native, reference.height_above(picture, camera, floor), strict=True)


def test_agrees_with_points(kernels: Kernels, noisy_room: Depth, camera: Floats, floor: Floats) -> None:
    """Points made by the inverse of the camera's matrix have the same heights, in float64."""
    fx, fy, cx, cy = camera
    inverse = np.linalg.inv([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    v, u = np.mgrid[:144, :176]
    points = np.stack([u, v, np.ones(u.shape)], axis=-1) @ inverse.T * noisy_room[:, :, None]
    height = kernels.height_above(noisy_room, camera, floor)
    assert_allclose(height, points @ floor[:3] + floor[3], rtol=0, atol=ROUNDING)


def test_room(kernels: Kernels, room: Depth, surfaces: Floats, camera: Floats, floor: Floats) -> None:
    """In the room the floor is 0 high, the person's top 1.75 m but for a pixel, and nothing is below."""
    height = kernels.height_above(room, camera, floor)
    nearest = surfaces.argmin(axis=0)
    assert_allclose(height[nearest == 0], 0, atol=ROUNDING)
    assert height.min() > -ROUNDING
    pixel = 2.5 / camera[1] * 1.1  # a pixel's height at the person's distance, who isn't quite on the axis
    assert 1.75 - pixel < height[nearest == 2].max() < 1.75 + ROUNDING


def test_example_by_hand(kernels: Kernels) -> None:
    """Down at 45 degrees from 1.5 m: what is 2 m ahead is 0.5 m below the floor, 0.5 m ahead 1 m above."""
    depth = np.array([[2, np.nan], [2, 0.5]], np.float32)
    assert_array_equal(kernels.height_above(depth, LENS, LEVEL), np.float32([[1.5, np.nan], [-0.5, 1.0]]))


@pytest.mark.parametrize("strange", [np.nan, 0, -0.0, -2, np.inf, -np.inf])
def test_nothing_measured_is_nan(kernels: Kernels, strange: float) -> None:
    """What isn't above 0 and finite has no height."""
    assert np.isnan(kernels.height_above(ONE * np.float32(strange), LENS, LEVEL)).all()


@pytest.mark.parametrize(
    ("lens", "plane", "message"),
    [
        (LENS[:3], LEVEL, r"camera: expected shape \(4,\), got \(3,\)"),
        (LENS * np.nan, LEVEL, "camera: expected finite numbers, got nan"),
        (LENS * [0, 1, 1, 1], LEVEL, "camera: expected focal lengths above 0, got 0"),
        (LENS * [1, -2, 1, 1], LEVEL, "camera: expected focal lengths above 0, got -2"),
        (LENS, LEVEL[:3], r"plane: expected shape \(4,\), got \(3,\)"),
        (LENS, LEVEL + np.inf, "plane: expected finite numbers, got inf"),
    ],
)
def test_refuses_other_cameras_and_planes(
    kernels: Kernels, lens: Floats, plane: Floats, message: str
) -> None:
    """What is no camera or no plane is named."""
    with pytest.raises(ValueError, match=message):
        kernels.height_above(ONE, lens, plane)


BAD: list[tuple[Any, type[Exception], str]] = [
    (ONE.astype(float), TypeError, r"depth: expected a float32 depth image \(H, W\), got float64"),
    (np.zeros((2, 2), np.uint16), TypeError, r"depth: expected a float32 depth image \(H, W\), got uint16"),
    (
        np.zeros(3, np.float32),
        ValueError,
        r"depth: expected a float32 depth image \(H, W\), got float32 \(3,",
    ),
    (np.zeros((3, 8), np.float32)[:, ::2], ValueError, "depth: expected packed pixels"),
    (np.zeros((3, 8), np.float32)[::-1], ValueError, "depth: expected packed pixels"),
    (np.zeros((3, 8), np.float32).T, ValueError, "depth: expected packed pixels"),
    (np.zeros(33, np.uint8)[1:].view(np.float32).reshape(2, 4), ValueError, "depth: expected packed pixels"),
    (None, TypeError, "depth: expected a NumPy array, a float32 depth image"),
]


@pytest.mark.parametrize(("depth", "error", "message"), BAD)
def test_native_refuses_other_pictures(depth: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.height_above(depth, LENS, LEVEL)
