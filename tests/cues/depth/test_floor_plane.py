# SPDX-License-Identifier: MIT
"""The floor by RANSAC and least squares."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
Triples = NDArray[np.int64]
UP = np.array([0.0, -1.0, 0.0])
TOLERANCE, LEAST_COSINE = 0.05, 0.8
# Covariances are sums of n products of numbers below spread^2: rounded n times at most they are wrong by
# n eps spread^2, and the eigenvector by that over the gap of the eigenvalues, at least a tenth of spread^2 in
# these pictures. With n = 6336 that is 1.4e-11, as much again for the other twin, and |X| below 10 m makes d
# ten times as wrong.
ROUNDING = 1e-9


def thinned(depth: Depth) -> Depth:
    """Every other pixel of every other row."""
    return np.ascontiguousarray(depth[::2, ::2])


def draw(depth: Depth, count: int, seed: int) -> Triples:
    """Triples of random pixels."""
    return np.random.default_rng(seed).integers(0, max(depth.size, 1), (count if depth.size else 0, 3))


def points_of(depth: Depth, camera: Floats) -> Floats:
    """The measured points, in float64."""
    fx, fy, cx, cy = camera
    v, u = np.indices(depth.shape)
    points = np.stack([(u - cx) / fx * depth, (v - cy) / fy * depth, depth], axis=-1)
    return points[np.isfinite(depth)].astype(np.float64)


def seen(plane: Floats, camera: Floats, shape: tuple[int, int]) -> Depth:
    """The depth of a plane n · X + d = 0, NaN where a ray misses it."""
    v, u = np.indices(shape)
    slope = (u - camera[2]) / camera[0] * plane[0] + (v - camera[3]) / camera[1] * plane[1] + plane[2]
    return np.where(slope < -0.01, plane[3] / -slope, np.nan).astype(np.float32)


@pytest.mark.parametrize("seed", range(8))
def test_twin_finds_the_same(noisy_room: Depth, camera: Floats, seed: int) -> None:
    """Native and reference find the same plane in the room, from few triples and many, level or not."""
    depth = thinned(noisy_room)
    for count, least_cosine in ((5, -1.0), (40, 0.3), (100, LEAST_COSINE)):
        arguments = depth, camera / 2, draw(depth, count, seed), TOLERANCE, UP, least_cosine
        native, twin = _core.floor_plane(*arguments), reference.floor_plane(*arguments)
        assert_allclose(native, twin, rtol=0, atol=ROUNDING)
        assert native.any() or count < 100


def test_twin_finds_the_same_in_pictures(picture: Depth, camera: Floats) -> None:
    """They also agree on pictures of awkward sizes and layouts, with strange numbers among the depths."""
    arguments = picture, camera, draw(picture, 30, 0), 0.3, UP, -1.0
    native, twin = _core.floor_plane(*arguments), reference.floor_plane(*arguments)
    assert_allclose(native, twin, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("seed", range(5))
def test_finds_the_floor(
    kernels: Kernels, noisy_room: Depth, surfaces: Floats, camera: Floats, floor: Floats, seed: int
) -> None:
    """With noise, outliers, holes, a wall and a person the floor is found to half a degree and a centimeter,
    and its share is that of the pixels that show it.
    """
    depth = thinned(noisy_room)
    plane = kernels.floor_plane(depth, camera / 2, draw(depth, 100, seed), TOLERANCE, UP, LEAST_COSINE)
    assert plane[:3] @ floor[:3] > np.cos(np.radians(0.5))
    assert abs(plane[3] - floor[3]) < 0.01
    share = np.mean(surfaces[:, ::2, ::2].argmin(axis=0) == 0)
    assert abs(plane[4] - 0.9 * share) < 0.04  # but for outliers; the foot of wall and person is near it too
    assert plane[5] < 0.1


@pytest.mark.parametrize("height", [0.6, 1.6, 3.0])
def test_plane_without_noise(kernels: Kernels, camera: Floats, height: float) -> None:
    """A plane alone gives its parameters back, within the rounding of float32 depths; all is on it."""
    truth = np.array([*np.array([0.1, -0.9, -0.3]) / np.sqrt(0.91), height])
    depth = seen(truth, camera, (144, 176))
    plane = kernels.floor_plane(depth, camera, draw(depth, 10, 0), 0.01, UP, LEAST_COSINE)
    assert_allclose(plane, [*truth, 1, 0], rtol=0, atol=1e-5)


def test_agrees_with_least_squares_by_svd(kernels: Kernels, camera: Floats) -> None:
    """Where all pixels are within tolerance the plane is that of numpy.linalg.svd of the centerd points, but
    for their rounding to float32.
    """
    depth = seen(np.array([0.0, -0.9, -np.sqrt(0.19), 1.5]), camera, (60, 80))
    depth += np.random.default_rng(0).normal(0, 0.02, depth.shape).astype(np.float32)
    points = points_of(depth, camera)
    mean = points.mean(axis=0)
    normal = np.linalg.svd(points - mean)[2][2]
    normal *= -np.sign(normal @ mean)
    plane = kernels.floor_plane(depth, camera, draw(depth, 30, 0), 1.0, UP, 0.5)
    assert_allclose(plane, [*normal, -normal @ mean, 1, 0], rtol=0, atol=1e-6)


def test_shares_are_counts(kernels: Kernels, noisy_room: Depth, camera: Floats) -> None:
    """The shares are what heights above the plane say, but for pixels whose height rounding decides."""
    depth = thinned(noisy_room)
    plane = kernels.floor_plane(depth, camera / 2, draw(depth, 50, 1), TOLERANCE, UP, LEAST_COSINE)
    height = points_of(depth, camera / 2) @ plane[:3] + plane[3]
    one = 1.5 / len(height)
    assert abs(plane[4] - np.mean(abs(height) <= TOLERANCE)) < one
    assert abs(plane[5] - np.mean(height < -3 * TOLERANCE)) < one
    assert plane[4] > 0.2
    assert plane[5] > 0


def level_scene(*heights: float) -> Depth:
    """Rows that see planes so far below a level camera (fx = fy = 10, cx = 1, cy = 0), from the row 1 on."""
    rows = np.arange(1, len(heights) + 1)
    depth = np.array([np.nan, *(10 * np.array(heights) / rows)], np.float32)
    return np.ascontiguousarray(depth.repeat(4).reshape(-1, 4))


LENS = np.array([10.0, 10.0, 1.0, 0.0])
TABLE = level_scene(0.5, 0.5, 0.5, 2.0, 2.0)  # 12 pixels of a table, 8 of the floor below it
ON_TABLE, ON_FLOOR = [4, 7, 9], [16, 19, 21]


def test_below_counts_against_a_plane(kernels: Kernels) -> None:
    """A table has more pixels than the floor, but the floor lies below it: 12 - 3 * 8 loses against 8,
    whichever comes first. From the table's triple alone nothing is found, as its score isn't above 0.
    """
    for triples in ([ON_TABLE, ON_FLOOR], [ON_FLOOR, ON_TABLE]):
        plane = kernels.floor_plane(TABLE, LENS, np.array(triples), 0.01, UP, LEAST_COSINE)
        assert_allclose(plane, [0, -1, 0, 2, 0.4, 0], atol=1e-6)
    assert_array_equal(kernels.floor_plane(TABLE, LENS, np.array([ON_TABLE]), 0.01, UP, 0.8), np.zeros(6))


def test_first_of_equals_wins(kernels: Kernels) -> None:
    """Of two planes with equal scores, neither of which has anything below it, the first wins."""
    steps = level_scene(1.0, 1.0, 1.0, 1.02, 1.02, 1.02)  # with a tolerance of 1 cm, below begins at 3 cm
    upper, lower = [4, 7, 9], [16, 19, 21]
    for first, second, height in ((upper, lower, 1.0), (lower, upper, 1.02)):
        triples = np.array([first, second])
        plane = kernels.floor_plane(steps, LENS, triples, 0.01, UP, LEAST_COSINE)
        assert_allclose(plane, [0, -1, 0, height, 0.5, 0], atol=1e-6)


def test_only_level_planes_count(kernels: Kernels, room: Depth, camera: Floats) -> None:
    """The wall is larger than the floor, but isn't level; only where up points away from it does it count."""
    depth, triples = thinned(room), draw(thinned(room), 100, 0)
    floor = kernels.floor_plane(depth, camera / 2, triples, TOLERANCE, UP, LEAST_COSINE)
    wall = kernels.floor_plane(
        depth, camera / 2, triples, TOLERANCE, np.array([0.0, 0.0, -1.0]), LEAST_COSINE
    )
    assert wall[4] > floor[4]
    assert abs(wall[:3] @ floor[:3]) < 0.01
    assert abs(wall[3] - 5) < 0.02
    assert_array_equal(
        kernels.floor_plane(depth, camera / 2, triples, TOLERANCE, -UP, LEAST_COSINE), np.zeros(6)
    )


