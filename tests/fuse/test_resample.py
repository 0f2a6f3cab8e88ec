# SPDX-License-Identifier: MIT
"""Systematic resampling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from tricue import _core, reference
from tricue.kernels import Kernels

weight = st.one_of(st.just(0.0), st.floats(1e-200, 1e200))
some_weights = arrays(np.float64, st.integers(1, 50), elements=weight).filter(np.any)
offsets = st.floats(0, 1, exclude_max=True)


@given(some_weights, offsets)
def test_twin_chooses_the_same(weights: np.ndarray, offset: float) -> None:
    """Native and reference choose the same particles for any weights: both add them up in the same order."""
    assert_array_equal(_core.resample(weights, offset), reference.resample(weights, offset))


def test_example_by_hand(kernels: Kernels) -> None:
    """Teeth at 1/6, 1/2, 5/6 through cumulative weights 1/2, 3/4, 1 choose particles 0, 1, 2."""
    assert_array_equal(kernels.resample(np.array([2.0, 1.0, 1.0]), 0.5), [0, 1, 2])


def test_unbiased(kernels: Kernels) -> None:
    """Averaged over the offset, a particle is chosen N w times: K offsets on a grid get within 1/K of it."""
    weights = np.random.default_rng(3).random(20)
    counts = sum(np.bincount(kernels.resample(weights, (k + 0.5) / 1000), minlength=20) for k in range(1000))
    assert np.abs(counts / 1000 - 20 * weights / weights.sum()).max() <= 1 / 1000


@given(some_weights, offsets)
def test_counts_are_fair(weights: np.ndarray, offset: float) -> None:
    """Indices ascend, a particle without weight is never chosen, the others floor(N w) or ceil(N w) times."""
    chosen = _core.resample(weights, offset)
    counts = np.bincount(chosen, minlength=weights.size)
    expected = weights.size * (weights / weights.max()) / (weights / weights.max()).sum()
    slack = weights.size * weights.size * np.finfo(float).eps  # rounding of the sum, N teeth away
    assert np.all(np.diff(chosen) >= 0)
    assert not counts[weights == 0].any()
    assert np.all((counts >= np.floor(expected - slack)) & (counts <= np.ceil(expected + slack)))


def test_rounding_never_chooses_the_weightless(kernels: Kernels) -> None:
    """The last tooth, pushed past the total by rounding, falls on a particle that has weight."""
    weights = np.append(np.full(49, 0.1), 0.0)
    assert kernels.resample(weights, np.nextafter(1, 0)).max() == 48


BAD = [
    ([], 0.5, "weights: expected a finite sum above 0, got 0"),
    ([0.0, 0.0], 0.5, "weights: expected a finite sum above 0, got 0"),
    ([1e308, 1e308], 0.5, "weights: expected a finite sum above 0, got inf"),
    ([1.0, -1.0], 0.5, "weights: expected finite numbers, none negative, got -1"),
    ([1.0, np.nan], 0.5, "weights: expected finite numbers, none negative, got nan"),
    ([1.0, np.inf], 0.5, "weights: expected finite numbers, none negative, got inf"),
    ([1.0], 1.0, r"offset: expected a number in \[0, 1\), got 1"),
    ([1.0], -0.25, r"offset: expected a number in \[0, 1\), got -0.25"),
    ([1.0], np.nan, r"offset: expected a number in \[0, 1\), got nan"),
]


@pytest.mark.parametrize(("weights", "offset", "message"), BAD)
def test_refuses_values(kernels: Kernels, weights: list[float], offset: float, message: str) -> None:
    """Weights that are no weights and offsets outside [0, 1) are named."""
    with pytest.raises(ValueError, match=message):
        kernels.resample(np.array(weights, np.float64), offset)


@pytest.mark.parametrize(
    ("weights", "error", "message"),
    [
        ([1.0], TypeError, r"weights: expected a NumPy array, float64 \(N,\), got list"),
        (np.ones(3, np.float32), TypeError, r"weights: expected float64 \(N,\), got float32 \(3,\)"),
        (np.ones(3, ">f8"), TypeError, "weights: expected float64"),
        (np.ones((3, 1)), ValueError, r"weights: expected float64 \(N,\), got float64 \(3, 1\)"),
        (np.ones(6)[::2], ValueError, "weights: expected a C-contiguous"),
        (np.ones(6)[::-1], ValueError, "weights: expected a C-contiguous"),
        (np.frombuffer(bytes(25), np.float64, 3, 1), ValueError, "weights: expected a C-contiguous, aligned"),
    ],
)
def test_converts_nothing(weights: object, error: type[Exception], message: str) -> None:
    """Other types, ranks and layouts are named, never converted."""
    with pytest.raises(error, match=message):
        _core.resample(weights, 0.5)  # type: ignore[arg-type]
