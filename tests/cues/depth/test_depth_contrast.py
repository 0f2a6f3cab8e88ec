# SPDX-License-Identifier: MIT
"""The depths in and round rectangles in meters."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, argument, with_argument

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
EPS = float(np.finfo(np.float64).eps)
ROOT_HALF = np.sqrt(0.5)
REACH, NEARER = 0.5, 0.2
PLACES = (14, 10, 1.3, 12)  # rows, columns, margin, along
DISTANCE, INSIDE, FRONT, AROUND = range(4)


def image(shape: tuple[int, int], seed: int) -> Depth:
    """Depths about 3 m, and every kind of pixel without one."""
    rng = np.random.default_rng(seed)
    depth = rng.normal(3, 0.4, shape).astype(np.float32)
    missing = rng.random(shape) < 0.2
    depth[missing] = rng.choice(np.array([np.nan, 0, -1, np.inf, -np.inf], np.float32), shape)[missing]
    return depth


def camera_of(shape: tuple[int, ...]) -> Floats:
    """A lens as wide as the image, whose axis isn't in its middle."""
    return np.array([shape[1] + 1.0, shape[1] + 1.5, 0.45 * shape[1], 0.55 * shape[0]])


def states(count: int, seed: int) -> Floats:
    """(count, 5) rectangles in, across and outside the image, some in front of it."""
    rng = np.random.default_rng(seed)
    return np.column_stack(
        [rng.uniform(-2.5, 2.5, (count, 2)), rng.normal(3, 0.3, count), rng.uniform(0, 2.5, (count, 2))]
    )


def case(seed: int, count: int = 5, levels: int = 16) -> list[Any]:
    """All arguments, with a model of sum 1."""
    rng = np.random.default_rng(seed)
    depth = image((int(rng.integers(0, 40)), int(rng.integers(0, 60))), seed)
    model = rng.dirichlet(np.ones(levels))
    return [depth, camera_of(depth.shape), states(count, seed), (model, REACH), PLACES, NEARER]


def assert_same(arguments: list[Any]) -> None:
    """Shares agree exactly. Of L levels' shares, at most 1 in sum, each is off by two roundings, and the sum
    of their squares by its order and four more.
    """
    native, twin = (k.depth_contrast(*arguments) for k in (_core, reference))
    assert native.shape == (len(arguments[2]), 4)
    assert_array_equal(native[:, INSIDE:], twin[:, INSIDE:])
    levels = len(arguments[3][0])
    assert_allclose(native[:, DISTANCE], twin[:, DISTANCE], rtol=(levels + 4) * EPS, atol=2 * EPS)


@given(
    st.integers(0, 2**32),
    st.integers(0, 9),
    st.integers(1, 70),
    st.tuples(st.integers(1, 64), st.integers(1, 64), st.floats(1, 4), st.integers(1, 64)),
    st.floats(0.01, 5),
    st.floats(0, 1),
)
def test_twin_measures_the_same(
    seed: int,
    count: int,
    levels: int,
    places: tuple[int, int, float, int],
    reach: float,
    nearer: float,
) -> None:
    """Native and reference agree for any image, rectangles, model, grid and ring."""
    depth, camera, each, (histogram, _), *_ = case(seed, count, levels)
    assert_same([depth, camera, each, (histogram, reach), places, nearer])


@pytest.mark.parametrize("count", [0, 1, 100])
def test_twin_measures_the_same_in_pictures(picture: Depth, count: int) -> None:
    """They also agree on pictures of awkward sizes and layouts, for no rectangle and for many."""
    model = np.random.default_rng(0).dirichlet(np.ones(64))
    assert_same([picture, camera_of(picture.shape), states(count, 1), (model, REACH), PLACES, NEARER])


def grid(rows: int, columns: int) -> Floats:
    """(rows x columns, 2): (u, v) in half sizes, the middles of equal parts of a square."""
    across, down = ((np.arange(n) + 0.5) / n * 2 - 1 for n in (columns, rows))
    return np.array([(u, v) for v in down for u in across])


def ring(margin: float, along: int) -> Floats:
    """(4 along, 2): those around it."""
    middles = (np.arange(along) + 0.5) / along * 2 - 1
    return np.array(
        [each for m in middles for each in ((-margin, m), (margin, m), (m, -margin), (m, margin))]
    )


