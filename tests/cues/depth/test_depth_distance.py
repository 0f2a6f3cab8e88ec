# SPDX-License-Identifier: MIT
"""Distance between the depths in a rectangle and a model."""

from typing import Any

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


def places(side: int) -> Floats:
    """The middles of side x side equal parts of the rectangle."""
    at = (2 * np.arange(side) + 1) / side - 1
    u, v = np.meshgrid(at, at)
    return np.stack([u.ravel(), v.ravel()], axis=1)


def image(shape: tuple[int, int], seed: int) -> Depth:
    """Depths about 3 m, and every kind of pixel without one."""
    rng = np.random.default_rng(seed)
    depth = rng.normal(3, 0.5, shape).astype(np.float32)
    missing = rng.random(shape) < 0.2
    depth[missing] = rng.choice(np.array([np.nan, 0, -1, np.inf, -np.inf], np.float32), shape)[missing]
    return depth


def case(seed: int, rectangles: int = 5, n: int = 30, levels: int = 16, reach: float = 0.8) -> list[Any]:
    """All arguments: an image, rectangles in, across and outside it, a model of sum 1, a pattern."""
    rng = np.random.default_rng(seed)
    depth = image((int(rng.integers(0, 40)), int(rng.integers(1, 60))), seed)
    corners, sizes = rng.uniform(-10, 60, (rectangles, 2)), rng.uniform(0, 30, (rectangles, 2))
    each = np.column_stack([corners, sizes, rng.normal(3, 0.3, rectangles)])
    model = rng.dirichlet(np.ones(levels))
    return [depth, each, (model, reach), rng.uniform(-1, 1, (n, 2)), 0.1]


@given(
    st.integers(0, 2**32),
    st.integers(0, 9),
    st.integers(1, 200),
    st.integers(1, 70),
    st.floats(0.01, 5),
)
def test_twin_measures_the_same(seed: int, rectangles: int, n: int, levels: int, reach: float) -> None:
    """Counts agree exactly. Distances are off by the order of a sum over the levels, and three roundings, and
    by two roundings of the shares, at most 1 in sum, which are subtracted: alike ones leave nothing else.
    """
    arguments = case(seed, rectangles, n, levels, reach)
    native, twin = (k.depth_distance(*arguments) for k in (_core, reference))
    assert native.shape == (rectangles, 3)
    assert_array_equal(native[:, 1:], twin[:, 1:])
    assert_allclose(native[:, 0], twin[:, 0], rtol=(levels + 3) * EPS, atol=2 * EPS)


@pytest.mark.parametrize("view", [np.s_[3:40, 5:50], np.s_[:1, :1], np.s_[:1], np.s_[:, :1], np.s_[::2]])
def test_odd_images(view: Any) -> None:
    """Padded rows, one pixel, one row, one column, every second row: read by both alike."""
    _, *others = case(3, rectangles=20)
    depth = image((60, 90), 0)[view]
    native, twin = (k.depth_distance(depth, *others) for k in (_core, reference))
    assert_array_equal(native[:, 1:], twin[:, 1:])
    assert_allclose(native, twin, rtol=20 * EPS)


@pytest.mark.parametrize("levels", [1, 2, 7, 64, 256])
def test_agrees_with_numpy(kernels: Kernels, levels: int) -> None:
    """On a rectangle of whole pixels, one place a pixel, the histogram is NumPy's, the distance its norm over
    sqrt 2.
    """
    depth = image((12, 12), 4)
    rng = np.random.default_rng(levels)
    model = rng.dirichlet(np.ones(levels))
    rectangle = np.array([[6.0, 6, 12, 12, 3.1]])
    ((distance, counted, nearer),) = kernels.depth_distance(depth, rectangle, (model, 0.7), places(12), 0.2)
    z = depth[(depth > 0) & (depth < np.inf)].astype(float)
    near = z[(z >= 3.1 - 0.7) & (z < 3.1 + 0.7)]
    counts, _ = np.histogram(near - 3.1, levels, (-0.7, 0.7))
    assert_allclose(distance, np.linalg.norm(counts / len(near) - model) * ROOT_HALF, rtol=1e-12)
    assert counted == len(near) / 144
    assert nearer == np.count_nonzero(z < 3.1 - 0.2) / 144


