# SPDX-License-Identifier: MIT
"""Distances along the ground of what a tilted camera sees."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
LENS = np.array([190.0, 191.0, 31.5, 20.7])
NEAR, FAR = 0.4, 7.5


def upward(tilt: float, roll: float) -> Floats:
    """The direction up for a camera that looks down and is rolled by so many degrees."""
    down, side = np.radians([tilt, roll])
    return np.array([np.cos(down) * np.sin(side), -np.cos(down) * np.cos(side), -np.sin(down)])


@given(
    arrays(np.float32, st.tuples(st.integers(0, 12), st.integers(0, 140))),
    st.floats(-85, 85),
    st.floats(-180, 180),
)
def test_twin_measures_the_same(depth: Depth, tilt: float, roll: float) -> None:
    """Native and reference agree to the last bit for any depth and tilt."""
    arguments = depth, LENS, upward(tilt, roll), NEAR, FAR
    with np.errstate(over="ignore", invalid="ignore"):
        twin = reference.ground_distance(*arguments)
    assert_array_equal(_core.ground_distance(*arguments), twin, strict=True)


def test_twin_measures_the_same_in_pictures(picture: Depth, camera: Floats, floor: Floats) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    arguments = picture, camera, floor[:3].copy(), NEAR, FAR
    assert_array_equal(_core.ground_distance(*arguments), reference.ground_distance(*arguments), strict=True)


@pytest.mark.parametrize(
    ("tilt", "roll"), [(0.0, 0.0), (25.0, 0.0), (-40.0, 10.0), (70.0, -30.0), (89.999, 15.0)]
)
def test_is_the_distance_of_points(kernels: Kernels, tilt: float, roll: float) -> None:
    """It is the product of the points, by the inverse of the camera's matrix, with the view's direction along
    the ground of a camera that isn't rolled, by SciPy's rotation about the view.
    """
    fx, fy, cx, cy = LENS
    inverse = np.linalg.inv([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    depth = np.random.default_rng(0).uniform(1, 4, (40, 60)).astype(np.float32)
    v, u = np.indices(depth.shape)
    points = np.stack([u, v, np.ones(u.shape)], axis=-1) @ inverse.T * depth[..., None]
    down = np.radians(tilt)
    ahead = Rotation.from_euler("z", roll, degrees=True).apply([0.0, -np.sin(down), np.cos(down)])
    found = kernels.ground_distance(depth, LENS, upward(tilt, roll), -100.0, 100.0)
    assert_allclose(found, points @ ahead, rtol=0, atol=4 * 3 * np.finfo(np.float32).eps)


@pytest.mark.parametrize("tilt", [80.0, -89.9, 89.999])
@pytest.mark.parametrize("length", [1 - 9e-7, 1 + 9e-7])
def test_looks_nearly_straight_down(kernels: Kernels, tilt: float, length: float) -> None:
    """The length of up, within its tolerance, changes nothing, as only the direction counts."""
    depth = np.full((40, 60), 2, np.float32)
    up = upward(tilt, 20.0)
    expected = kernels.ground_distance(depth, LENS, up, -100.0, 100.0)
    found = kernels.ground_distance(depth, LENS, up * length, -100.0, 100.0)
    assert_allclose(found, expected, rtol=0, atol=4 * np.finfo(np.float32).eps)


def test_a_level_camera_changes_nothing(kernels: Kernels) -> None:
    """Its depths are the distances; NaN stays, and all else is brought within the limits, far excluded."""
    depth = np.array([[1.0, 3.3, np.nan, 0.1, -2.0, 7.5, 99.0, np.inf]], np.float32)
    found = kernels.ground_distance(depth, LENS, np.array([0.0, -1.0, 0.0]), NEAR, FAR)
    below = np.nextafter(np.float32(FAR), np.float32(0))
    assert_array_equal(found, np.array([[1.0, 3.3, np.nan, NEAR, NEAR, below, below, below]], np.float32))


BAD: list[tuple[dict[str, Any], str]] = [
    ({"camera": np.array([0.0, 1, 1, 1])}, "camera: expected focal lengths above 0, got 0"),
    ({"up": np.zeros(2)}, r"up: expected "),
    ({"up": np.array([0.0, -1.1, 0.0])}, "up: expected a vector of length 1, got 1.1"),
    ({"up": np.array([0.0, np.nan, 0.0])}, "up: expected finite numbers, got nan"),
    ({"up": np.array([0.0, 0.0, 1.0])}, "up: expected a direction across the view, got one along it"),
    ({"near": np.nan}, "near: expected a finite number, got nan"),
    ({"far": NEAR}, "far: expected a finite number above near, got 0.4"),
    ({"far": np.inf}, "far: expected a finite number above near, got inf"),
]
GOOD = {
    "depth": np.ones((4, 5), np.float32),
    "camera": LENS,
    "up": np.array([0.0, -1.0, 0.0]),
    "near": NEAR,
    "far": FAR,
}


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Numbers out of range are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.ground_distance(**GOOD | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.ground_distance(**GOOD | {"depth": np.ones((4, 5))})