def look(depth: Depth, camera: Floats, state: Floats, where: Floats) -> Floats:
    """The depths that places of a rectangle show: points in space, which OpenCV projects; NaN for none."""
    x, y, z, width, height = state
    fx, fy, cx, cy = camera
    points = np.column_stack(
        [x + where[:, 0] * width / 2, y + where[:, 1] * height / 2, np.full(len(where), z)]
    )
    matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    pixels, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, None)
    u, v = np.floor(pixels[:, 0] + 0.5).astype(int).T
    seen = np.full(len(where), np.nan)
    inside = (u >= 0) & (v >= 0) & (u < depth.shape[1]) & (v < depth.shape[0])
    seen[inside] = depth[v[inside], u[inside]]
    seen[~((seen > 0) & (seen < np.inf))] = np.nan
    return seen


@pytest.mark.parametrize("levels", [1, 7, 64])
@pytest.mark.parametrize("places", [PLACES, (1, 1, 1.0, 1), (64, 3, 2.5, 64)])
def test_agrees_with_points_in_space(
    kernels: Kernels, levels: int, places: tuple[int, int, float, int]
) -> None:
    """Places are where OpenCV projects them; the histogram of what they show is NumPy's, the distance its
    norm over sqrt 2; shares are counts.
    """
    depth, each = image((90, 120), 4), states(40, 5)
    lens, model = camera_of(depth.shape), np.random.default_rng(levels).dirichlet(np.ones(levels))
    expected = np.empty((40, 4))
    for i, state in enumerate(each):
        inside, around = (
            look(depth, lens, state, where) - state[2] for where in (grid(*places[:2]), ring(*places[2:]))
        )
        counts, _ = np.histogram(inside[(inside >= -REACH) & (inside < REACH)], levels, (-REACH, REACH))
        total = counts.sum()
        expected[i] = (
            np.linalg.norm(counts / total - model) * ROOT_HALF if total else 1,
            total / len(inside),
            np.count_nonzero(inside < -NEARER) / len(inside),
            np.count_nonzero((around >= -REACH) & (around < REACH)) / len(around),
        )
    found = kernels.depth_contrast(depth, lens, each, (model, REACH), places, NEARER)
    assert_array_equal(found[:, INSIDE:], expected[:, INSIDE:])
    assert_allclose(found[:, DISTANCE], expected[:, DISTANCE], rtol=1e-12, atol=2 * EPS)
    assert (np.ptp(found[:, [INSIDE, AROUND]], axis=0) > 0.3).all()


def test_room(kernels: Kernels, room: Depth, surfaces: Floats, camera: Floats) -> None:
    """On the person of the room, all inside is the person, and nothing round him; half a meter before him
    there is nothing; a meter behind him all is nearer.
    """
    v, u = np.nonzero(surfaces.argmin(axis=0) == 2)
    z = float(np.median(room[v, u]))
    middle = np.array([np.median(u), np.median(v)])
    x, y = (middle - camera[2:]) * z / camera[:2]
    person = np.array([[x, y, z, 0.4, 0.5], [x, y, z - 0.5, 0.4, 0.5], [x, y, z + 1, 0.4, 0.5]])
    model = np.ones(1), 0.3
    found = kernels.depth_contrast(room, camera, person, model, (14, 10, 3.5, 12), NEARER)
    assert_array_equal(found[:, :3], [[0, 1, 0], [1, 0, 0], [1, 0, 1]])
    assert found[0, AROUND] < 0.6  # above and below is the person, too
    aside = kernels.depth_contrast(
        room, camera, person[:1] * [1, 1, 1, 1, 3.4], model, (14, 10, 1.9, 12), NEARER
    )
    assert aside[0, AROUND] < 0.1


