# SPDX-License-Identifier: MIT
"""How much of a depth image lies on a known plane."""

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
TOLERANCE = 0.05

depths = arrays(np.float32, st.tuples(st.integers(0, 12), st.integers(0, 140)))
planes = arrays(np.float64, 4, elements=st.floats(-10, 10))


@given(depths, planes, st.floats(1e-3, 10), st.integers(1, 20))
def test_twin_counts_the_same(depth: Depth, plane: Floats, tolerance: float, step: int) -> None:
    """Native and reference agree to the last bit for any depth, plane, tolerance and step."""
    lens = np.array([150.0, 151.0, 31.5, 0.7])
    arguments = depth, lens, plane, tolerance, step
    assert_array_equal(_core.plane_support(*arguments), reference.plane_support(*arguments), strict=True)


@pytest.mark.parametrize("step", [1, 2, 3, 7, 64, 1000, 2**31 - 1])
def test_twin_counts_the_same_in_pictures(picture: Depth, camera: Floats, floor: Floats, step: int) -> None:
    """They also agree on pictures of awkward sizes and layouts, thinned out to a single pixel."""
    arguments = picture, camera, floor, 0.3, step
    assert_array_equal(_core.plane_support(*arguments), reference.plane_support(*arguments), strict=True)


def heights(depth: Depth, camera: Floats, plane: Floats) -> Floats:
    """Of all that was measured, by the inverse of the camera's matrix, in float64."""
    fx, fy, cx, cy = camera
    inverse = np.linalg.inv([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    v, u = np.indices(depth.shape)
    points = np.stack([u, v, np.ones(u.shape)], axis=-1) @ inverse.T * depth[:, :, None]
    return (points @ plane[:3] + plane[3])[np.isfinite(depth)]


def test_agrees_with_points(kernels: Kernels, noisy_room: Depth, camera: Floats, floor: Floats) -> None:
    """The shares are those of points made by the inverse of the camera's matrix, but for the few that are
    nearer to a limit than float32 tells.
    """
    within, below = kernels.plane_support(noisy_room, camera, floor, TOLERANCE, 1)
    height = heights(noisy_room, camera, floor)
    rounding = 10 * 8 * np.finfo(np.float32).eps  # ten roundings below 8 m
    for share, limits, truth in (
        (within, [-TOLERANCE, TOLERANCE], np.abs(height) <= TOLERANCE),
        (below, [-3 * TOLERANCE], height < -3 * TOLERANCE),
    ):
        untold = np.abs(height[:, None] - limits).min(axis=1) < rounding
        assert abs(share - truth.mean()) <= untold.mean() < 1e-3


@pytest.mark.parametrize("step", [1, 2, 5])
def test_agrees_with_floor_plane(kernels: Kernels, noisy_room: Depth, camera: Floats, step: int) -> None:
    """A plane that floor_plane found in the thinned image has the support that was found with it, but for
    points that the two, each in its order of float32, put on other sides of a limit.
    """
    thin = np.ascontiguousarray(noisy_room[::step, ::step])
    triples = np.random.default_rng(0).integers(0, thin.size, (60, 3))
    found = kernels.floor_plane(thin, camera / step, triples, TOLERANCE, np.array([0.0, -1.0, 0.0]), 0.8)
    assert found[4] > 0.3
    support = kernels.plane_support(noisy_room, camera, found[:4], TOLERANCE, step)
    assert_allclose(support, found[4:], rtol=0, atol=2 / np.isfinite(thin).sum())


def test_room(kernels: Kernels, room: Depth, surfaces: Floats, camera: Floats, floor: Floats) -> None:
    """In the room without noise, what shows the floor is on it, and feet and the wall's foot, whose heights
    are below the tolerance; nothing is below it. Half a meter under a table there is no support.
    """
    shows = (surfaces.argmin(axis=0) == 0).mean()
    within, below = kernels.plane_support(room, camera, floor, TOLERANCE, 1)
    assert shows <= within < shows + 0.05
    assert below == 0
    table = floor - [0, 0, 0, 0.5]
    within, below = kernels.plane_support(room, camera, table, TOLERANCE, 1)
    assert within < 0.1
    assert below >= shows


def test_example_by_hand(kernels: Kernels) -> None:
    """Of seven measured pixels four are 1.5 m up, at the camera's height, three are seen 45 degrees below it,
    1.5, 1.75 and 3 m ahead: 0, -0.25 and -1.5 m high. Within the tolerance is at most it, below is more than
    three times it.
    """
    depth = np.array([[9, 9, 9, 9], [1.5, 1.75, 3, np.nan]], np.float32)

    def support(tolerance: float) -> Any:
        return kernels.plane_support(depth, LENS, LEVEL, tolerance, 1)

    assert_array_equal(support(0.2), np.array([1, 1]) / 7)
    assert_array_equal(support(0.25), np.array([2, 1]) / 7)
    assert_array_equal(support(0.5), np.array([2, 0]) / 7)
    assert_array_equal(support(0.05), np.array([1, 2]) / 7)
    assert_array_equal(support(1.5), np.array([7, 0]) / 7)


def test_every_step_th_pixel_counts(kernels: Kernels) -> None:
    """Pixels 0, step, 2 step of rows 0, step, 2 step count, and no others."""
    for step in (1, 2, 3, 4):
        depth = np.full((7, 10), 0.1, np.float32)
        depth[::step, ::step] = 1.5
        level = np.array([0.0, 0.0, 1.0, -1.5])  # the plane Z = 1.5
        assert_array_equal(kernels.plane_support(depth, LENS, level, 0.01, step), [1, 0])
        depth[::step, ::step] = np.nan
        assert_array_equal(kernels.plane_support(depth, LENS, level, 0.01, step), [0, 0])


@pytest.mark.parametrize("strange", [np.nan, 0, -0.0, -2, np.inf, -np.inf])
def test_nothing_measured_supports_nothing(kernels: Kernels, strange: float) -> None:
    """What isn't above 0 and finite doesn't count; where nothing else is, both shares are 0."""
    depth = np.full((2, 3), strange, np.float32)
    assert_array_equal(kernels.plane_support(depth, LENS, LEVEL, TOLERANCE, 1), [0, 0])
    depth[0, 0] = 2  # on the axis, 1.5 m above the floor
    assert_array_equal(kernels.plane_support(depth, LENS, LEVEL, 1.5, 1), [1, 0])


@given(depths, planes, st.integers(1, 5))
def test_shares(depth: Depth, plane: Floats, step: int) -> None:
    """Shares are of one whole, and a larger tolerance has no less within and no more below."""
    for kernels in (_core, reference):
        small, large = (
            kernels.plane_support(depth, LENS, plane, tolerance, step) for tolerance in (0.1, 0.2)
        )
        for within, below in (small, large):
            assert min(within, below) >= 0
            assert within + below <= 1
        assert small[0] <= large[0]
        assert small[1] >= large[1]


BAD_VALUES: list[tuple[int, Any, str]] = [
    (1, LENS[:3], r"camera: expected shape \(4,\), got \(3,\)"),
    (1, LENS * np.nan, "camera: expected finite numbers, got nan"),
    (1, -LENS, "camera: expected focal lengths above 0, got -1"),
    (2, LEVEL[:3], r"plane: expected shape \(4,\), got \(3,\)"),
    (2, LEVEL + np.inf, "plane: expected finite numbers, got inf"),
    (3, 0.0, "tolerance: expected a finite number above 0, got 0"),
    (3, -0.5, "tolerance: expected a finite number above 0, got -0.5"),
    (3, np.nan, "tolerance: expected a finite number above 0, got nan"),
    (3, np.inf, "tolerance: expected a finite number above 0, got inf"),
    (4, 0, "step: expected at least 1, got 0"),
    (4, -3, "step: expected at least 1, got -3"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, place: int, value: Any, message: str) -> None:
    """Cameras, planes, tolerances and steps that are none are named."""
    arguments: list[Any] = [ONE, LENS, LEVEL, TOLERANCE, 1]
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        kernels.plane_support(*arguments)


BAD: list[tuple[int, Any, type[Exception], str]] = [
    (0, ONE.astype(float), TypeError, r"depth: expected a float32 depth image \(H, W\), got float64"),
    (0, ONE[0], ValueError, r"depth: expected a float32 depth image \(H, W\), got float32 \(1,"),
    (0, np.zeros((3, 8), np.float32)[:, ::2], ValueError, "depth: expected packed pixels"),
    (0, np.zeros((3, 8), np.float32)[::-1], ValueError, "depth: expected packed pixels"),
    (1, LENS.astype(np.float32), TypeError, "camera: expected float64"),
    (2, np.repeat(LEVEL, 2)[::2], ValueError, "plane: expected a C-contiguous"),
]


@pytest.mark.parametrize(("place", "value", "error", "message"), BAD)
def test_native_refuses_other_arrays(place: int, value: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    arguments: list[Any] = [ONE, LENS, LEVEL, TOLERANCE, 1]
    arguments[place] = value
    with pytest.raises(error, match=message):
        _core.plane_support(*arguments)
