# SPDX-License-Identifier: MIT
"""The part of a depth image in which a target can be."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
ONE = np.ones((1, 1), np.float32)
LENS, LEVEL, NO_FLOOR = np.array([1.0, 1.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0, 1.5]), np.zeros(4)
NEAR, FAR, CLEAR = 0.5, 4.5, 0.05
EDGES = np.array([NEAR, FAR, 0.3, 7.0], np.float32)

depths = arrays(
    np.float32,
    st.tuples(st.integers(0, 3), st.integers(0, 140)),
    elements=st.floats(width=32) | st.sampled_from(EDGES),
)
planes = arrays(np.float64, 4, elements=st.floats(-10, 10) | st.sampled_from([0.0, -0.0]))
limits = st.tuples(st.floats(0, 5), st.floats(0.001, 5), st.floats(-2, 2))


@given(depths, planes, limits)
def test_twin_keeps_the_same(depth: Depth, plane: Floats, space: tuple[float, float, float]) -> None:
    """Native and reference agree to the last bit for any depth and plane, or none."""
    lens, (near, length, clear) = np.array([150.0, 151.0, 31.5, 0.7]), space
    arguments = depth, lens, plane, near, near + length, clear
    assert_array_equal(_core.above_floor(*arguments), reference.above_floor(*arguments), strict=True)


@pytest.mark.parametrize("known", [True, False], ids=["floor", "no floor"])
def test_twin_keeps_the_same_of_pictures(picture: Depth, camera: Floats, floor: Floats, known: bool) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    arguments = picture, camera, known * floor, NEAR, FAR, CLEAR
    native = _core.above_floor(*arguments)
    assert native.shape == picture.shape
    assert_array_equal(native, reference.above_floor(*arguments), strict=True)


def test_agrees_with_points(kernels: Kernels, noisy_room: Depth, camera: Floats, floor: Floats) -> None:
    """What is kept is what the inverse of the camera's matrix puts above the floor and in range, but for
    points nearer to the limit than float32 tells.
    """
    fx, fy, cx, cy = camera
    inverse = np.linalg.inv([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    v, u = np.mgrid[:144, :176]
    points = np.stack([u, v, np.ones(u.shape)], axis=-1) @ inverse.T * noisy_room[:, :, None]
    height = points @ floor[:3] + floor[3]
    in_range = (noisy_room >= NEAR) & (noisy_room < FAR)
    told = ~(np.abs(height - CLEAR) < 10 * 8 * np.finfo(np.float32).eps)  # ten roundings below 8 m
    kept = ~np.isnan(kernels.above_floor(noisy_room, camera, floor, NEAR, FAR, CLEAR))
    assert_array_equal(kept[told], ((height > CLEAR) & in_range)[told])
    assert 0.2 < kept.mean() < 0.8
    assert told.mean() > 0.99


def test_room(kernels: Kernels, room: Depth, surfaces: Floats, camera: Floats, floor: Floats) -> None:
    """Of the room the person stays but for the lowest 5 of 175 cm, floor and the wall beyond ``far`` go."""
    kept = ~np.isnan(kernels.above_floor(room, camera, floor, NEAR, FAR, CLEAR))
    ground, wall, person = (surfaces.argmin(axis=0) == i for i in range(3))
    assert not kept[ground].any()
    assert not kept[wall].any()
    assert 0.95 < kept[person].mean() < 0.99


def test_example_by_hand(kernels: Kernels) -> None:
    """Down at 45 degrees from 1.5 m: 1 m ahead is 0.5 m above the floor, 2 m ahead below it; the row at eye
    level is 1.5 m above. Limits of height are open, of depth half open.
    """
    depth = np.array([[2, 0.5, 4.5], [1, 2, np.nan]], np.float32)
    kept = kernels.above_floor(depth, LENS, LEVEL, 0.5, 4.5, 0.25)
    assert_array_equal(kept, np.float32([[2, 0.5, np.nan], [1, np.nan, np.nan]]))
    assert np.isnan(kernels.above_floor(depth, LENS, LEVEL, 0.5, 4.5, 0.5)[1, 0])
    assert np.isnan(kernels.above_floor(depth, LENS, LEVEL, 0.6, 4.5, 0.25)[0, 1])


@pytest.mark.parametrize("strange", [np.nan, 0, -0.0, -2, np.inf, -np.inf])
@pytest.mark.parametrize("plane", [LEVEL, NO_FLOOR], ids=["floor", "no floor"])
def test_nothing_measured_is_not_kept(kernels: Kernels, strange: float, plane: Floats) -> None:
    """What isn't above 0 and finite is NaN, even where the range begins at 0."""
    depth = ONE * np.float32(strange)
    assert np.isnan(kernels.above_floor(depth, LENS, plane, 0.0, 1e30, -10.0)).all()