def test_example_by_hand(kernels: Kernels) -> None:
    """Of four pixels one is unmeasured, one far behind, one nearer, one at z: half count, in two levels."""
    depth = np.array([[np.nan, 9.0], [1.75, 2.0]], np.float32)
    rectangle = np.array([[1.0, 1.0, 2.0, 2.0, 2.0]])
    model = np.array([0.0, 0.5, 0.5, 0.0])
    args = (depth, rectangle, (model, 0.5), places(2))
    assert_array_equal(kernels.depth_distance(*args, 0.125), [[0, 0.5, 0.25]])
    assert_array_equal(kernels.depth_distance(*args, 0.25), [[0, 0.5, 0]])
    farther = rectangle + [0, 0, 0, 0, 0.25]  # -0.5 and -0.25 are the levels 0 and 1
    expected = np.sqrt(0.5**2 + 0.5**2) * ROOT_HALF
    assert_allclose(
        kernels.depth_distance(depth, farther, *args[2:], 0.25), [[expected, 0.5, 0.25]], rtol=1e-15
    )


def test_reach_is_half_open(kernels: Kernels) -> None:
    """A depth of z - reach counts, in the first level, z + reach doesn't."""
    rectangle = np.array([[0.5, 0.5, 1, 1, 2.0]])
    first = np.array([1.0, 0, 0])
    for z, expected in ((1.5, [0, 1, 0]), (2.5, [1, 0, 0]), (1.25, [1, 0, 1])):
        measured = kernels.depth_distance(
            np.full((1, 1), z, np.float32), rectangle, (first, 0.5), np.zeros((1, 2)), 0.5
        )
        assert_array_equal(measured, [expected])


def test_unseen(kernels: Kernels) -> None:
    """Outside the image, in one of no pixels, or of no measurement the distance is 1, the shares 0."""
    model, pattern = (np.array([0.5, 0.5]), 0.5), places(3)
    inside = np.array([[4.0, 4, 6, 6, 2]])
    for depth, rectangle in (
        (np.full((8, 8), 2, np.float32), inside + [30, 0, 0, 0, 0]),
        (np.full((8, 8), 2, np.float32), inside - [0, 1e300, 0, 0, 0]),
        (np.full((8, 8), np.nan, np.float32), inside),
        (np.zeros((0, 8), np.float32), inside),
        (np.zeros((8, 0), np.float32), inside),
    ):
        assert_array_equal(kernels.depth_distance(depth, rectangle, model, pattern, 0.1), [[1, 0, 0]])


def test_edge_of_the_image(kernels: Kernels) -> None:
    """A place at -0.25 is outside, not in pixel 0; one at 0 is in it; one at the width is outside."""
    depth = np.full((1, 4), 2, np.float32)
    model, pattern = (np.ones(1), 0.5), np.zeros((1, 2))
    for x, seen in ((-0.25, 0), (0, 1), (3.75, 1), (4, 0)):
        rectangle = np.array([[x, 0.5, 1, 1, 2]])
        assert kernels.depth_distance(depth, rectangle, model, pattern, 0.1)[0, 1] == seen


@given(st.integers(0, 2**32), st.integers(-3, 3))
def test_walks_with_the_target(seed: int, step: int) -> None:
    """Depths and z moved by the same number of meters measure the same, as the histogram is relative."""
    rng = np.random.default_rng(seed)
    depth = (rng.integers(1, 1024, (20, 20)) / 128 + 4).astype(np.float32)  # moved without rounding
    rectangles = np.array([[10.0, 9, 12, 15, 8.5], [4, 15, 9, 9, 7.25]])
    model = rng.dirichlet(np.ones(8)), 1.0
    here = _core.depth_distance(depth, rectangles, model, places(9), 0.125)
    there = _core.depth_distance(
        depth + np.float32(step), rectangles + [0, 0, 0, 0, step], model, places(9), 0.125
    )
    assert_array_equal(here, there)