def test_example_by_hand(kernels: Kernels) -> None:
    """One meter is 2 pixels 2 m away. Of the four pixels inside one isn't measured, one is far behind, one
    nearer, one at Z; of eight places round them three, above and left, are at Z.
    """
    depth = np.full((4, 4), 9, np.float32)
    depth[1:3, 1:3] = [[np.nan, 9], [1.75, 2]]
    depth[0, 1:3], depth[1, 0] = 2, 2.25
    camera, state = np.array([4.0, 4.0, 1.5, 1.5]), np.array([[0.0, 0, 2, 1, 1]])
    model = np.array([0.0, 0.5, 0.5, 0.0])

    def contrast(nearer: float, each: Floats = state) -> Any:
        return kernels.depth_contrast(depth, camera, each, (model, 0.5), (2, 2, 1.5, 2), nearer)

    assert_array_equal(contrast(0.125), [[0, 0.5, 0.25, 0.375]])
    assert_array_equal(contrast(0.25), [[0, 0.5, 0, 0.375]])
    farther = contrast(0.125, np.array([[0.0, 0, 2.25, 1.125, 1.125]]))
    assert_allclose(farther, [[np.sqrt(0.5) * ROOT_HALF, 0.5, 0.5, 0.375]], rtol=4 * EPS)


def test_reach_is_half_open(kernels: Kernels) -> None:
    """A depth of Z - reach counts, inside and round it; Z + reach doesn't."""
    camera, state = np.array([1.0, 1, 2, 2]), np.array([[0.0, 0, 2, 4, 4]])
    for z, counts in ((1.5, 1), (np.nextafter(np.float32(1.5), np.float32(0)), 0), (2.5, 0), (2.4375, 1)):
        depth = np.full((5, 5), z, np.float32)
        ((_, inside, front, around),) = kernels.depth_contrast(
            depth, camera, state, (np.ones(1), 0.5), (3, 3, 1.5, 3), 0.5
        )
        assert inside == around == counts
        assert front == (z < 1.5)


UNSEEN = [[1, 0, 0, 0]]


def test_unseen(kernels: Kernels) -> None:
    """Outside the image, in one of no pixels or of no measurement, and so near that the projection overflows,
    nothing counts: the distance is 1, the shares are 0.
    """
    flat, camera = np.full((8, 8), 2, np.float32), np.array([8.0, 8, 3.5, 3.5])
    here = np.array([[0.0, 0, 2, 1, 1]])
    for depth, state in (
        (flat, here + [30, 0, 0, 0, 0]),
        (flat, here - [0, 1e300, 0, 0, 0]),
        (flat, here * [1, 1, 1e-320, 1, 1]),
        (flat, here * [1, 1, 1e-320, 0, 0]),
        (flat, np.array([[1e308, 0, 1e-9, 1, 1]])),
        (flat * np.float32(np.nan), here),
        (np.zeros((0, 8), np.float32), here),
        (np.zeros((8, 0), np.float32), here),
    ):
        arguments = depth, camera, state, (np.full(2, 0.5), REACH), (3, 3, 1.3, 12), NEARER
        assert_array_equal(kernels.depth_contrast(*arguments), UNSEEN)


def test_only_what_is_round_it_may_be_unseen(kernels: Kernels) -> None:
    """A rectangle as large as the image is seen, the one round it isn't, up to a margin that overflows."""
    flat, camera = np.full((8, 8), 2, np.float32), np.array([8.0, 8, 3.5, 3.5])
    whole = np.array([[0.0, 0, 2, 2, 2]])
    for margin in (1.01, 1e300, 1e308):
        found = kernels.depth_contrast(flat, camera, whole, (np.ones(1), REACH), (8, 8, margin, 8), NEARER)
        assert_array_equal(found, [[0, 1, 0, 0]])


@given(st.integers(0, 2**32), st.sampled_from([0.5, 2.0, 4.0]))
def test_twice_as_large_and_far(seed: int, factor: float) -> None:
    """A world that is so many times as large, seen from as many times as far, looks the same: powers of two
    round nothing.
    """
    depth, camera, each, (histogram, reach), *_ = case(seed)
    larger = histogram, reach * factor
    for kernels in (_core, reference):
        here = kernels.depth_contrast(depth, camera, each, (histogram, reach), PLACES, NEARER)
        there = kernels.depth_contrast(
            depth * np.float32(factor), camera, each * factor, larger, PLACES, NEARER * factor
        )
        assert_array_equal(here, there)


