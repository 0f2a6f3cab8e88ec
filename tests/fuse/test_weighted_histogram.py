# SPDX-License-Identifier: MIT
"""Histograms of flow and disparity, weighted by reliability."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import binned_statistic
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]
Case = dict[str, Any]
EPS = float(np.finfo(np.float64).eps)
STRANGE = np.array([np.nan, np.inf, -np.inf, -1, 0, -0.0, 1e-45, 3e38], np.float32)

shapes = st.tuples(st.integers(0, 5), st.integers(0, 70))
corners = st.floats(-5, 80) | st.integers(-3, 75).map(float)
limits = st.tuples(st.floats(-8, 8), st.floats(-8, 8)).filter(lambda pair: pair[0] != pair[1]).map(sorted)


def plane(shape: tuple[int, int], seed: int, *, low: float = -4.0, high: float = 4.0) -> Plane:
    """Numbers beyond [low, high) too, a fifth of them strange."""
    rng = np.random.default_rng(seed)
    values = rng.uniform(low - 1, high + 1, shape).astype(np.float32)
    strange = rng.random(shape) < 0.2
    values[strange] = rng.choice(STRANGE, shape)[strange]
    return values


def case(shape: tuple[int, int] = (30, 40), seed: int = 0, **changes: Any) -> Case:
    """Arguments of `weighted_histogram`: all of two planes, as the tracker's u has them."""
    height, width = shape
    arguments: Case = {
        "values": plane(shape, seed),
        "weights": plane(shape, seed + 1, low=0.0, high=1.0),
        "region": (0, 0, width, height),
        "low": -4.0,
        "high": 4.0,
        "bins": 64,
        "mask": None,
    }
    return arguments | changes


def assert_same(arguments: Case) -> None:
    """All weights are positive: a sum of n is off by n roundings at most, in either order."""
    native, twin = (k.weighted_histogram(**arguments) for k in (_core, reference))
    assert native.dtype == twin.dtype == np.float64
    assert native.shape == twin.shape == (arguments["bins"],)
    assert_allclose(native, twin, rtol=2 * max(arguments["values"].size, 1) * EPS, atol=0)


@given(
    shapes,
    st.integers(0, 2**32),
    st.tuples(corners, corners, corners, corners),
    limits,
    st.integers(1, 300) | st.just(65536),
    st.booleans(),
)
def test_twin_sums_the_same(
    shape: tuple[int, int],
    seed: int,
    region: tuple[float, float, float, float],
    limits: tuple[float, float],
    bins: int,
    masked: bool,
) -> None:
    """Native and reference agree for any planes, region, range and mask."""
    mask = np.random.default_rng(seed).integers(0, 2, shape, np.uint8) if masked else None
    low, high = limits
    assert_same(case(shape, seed, region=region, low=low, high=high, bins=bins, mask=mask))


@given(arrays(np.float32, st.tuples(st.integers(1, 3), st.integers(1, 40))), limits, st.integers(1, 99))
def test_twin_sums_any_values_the_same(values: Plane, limits: tuple[float, float], bins: int) -> None:
    """So they do for all floats there are."""
    low, high = limits
    assert_same(
        case(values.shape, values=values, weights=np.ones_like(values), low=low, high=high, bins=bins)
    )


def test_twin_sums_views_the_same() -> None:
    """They agree on parts of larger planes, whose rows are padded, each otherwise."""
    values, weights = plane((60, 200), 0)[3:50, 7:150], plane((47, 170), 1, low=0)[:, 20:163]
    mask = np.random.default_rng(2).integers(0, 2, (50, 160), np.uint8)[1:48, 5:148]
    assert_same(case((47, 143), values=values, weights=weights, mask=mask, region=(3, 2, 140, 45)))


@pytest.mark.parametrize("bins", [1, 2, 64, 4096])
def test_agrees_with_scipy(kernels: Kernels, bins: int) -> None:
    """With limits and widths that binary numbers hold exactly SciPy sums the same weights."""
    arguments = case((50, 60), 3, bins=bins)
    values, weights = arguments["values"].astype(float), arguments["weights"].astype(float)
    counted = (values >= -4) & (values < 4) & (weights > 0) & np.isfinite(weights)
    expected = binned_statistic(values[counted], weights[counted], "sum", bins, (-4, 4)).statistic
    assert_allclose(kernels.weighted_histogram(**arguments), expected, rtol=3000 * EPS)


def test_example_by_hand(kernels: Kernels) -> None:
    """Lower limits belong to their bins, high to none; a weight of NaN, 0, infinity or below 0 is none."""
    values = np.array([[0, 0.5, 0.99, 1, 1.5, 2, np.nan, -0.01], [1] * 8], np.float32)
    weights = np.array([[1, 2, 4, 8, 16, 32, 64, 128], [np.nan, 0, np.inf, -1, 256, 512, 0, 0]], np.float32)
    mask = np.ones((2, 8), np.uint8)
    mask[1, 5] = 0
    histogram = kernels.weighted_histogram(values, weights, (0, 0, 8, 2), 0.0, 2.0, 4, mask)
    assert_array_equal(histogram, [1, 2 + 4, 8 + 256, 16])


