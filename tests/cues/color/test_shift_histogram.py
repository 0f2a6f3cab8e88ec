# SPDX-License-Identifier: MIT
"""A histogram moved to a given mean."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
spaces = st.tuples(*[st.integers(1, 8)] * 3)
SPACE = (32, 32, 4), 64
WIDTHS = np.array([4.0, 4.0, 766 / 4])


def some_histogram(seed: int, bins: tuple[int, int, int]) -> Floats:
    """Half of the bins empty, but not all."""
    rng = np.random.default_rng(seed)
    histogram = rng.random(int(np.prod(bins))) * (rng.random(int(np.prod(bins))) < 0.5)
    histogram[rng.integers(histogram.size)] += 1
    return histogram


def blob(rows: slice, columns: slice) -> Floats:
    """A histogram of 32 x 32 x 4 bins that ends well before the axes do."""
    histogram = np.zeros((32, 32, 4))
    histogram[rows, columns, 1:3] = np.random.default_rng(0).random(histogram[rows, columns, 1:3].shape)
    return histogram


@given(spaces, st.integers(1, 255), st.integers(0, 2**32), st.floats(-300, 300), st.floats(-500, 1500))
def test_twin_moves_the_same(
    bins: tuple[int, int, int], chroma: int, seed: int, color: float, light: float
) -> None:
    """Native and reference agree wherever the mean is put; a share of a bin is rounded with its offset."""
    arguments = (some_histogram(seed, bins), (bins, chroma), np.array([color, -color / 2, light]))
    native, twin = _core.shift_histogram(*arguments), reference.shift_histogram(*arguments)
    assert_allclose(native, twin, rtol=0, atol=1e-10)


def test_agrees_with_scipy(kernels: Kernels) -> None:
    """Away from the ends it is ndimage.shift with linear interpolation."""
    histogram = blob(slice(8, 20), slice(9, 18))
    offset = np.array([3.3, -2.75, 0.4])
    mean = kernels.histogram_mean(histogram.ravel(), SPACE) + offset * WIDTHS
    shifted = kernels.shift_histogram(histogram.ravel(), SPACE, mean)
    expected = ndimage.shift(histogram, offset, order=1)
    assert_allclose(shifted.reshape(32, 32, 4), expected, rtol=0, atol=1e-12)


def test_example_by_hand(kernels: Kernels) -> None:
    """A quarter of a bin to the right leaves three quarters; what would leave the axis stays in its end."""
    histogram = np.array([0.0, 1, 0, 1])  # bins of 32 levels, means -48.5, -16.5, 15.5, 47.5, so 15.5
    assert_allclose(
        kernels.shift_histogram(histogram, ((4, 1, 1), 64), np.array([23.5, -0.5, 382.5])), [0, 0.75, 0.25, 1]
    )


@settings(max_examples=40)  # the twin is slow
@given(st.integers(0, 2**32))
def test_mean_is_met(seed: int) -> None:
    """A histogram that stays clear of the ends gets the mean that was asked for, and keeps its sum."""
    rng = np.random.default_rng(seed)
    histogram = blob(slice(10, 22), slice(8, 21)).ravel()
    mean = _core.histogram_mean(histogram, SPACE) + rng.uniform(-1, 1, 3) * [28, 28, 190]
    for kernels in (_core, reference):
        shifted = kernels.shift_histogram(histogram, SPACE, mean)
        assert_allclose(kernels.histogram_mean(shifted, SPACE), mean, rtol=0, atol=1e-9)
        assert abs(shifted.sum() - histogram.sum()) < 1e-10


@given(spaces, st.integers(0, 2**32), *[st.floats(-1e6, 1e6)] * 3)
def test_sum_stays(bins: tuple[int, int, int], seed: int, first: float, second: float, third: float) -> None:
    """However far it is moved, over the ends too, no mass is lost and none is negative."""
    histogram = some_histogram(seed, bins)
    shifted = _core.shift_histogram(histogram, (bins, 64), np.array([first, second, third]))
    assert_allclose(shifted.sum(), histogram.sum(), rtol=1e-12)
    assert shifted.min() >= 0


def test_far_away_is_the_end(kernels: Kernels) -> None:
    """A mean far beyond the axes gathers everything in one corner."""
    histogram = some_histogram(1, (5, 4, 3))
    shifted = kernels.shift_histogram(histogram, ((5, 4, 3), 64), np.array([1e300, -1e300, 1e300]))
    assert_array_equal(np.flatnonzero(shifted), [4 * 12 + 0 * 3 + 2])
    assert_allclose(shifted.sum(), histogram.sum())


def test_its_own_mean_leaves_it(kernels: Kernels) -> None:
    """To the mean that it has it isn't moved, but for rounding."""
    histogram = blob(slice(4, 30), slice(5, 29)).ravel()
    mean = kernels.histogram_mean(histogram, SPACE)
    assert_allclose(kernels.shift_histogram(histogram, SPACE, mean), histogram, rtol=0, atol=1e-12)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"histogram": np.ones(7)}, r"histogram: expected shape \(8,\), got \(7,\)"),
    ({"histogram": np.zeros(8)}, "histogram: expected a finite sum above 0, got 0"),
    ({"space": ((2, 2, 300), 64)}, "bins: expected 1 to 256 on each axis"),
    ({"space": ((2, 2, 2), 256)}, "chroma: expected 1 to 255, got 256"),
    ({"mean": np.zeros(2)}, r"mean: expected shape \(3,\), got \(2,\)"),
    ({"mean": np.array([0, np.nan, 0])}, "mean: expected finite numbers, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = {"histogram": np.ones(8), "space": ((2, 2, 2), 64), "mean": np.zeros(3)} | changes
    with pytest.raises(ValueError, match=message):
        kernels.shift_histogram(**arguments)


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=r"mean: expected float64 \(N,\), got int64"):
        _core.shift_histogram(np.ones(8), ((2, 2, 2), 64), np.zeros(3, int))  # type: ignore[arg-type]