@given(st.integers(0, 2**32))
def test_mirror(seed: int) -> None:
    """The mirrored world, seen by the mirrored camera, measures the same: places lie symmetrically, none of
    them within rounding of a pixel's edge.
    """
    rng = np.random.default_rng(seed)
    depth, each = image((30, 50), seed), states(6, seed)
    camera = np.array([50.0, 51, 20.3, 14.2])
    model = rng.dirichlet(np.ones(9)), REACH
    mirrored, lens = each * [-1, 1, 1, 1, 1], camera * [1, 1, 0, 1] + [0, 0, 49 - camera[2], 0]
    for kernels in (_core, reference):
        here = kernels.depth_contrast(depth, camera, each, model, PLACES, NEARER)
        there = kernels.depth_contrast(
            np.ascontiguousarray(depth[:, ::-1]), lens, mirrored, model, PLACES, NEARER
        )
        assert_array_equal(here, there)


@given(st.integers(0, 2**32))
def test_bounded(seed: int) -> None:
    """All is in [0, 1], and what is nearer by more than the reach isn't within it."""
    arguments = case(seed)
    for kernels in (_core, reference):
        found = kernels.depth_contrast(*arguments[:-1], REACH)
        assert found.min(initial=0) >= 0
        assert found.max(initial=1) <= 1
        assert (found[:, INSIDE] + found[:, FRONT]).max() <= 1 + EPS


BAD_VALUES: list[tuple[Place, Any, str]] = [
    (1, np.ones(3), r"camera: expected shape \(4,\), got \(3,\)"),
    (1, np.full(4, np.nan), "camera: expected finite numbers, got nan"),
    (1, np.array([1.0, 0, 1, 1]), "camera: expected focal lengths above 0, got 0"),
    (2, np.ones((3, 4)), r"states: expected shape \(3, 5\), got \(3, 4\)"),
    (2, np.full((3, 5), np.inf), "states: expected finite numbers, got inf"),
    (2, np.ones((2, 5)) * [1, 1, 0, 1, 1], "states: expected Z above 0, got 0"),
    (2, np.ones((2, 5)) * [1, 1, -2, 1, 1], "states: expected Z above 0, got -2"),
    ((3, 0), np.zeros(0), "model: expected at least one level, got none"),
    ((3, 0), np.array([1.5, -0.5]), "model: expected finite numbers, none negative, got -0.5"),
    ((3, 0), np.array([0.5, 0.25]), "model: expected a sum of 1, or of 0, got 0.75"),
    ((4, 0), 0, "rows: expected 1 to 64, got 0"),
    ((4, 0), 65, "rows: expected 1 to 64, got 65"),
    ((4, 1), -3, "columns: expected 1 to 64, got -3"),
    ((4, 1), 65, "columns: expected 1 to 64, got 65"),
    ((4, 3), 0, "along: expected 1 to 64, got 0"),
    ((4, 3), 65, "along: expected 1 to 64, got 65"),
    ((4, 2), 0.9, "margin: expected a finite number of at least 1, got 0.9"),
    ((4, 2), np.inf, "margin: expected a finite number of at least 1, got inf"),
    ((4, 2), np.nan, "margin: expected a finite number of at least 1, got nan"),
    ((3, 1), 0.0, "reach: expected a finite number above 0, got 0"),
    ((3, 1), np.inf, "reach: expected a finite number above 0, got inf"),
    (5, -0.1, "occluder_margin: expected a finite number, not negative, got -0.1"),
    (5, np.nan, "occluder_margin: expected a finite number, not negative, got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Cameras, states, models, places and limits that are none are named."""
    arguments = with_argument(case(0), place, value)
    with pytest.raises(ValueError, match=message):
        kernels.depth_contrast(*arguments)


@pytest.mark.parametrize("place", [0, 1, 2, (3, 0)])
def test_native_refuses_other_types(place: Place) -> None:
    """No argument is converted."""
    arguments = case(0)
    arguments = with_argument(arguments, place, argument(arguments, place).astype(np.float16))
    with pytest.raises(TypeError, match="float16"):
        _core.depth_contrast(*arguments)


def test_native_refuses_other_layouts() -> None:
    """Pixels that aren't packed, and states that aren't contiguous, are named, not copied."""
    depth, camera, each, *others = case(0)
    with pytest.raises(ValueError, match="depth: expected packed pixels"):
        _core.depth_contrast(np.ones((4, 8), np.float32)[:, ::2], camera, each, *others)
    with pytest.raises(ValueError, match="states: expected a C-contiguous"):
        _core.depth_contrast(depth, camera, each[::2], *others)
