# SPDX-License-Identifier: MIT
"""Rank maps, of which the first learns."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Singles = NDArray[np.float32]


def case(seed: int, maps: int = 2, n: int = 20) -> tuple[Singles, Singles]:
    """Rank maps, and ranks that are seen."""
    rng = np.random.default_rng(seed)
    return rng.random((maps, 3, n), np.float32), rng.random((3, n), np.float32)


@given(st.integers(0, 2**32), st.integers(1, 4), st.integers(1, 100), st.floats(0, 1))
def test_twin_learns_the_same(seed: int, maps: int, n: int, rate: float) -> None:
    """Bit for bit: both round after each of three operations."""
    native, twin = (k.learn_ranks(*case(seed, maps, n), rate) for k in (_core, reference))
    assert native.dtype == twin.dtype == np.float32
    assert_array_equal(native, twin)


@given(st.integers(0, 2**32), st.floats(0, 1))
def test_only_the_first_map_moves(seed: int, rate: float) -> None:
    """By the rate, of the way to the ranks, to three roundings of numbers up to 1; arguments stay."""
    models, ranks = case(seed)
    before = models.copy()
    for k in (_core, reference):
        learned = k.learn_ranks(models, ranks, rate)
        expected = (1 - rate) * models[0].astype(float) + rate * ranks
        assert_allclose(learned[0], expected, rtol=0, atol=3 * np.finfo(np.float32).eps)
        assert_array_equal(learned[1], models[1])
        assert_array_equal(models, before)


def test_a_rate_of_0_learns_nothing(kernels: Kernels) -> None:
    """All maps stay, bit for bit."""
    models, ranks = case(3)
    assert_array_equal(kernels.learn_ranks(models, ranks, 0.0), models)


BAD: list[tuple[int, Any, str]] = [
    (0, np.zeros((0, 3, 20), np.float32), "models: expected at least one rank map, got none"),
    (0, np.zeros((2, 3, 19), np.float32), "models: expected float32"),
    (2, 1.1, r"rate: expected a number in \[0, 1\], got 1.1"),
    (2, np.nan, r"rate: expected a number in \[0, 1\], got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: int, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    arguments: list[Any] = [*case(0), 0.5]
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        kernels.learn_ranks(*arguments)


@pytest.mark.parametrize("place", [0, 1])
def test_native_refuses_other_types(place: int) -> None:
    """No array is converted."""
    arguments: list[Any] = [*case(0), 0.5]
    arguments[place] = arguments[place].astype(np.float64)
    with pytest.raises(TypeError, match="float64"):
        _core.learn_ranks(*arguments)