@pytest.mark.parametrize(
    ("region", "expected"),
    [
        ((0, 0, 4, 1), [1, 1, 1, 1]),
        ((1, 0, 3, 1), [0, 1, 1, 0]),
        ((-9, -9, 2, 9), [1, 1, 0, 0]),
        ((1.5, 0.5, 2.5, 0.51), [0, 1, 0, 0]),
        ((1.51, 0, 2.51, 1), [0, 0, 1, 0]),
        ((0, 0.51, 4, 1), [0, 0, 0, 0]),
        ((3, 0, 1, 1), [0, 0, 0, 0]),
        ((1e300, -1e300, -1e300, 1e300), [0, 0, 0, 0]),
    ],
)
def test_region(kernels: Kernels, region: Any, expected: list[int]) -> None:
    """Pixels count whose centers lie in the region, its left and top edge included, and in the plane."""
    values = np.arange(4, dtype=np.float32)[None]
    histogram = kernels.weighted_histogram(values, np.ones_like(values), region, 0.0, 4.0, 4)
    assert_array_equal(histogram, expected)


def test_parts_make_the_whole(kernels: Kernels) -> None:
    """Masks that part the plane part the sums, and so do regions side by side, wherever they are cut."""
    arguments = case((40, 50), 5)
    whole = kernels.weighted_histogram(**arguments)
    mask = np.random.default_rng(0).integers(0, 2, (40, 50), np.uint8)
    masked = [kernels.weighted_histogram(**arguments | {"mask": part}) for part in (mask, 1 - mask)]
    halves = [
        kernels.weighted_histogram(**arguments | {"region": region})
        for region in ((0, 0, 17.3, 40), (17.3, 0, 50, 40))
    ]
    for parts in (masked, halves):
        assert_allclose(parts[0] + parts[1], whole, rtol=4000 * EPS)
        assert parts[0].any()
        assert parts[1].any()


def test_all_that_counts_is_somewhere(kernels: Kernels) -> None:
    """With a range that holds all values the histogram's sum is that of the weights."""
    rng = np.random.default_rng(8)
    values, weights = (rng.random((31, 43)).astype(np.float32) for _ in range(2))
    arguments = case((31, 43), values=values, weights=weights, low=0.0, high=1.0, bins=7)
    assert_allclose(kernels.weighted_histogram(**arguments).sum(), weights.sum(dtype=float), rtol=1e-12)


@given(st.integers(0, 2**32), st.integers(-20, 20))
def test_units_of_the_weights(seed: int, power: int) -> None:
    """Twice as reliable counts twice."""
    arguments = case((9, 33), seed)
    weights = np.abs(np.nan_to_num(arguments["weights"], posinf=1, neginf=1)).clip(1e-3, 10)
    one, other = (
        _core.weighted_histogram(**arguments | {"weights": weights * np.float32(factor)})
        for factor in (1, 2.0**power)
    )
    assert_array_equal(other, 2.0**power * one)


def test_narrowest_range(kernels: Kernels) -> None:
    """Limits so near to each other that there are infinite bins a pixel still count what lies between."""
    values = np.array([[1, np.nextafter(np.float32(1), np.float32(2)), 0]], np.float32)
    arguments = case(
        (1, 3), values=values, weights=np.ones_like(values), low=1.0, high=np.nextafter(1.0, 2.0)
    )
    assert kernels.weighted_histogram(**arguments).sum() == 1


BAD_VALUES: list[tuple[Case, str]] = [
    ({"weights": np.ones((2, 3), np.float32)}, r"weights: expected shape \(3, 3\), got \(2, 3\)"),
    ({"mask": np.ones((3, 1), np.uint8)}, r"mask: expected shape \(3, 3\), got \(3, 1\)"),
    ({"region": (0, np.nan, 1, 1)}, "region: expected finite corners, got nan"),
    ({"region": (0, 0, np.inf, 1)}, "region: expected finite corners, got inf"),
    ({"low": np.nan}, "low: expected a finite number, got nan"),
    ({"high": np.inf}, "high: expected a finite number above low, got inf"),
    ({"high": -4.0}, "high: expected a finite number above low, got -4"),
    ({"bins": 0}, "bins: expected 1 to 65536, got 0"),
    ({"bins": 65537}, "bins: expected 1 to 65536, got 65537"),
]


@pytest.mark.parametrize(("changes", "message"), BAD_VALUES)
def test_refuses_values(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        kernels.weighted_histogram(**case((3, 3), **changes))


BAD_ARRAYS: list[tuple[Case, type[Exception], str]] = [
    ({"values": np.ones((3, 3))}, TypeError, r"values: expected a float32 plane \(H, W\), got float64"),
    ({"weights": np.ones((3, 3))}, TypeError, "weights: expected a float32 plane"),
    (
        {"values": np.ones(3, np.float32)},
        ValueError,
        r"values: expected a float32 plane \(H, W\), got float32",
    ),
    ({"values": np.ones((3, 6), np.float32)[:, ::2]}, ValueError, "values: expected packed pixels"),
    ({"weights": np.ones((3, 3), np.float32)[::-1]}, ValueError, "weights: expected packed pixels"),
    ({"mask": np.ones((3, 3), np.bool_)}, TypeError, r"mask: expected a uint8 mask \(H, W\), got bool"),
    ({"mask": np.ones((3, 3), np.uint8)[:, ::-1]}, ValueError, "mask: expected packed pixels"),
]


@pytest.mark.parametrize(("changes", "error", "message"), BAD_ARRAYS)
def test_converts_nothing(changes: Case, error: type[Exception], message: str) -> None:
    """Another type, rank or layout is named, never converted."""
    with pytest.raises(error, match=message):
        _core.weighted_histogram(**case((3, 3), **changes))