@pytest.mark.parametrize("clear", [-1.0, 0.0, 1e6, 1e300])
@pytest.mark.parametrize("focal_length", [190.0, 1e-45])
def test_without_a_floor_all_in_range_is_kept(
    kernels: Kernels, picture: Depth, clear: float, focal_length: float
) -> None:
    """Zeros are no plane: then everything is above it, whatever ``clear`` and the camera, to rays that
    float32 can't hold.
    """
    lens = np.array([focal_length, focal_length, 40.0, 30.0])
    kept = kernels.above_floor(picture, lens, NO_FLOOR, NEAR, FAR, clear)
    in_range = (picture >= np.float32(NEAR)) & (picture < np.float32(FAR))
    assert_array_equal(kept, np.where(in_range, picture, np.float32(np.nan)))


@given(depths, st.floats(-1, 1), st.floats(0, 1))
def test_keeps_depths_and_less_the_higher(depth: Depth, clear: float, more: float) -> None:
    """What is kept is kept as it is, and nothing more is kept of what is higher."""
    for kernels in (_core, reference):
        low, high = (kernels.above_floor(depth, LENS, LEVEL, NEAR, FAR, c) for c in (clear, clear + more))
        kept = ~np.isnan(low)
        assert_array_equal(low[kept], depth[kept])
        assert not (~np.isnan(high) & ~kept).any()


@pytest.mark.parametrize(
    ("lens", "plane", "message"),
    [
        (LENS[:3], LEVEL, r"camera: expected shape \(4,\), got \(3,\)"),
        (LENS * np.nan, LEVEL, "camera: expected finite numbers, got nan"),
        (LENS * [0, 1, 1, 1], LEVEL, "camera: expected focal lengths above 0, got 0"),
        (LENS, LEVEL[:3], r"plane: expected shape \(4,\), got \(3,\)"),
        (LENS, LEVEL + np.inf, "plane: expected finite numbers, got inf"),
    ],
)
def test_refuses_other_cameras_and_planes(
    kernels: Kernels, lens: Floats, plane: Floats, message: str
) -> None:
    """What is no camera or no plane is named."""
    with pytest.raises(ValueError, match=message):
        kernels.above_floor(ONE, lens, plane, NEAR, FAR, CLEAR)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"near": -0.1}, "near: expected a finite number, not negative, got -0.1"),
        ({"near": np.nan}, "near: expected a finite number, not negative, got nan"),
        ({"near": np.inf}, "near: expected a finite number, not negative, got inf"),
        ({"far": NEAR}, "far: expected a finite number above near, got 0.5"),
        ({"far": np.nan}, "far: expected a finite number above near, got nan"),
        ({"far": np.inf}, "far: expected a finite number above near, got inf"),
        ({"clear": np.nan}, "clear: expected a finite number, got nan"),
        ({"clear": -np.inf}, "clear: expected a finite number, got -inf"),
    ],
)
def test_refuses_other_spaces(kernels: Kernels, changes: dict[str, float], message: str) -> None:
    """Limits that leave no space, or are none, are named."""
    with pytest.raises(ValueError, match=message):
        kernels.above_floor(ONE, LENS, LEVEL, **{"near": NEAR, "far": FAR, "clear": CLEAR} | changes)


BAD: list[tuple[int, Any, type[Exception], str]] = [
    (0, ONE.astype(float), TypeError, r"depth: expected a float32 depth image \(H, W\), got float64"),
    (0, ONE[0], ValueError, r"depth: expected a float32 depth image \(H, W\), got float32 \(1,"),
    (0, np.zeros((3, 8), np.float32)[:, ::2], ValueError, "depth: expected packed pixels"),
    (0, np.zeros((3, 8), np.float32)[::-1], ValueError, "depth: expected packed pixels"),
    (0, None, TypeError, "depth: expected a NumPy array, a float32 depth image"),
    (1, LENS.astype(np.float32), TypeError, "camera: expected float64"),
    (2, np.repeat(LEVEL, 2)[::2], ValueError, "plane: expected a C-contiguous"),
]


@pytest.mark.parametrize(("place", "value", "error", "message"), BAD)
def test_native_refuses_other_arrays(place: int, value: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    arguments: list[Any] = [ONE, LENS, LEVEL, NEAR, FAR, CLEAR]
    arguments[place] = value
    with pytest.raises(error, match=message):
        _core.above_floor(*arguments)