@pytest.mark.parametrize(
    "triple",
    [[4, 4, 9], [4, 9, 9], [4, 9, 4], [4, 4, 4], [0, 4, 9], [4, 9, 3], [4, 5, 6], [4, 8, 12], [12, 12, 12]],
)
def test_skips_what_gives_no_plane(kernels: Kernels, triple: list[int]) -> None:
    """Repeated pixels, pixels without depth (row 0) and pixels on a line are skipped, not what follows."""
    floor = level_scene(1.0, 1.0, 1.0)
    assert_array_equal(kernels.floor_plane(floor, LENS, np.array([triple]), 0.01, UP, -1.0), np.zeros(6))
    plane = kernels.floor_plane(floor, LENS, np.array([triple, [4, 7, 9]]), 0.01, UP, -1.0)
    assert_allclose(plane, [0, -1, 0, 1, 1, 0], atol=1e-6)


def test_skips_planes_through_the_camera(kernels: Kernels) -> None:
    """All that a row of pixels shows is in one plane with the camera, which is no floor, rounded or not."""
    row = np.random.default_rng(0).uniform(1, 5, (1, 90)).astype(np.float32)
    for lens in (LENS, LENS + [0, 0, 0, 3.3]):
        assert_array_equal(kernels.floor_plane(row, lens, draw(row, 50, 0), 0.1, UP, -1.0), np.zeros(6))


