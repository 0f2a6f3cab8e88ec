# SPDX-License-Identifier: MIT
"""A color histogram that learns, and its mean color."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

spaces = st.tuples(*[st.integers(1, 12)] * 3)


def two(bins: tuple[int, int, int], seed: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two histograms of sum 1, many bins of which are empty."""
    rng = np.random.default_rng(seed)
    one, other = rng.random((2, int(np.prod(bins)))) * (rng.random((2, int(np.prod(bins)))) < 0.4) + 1e-9
    return one / one.sum(), other / other.sum()


@given(spaces, st.integers(1, 255), st.floats(0, 1), st.floats(0, 1), st.integers(0, 2**32))
def test_twin_learns_the_same(
    bins: tuple[int, int, int], chroma: int, rate: float, weight: float, seed: int
) -> None:
    """Native and reference agree: histogram and model to the last bit, the color within the rounding of sums
    of up to 1728 levels below 766.
    """
    histogram, measured = two(bins, seed)
    arguments = histogram, measured, rate, two(bins, seed + 1)[0], weight, (bins, chroma)
    native, twin = _core.learn_histogram(*arguments), reference.learn_histogram(*arguments)
    assert_array_equal(native[0], twin[0])
    assert_array_equal(native[1], twin[1])
    assert_allclose(native[2], twin[2], rtol=0, atol=1e-10)


@given(spaces, st.floats(0, 1), st.floats(0, 1), st.integers(0, 2**32))
def test_agrees_with_mixtures(bins: tuple[int, int, int], rate: float, weight: float, seed: int) -> None:
    """It is (1 - a) M + a C, the model that mixed with F, both of sum 1, and the color histogram_mean's."""
    (old, new), first = two(bins, seed), two(bins, seed + 1)[0]
    learned, model, color = _core.learn_histogram(old, new, rate, first, weight, (bins, 64))
    assert_allclose(learned, (1 - rate) * old + rate * new, rtol=1e-12, atol=1e-15)
    assert_allclose(model, (1 - weight) * learned + weight * first, rtol=1e-12, atol=1e-15)
    assert learned.sum() == pytest.approx(1, abs=1e-12)
    assert model.sum() == pytest.approx(1, abs=1e-12)
    assert_array_equal(color, _core.histogram_mean(learned, (bins, 64)))


def test_rates_and_weights_of_0_and_1(kernels: Kernels) -> None:
    """A rate of 0 learns nothing, to the last bit; one of 1 forgets everything. A weight of 0 leaves the
    first colors out of the model, one of 1 has nothing else. No argument changes.
    """
    (old, new), first = two((4, 3, 2), 5), two((4, 3, 2), 6)[0]
    kept = old.copy(), new.copy(), first.copy()
    learned, model, _ = kernels.learn_histogram(old, new, 0.0, first, 1.0, ((4, 3, 2), 64))
    assert_array_equal(learned, old)
    assert_array_equal(model, first)
    learned, model, _ = kernels.learn_histogram(old, new, 1.0, first, 0.0, ((4, 3, 2), 64))
    assert_allclose(learned, new, rtol=0, atol=1e-16)
    assert_array_equal(model, learned)
    assert_array_equal((old, new, first), kept)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"histogram": np.ones(7)}, r"histogram: expected shape \(8,\), got \(7,\)"),
    ({"measured": np.ones(9)}, r"measured: expected shape \(8,\), got \(9,\)"),
    ({"first": np.ones(9)}, r"first: expected shape \(8,\), got \(9,\)"),
    ({"weight": 1.5}, "weight: expected 0 to 1, got 1.5"),
    ({"rate": -0.1}, "rate: expected 0 to 1, got -0.1"),
    ({"rate": np.nan}, "rate: expected 0 to 1, got nan"),
    ({"measured": np.full(8, np.nan)}, "histogram: expected finite numbers, got nan"),
    ({"histogram": np.zeros(8), "measured": np.zeros(8)}, "histogram: expected a finite sum above 0, got 0"),
    ({"measured": np.full(8, -9.0)}, "histogram: expected no negative number"),
    ({"space": ((2, 0, 4), 64)}, "bins: expected 1 to 256 on each axis"),
    ({"space": ((2, 2, 2), 0)}, "chroma: expected 1 to 255, got 0"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = {"histogram": np.ones(8), "measured": np.ones(8), "rate": 0.5}
    arguments |= {"first": np.ones(8), "weight": 0.2, "space": ((2, 2, 2), 64)}
    with pytest.raises(ValueError, match=message):
        kernels.learn_histogram(**arguments | changes)