@given(st.integers(0, 2**32))
def test_bounded(seed: int) -> None:
    """All is in [0, 1]; a rectangle's own histogram is at distance 0, one without a common level at 1."""
    depth, rectangles, model, pattern, nearer = case(seed)
    for k in (_core, reference):
        measured = k.depth_distance(depth, rectangles, model, pattern, nearer)
        assert measured.min() >= 0
        assert measured.max() <= 1
    flat, one = np.full((9, 9), 2, np.float32), np.array([[4.5, 4.5, 9, 9, 2]])
    for level, expected in ((2, 0), (1, 1)):
        assert _core.depth_distance(flat, one, (np.eye(4)[level], 1.0), pattern, 0.1)[0, 0] == expected


def test_model_of_nothing(kernels: Kernels) -> None:
    """From a model of zeros the distance is that of the histogram itself: sqrt(1/2) with all in one level."""
    rectangle = np.array([[4.5, 4.5, 9, 9, 2]])
    measured = kernels.depth_distance(
        np.full((9, 9), 2, np.float32), rectangle, (np.zeros(4), 1.0), places(3), 0.1
    )
    assert_allclose(measured, [[ROOT_HALF, 1, 0]], rtol=1e-15)


BAD_VALUES: list[tuple[Place, Any, str]] = [
    (1, np.zeros((2, 4)), r"rectangles: expected shape \(2, 5\), got \(2, 4\)"),
    (1, np.full((2, 5), np.nan), "rectangles: expected finite numbers, got nan"),
    ((2, 0), np.zeros(0), "model: expected at least one level, got none"),
    ((2, 0), np.array([1.5, -0.5]), "model: expected finite numbers, none negative, got -0.5"),
    ((2, 0), np.array([np.nan, 1]), "model: expected finite numbers, none negative, got nan"),
    ((2, 0), np.array([0.5, 0.25]), "model: expected a sum of 1, or of 0, got 0.75"),
    ((2, 0), np.full(2, 1e308), "model: expected a sum of 1, or of 0, got inf"),
    (3, np.zeros((5, 3)), r"pattern: expected shape \(5, 2\), got \(5, 3\)"),
    (3, np.zeros((0, 2)), "pattern: expected at least one place, got none"),
    (3, np.full((2, 2), np.inf), "pattern: expected finite numbers, got inf"),
    ((2, 1), 0.0, "reach: expected a finite number above 0, got 0"),
    ((2, 1), np.nan, "reach: expected a finite number above 0, got nan"),
    (4, -0.1, "occluder_margin: expected a finite number, not negative, got -0.1"),
    (4, np.inf, "occluder_margin: expected a finite number, not negative, got inf"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = with_argument(case(0), place, value)
    with pytest.raises(ValueError, match=message):
        kernels.depth_distance(*arguments)


@pytest.mark.parametrize("place", [0, 1, (2, 0), 3])
def test_native_refuses_other_types(place: Place) -> None:
    """No argument is converted."""
    arguments = case(0)
    arguments = with_argument(arguments, place, argument(arguments, place).astype(np.float16))
    with pytest.raises(TypeError, match="float16"):
        _core.depth_distance(*arguments)


def test_native_refuses_other_layouts() -> None:
    """Pixels that aren't packed, and rectangles that aren't contiguous, are named, not copied."""
    depth, rectangles, *others = case(0)
    with pytest.raises(ValueError, match="depth: expected packed pixels"):
        _core.depth_distance(np.ones((4, 8), np.float32)[:, ::2], rectangles, *others)
    with pytest.raises(ValueError, match="rectangles: expected a C-contiguous"):
        _core.depth_distance(depth, rectangles[::2], *others)