@given(st.integers(0, 2**32), st.floats(-1, 1), st.floats(0.01, 0.5))
def test_what_comes_out_is_a_level_plane(seed: int, least_cosine: float, tolerance: float) -> None:
    """Whatever the depths, there is nothing, or a plane below the camera, as level as was asked for."""
    rng = np.random.default_rng(seed)
    depth = rng.choice(np.float32([0.5, 1, 1.5, 2, np.nan]), (7, 9))
    result = _core.floor_plane(
        depth, np.array([8.0, 8.0, 4.0, 3.0]), draw(depth, 20, seed), tolerance, UP, least_cosine
    )
    if result.any():
        assert abs(np.linalg.norm(result[:3]) - 1) < 1e-12
        assert result[3] > 0
        assert result[:3] @ UP >= least_cosine
        assert (result[4:] >= 0).all()
        assert result[4:].sum() <= 1


def test_scale(kernels: Kernels, noisy_room: Depth, camera: Floats) -> None:
    """A room twice as large has the same floor at twice the height."""
    depth = thinned(noisy_room)
    triples = draw(depth, 50, 3)
    plane = kernels.floor_plane(depth, camera / 2, triples, TOLERANCE, UP, LEAST_COSINE)
    double = kernels.floor_plane(2 * depth, camera / 2, triples, 2 * TOLERANCE, UP, LEAST_COSINE)
    assert_allclose(double, plane * [1, 1, 1, 2, 1, 1], rtol=1e-12)


@pytest.mark.parametrize(
    "depth", [np.full((4, 5), np.nan, np.float32), np.empty((0, 5), np.float32)], ids=["holes", "no pixels"]
)
def test_nothing_to_see(kernels: Kernels, depth: Depth) -> None:
    """Without a measurement, without pixels and without triples there is no floor: zeros."""
    assert_array_equal(kernels.floor_plane(depth, LENS, draw(depth, 9, 0), 0.1, UP, -1.0), np.zeros(6))
    assert_array_equal(
        kernels.floor_plane(TABLE, LENS, np.empty((0, 3), np.int64), 0.1, UP, -1.0), np.zeros(6)
    )


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"camera": LENS[:2]}, r"camera: expected shape \(4,\), got \(2,\)"),
        ({"camera": -LENS}, "camera: expected focal lengths above 0, got -10"),
        ({"tolerance": 0.0}, "tolerance: expected a finite number above 0, got 0"),
        ({"tolerance": np.nan}, "tolerance: expected a finite number above 0, got nan"),
        ({"up": UP[:2]}, r"up: expected shape \(3,\), got \(2,\)"),
        ({"up": UP + np.nan}, "up: expected finite numbers, got nan"),
        ({"up": 2 * UP}, "up: expected a vector of length 1, got 2"),
        ({"min_cosine": 1.5}, r"min_cosine: expected a number in \[-1, 1\], got 1.5"),
        ({"min_cosine": np.nan}, r"min_cosine: expected a number in \[-1, 1\], got nan"),
        ({"triples": np.array([[0, 1, 24]])}, r"triples: expected indices in \[0, 24\), got 24"),
        ({"triples": np.array([[0, -1, 24]])}, r"triples: expected indices in \[0, 24\), got -1"),
    ],
)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """What is no camera, tolerance, direction, cosine or pixel is named."""
    good = {
        "depth": TABLE,
        "camera": LENS,
        "triples": np.array([ON_FLOOR]),
        "tolerance": 0.1,
        "up": UP,
        "min_cosine": 0.8,
    }
    with pytest.raises(ValueError, match=message):
        kernels.floor_plane(**{**good, **changes})


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.zeros((2, 4), np.int64), ValueError, r"triples: expected int64 triples \(K, 3\), got int64 \(2, 4\)"),
    (np.zeros((2, 3), np.int32), TypeError, r"triples: expected int64 triples \(K, 3\), got int32"),
    (np.zeros((3, 2), np.int64).T, ValueError, "triples: expected a C-contiguous, aligned array"),
]


@pytest.mark.parametrize(("triples", "error", "message"), BAD)
def test_native_refuses_other_triples(triples: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.floor_plane(TABLE, LENS, triples, 0.1, UP, 0.8)
