# SPDX-License-Identifier: MIT
"""Bhattacharyya distance of histograms."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float32]
ROUNDING = float(np.finfo(np.float32).eps)  # of histograms that are stored as float32


def random_histograms(rows: int, groups: int, bins: int, seed: int = 0) -> Floats:
    """Rows of histograms, many bins empty, each of sum 1."""
    rng = np.random.default_rng(seed)
    counts = rng.poisson(0.7, (rows, groups, bins)) + np.eye(bins)[rng.integers(0, bins, (rows, groups))]
    shares = counts / counts.sum(axis=2, keepdims=True)
    histograms: Floats = shares.reshape(rows, groups * bins).astype(np.float32)
    return histograms


@given(
    arrays(np.float32, (4, 12), elements=st.floats(0, 1, width=32)),
    arrays(np.float32, 12, elements=st.floats(0, 1, width=32)),
    st.sampled_from([1, 2, 3, 4, 6, 12]),
)
def test_twin_measures_the_same(histograms: Floats, model: Floats, groups: int) -> None:
    """Native and reference agree; squares are compared, as the root enlarges errors where the distance is 0.

    The sums, of up to 12 terms of at most 1, are rounded in another order.
    """
    native = _core.bhattacharyya(histograms, model, groups)
    twin = reference.bhattacharyya(histograms, model, groups)
    assert_allclose(native**2, twin**2, rtol=0, atol=12 * 12 * np.finfo(float).eps)


@pytest.mark.parametrize("bins", [1, 7, 8, 16, 37])
@pytest.mark.parametrize("rows", [0, 1, 100])
def test_twin_measures_the_same_at_every_size(rows: int, bins: int) -> None:
    """They agree for rows that aren't a multiple of a vector, and for no rows."""
    histograms = random_histograms(rows, 3, bins)
    model = random_histograms(1, 3, bins, seed=1)[0]
    native = _core.bhattacharyya(histograms, model, 3)
    assert_allclose(native**2, reference.bhattacharyya(histograms, model, 3) ** 2, rtol=0, atol=1e-14)


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """OpenCV gives the same for one histogram; it divides by the sums, 1 within rounding."""
    histograms = random_histograms(20, 1, 16)
    baseline = [
        cv2.compareHist(histogram, histograms[0], cv2.HISTCMP_BHATTACHARYYA) for histogram in histograms
    ]
    ours = kernels.bhattacharyya(histograms, histograms[0], 1)
    assert_allclose(ours**2, np.square(baseline), rtol=0, atol=16 * ROUNDING)


def test_two_bins_in_closed_form(kernels: Kernels) -> None:
    """(cos^2 a, sin^2 a) and (cos^2 b, sin^2 b) are sqrt(1 - cos(a - b)) apart."""
    a, b = np.linspace(0, np.pi / 2, 9), 0.4
    histograms = np.column_stack([np.cos(a) ** 2, np.sin(a) ** 2]).astype(np.float32)
    model = np.array([np.cos(b) ** 2, np.sin(b) ** 2], np.float32)
    expected = 1 - np.cos(a - b)
    assert_allclose(kernels.bhattacharyya(histograms, model, 1) ** 2, expected, rtol=0, atol=4 * ROUNDING)


def test_same_and_disjoint(kernels: Kernels) -> None:
    """A histogram is 0 from itself, and 1 from one that it shares no bin with."""
    histograms = np.array([[1, 0, 0.5, 0.5, 0, 0], [0, 1, 0, 0, 0.25, 0.75]], np.float32)
    assert_array_equal(kernels.bhattacharyya(histograms, histograms[0], 2), [0, 1])


def test_groups_are_averaged(kernels: Kernels) -> None:
    """One of two groups alike, the other disjoint: the square is one half."""
    histograms = np.array([[0.5, 0.5, 1, 0]], np.float32)
    model = np.array([0.5, 0.5, 0, 1], np.float32)
    assert_allclose(kernels.bhattacharyya(histograms, model, 2), np.sqrt(0.5), rtol=1e-15)


def test_symmetric_and_bounded(kernels: Kernels) -> None:
    """Either histogram may be the model; distances lie in [0, 1], also where sums exceed 1."""
    histograms = random_histograms(30, 3, 16)
    forth = np.array([kernels.bhattacharyya(histograms, model, 3) for model in histograms])
    assert_allclose(forth, forth.T, rtol=0, atol=1e-15)
    assert forth.min() >= 0
    assert forth.max() <= 1
    assert_array_equal(kernels.bhattacharyya(histograms[:1] * np.float32(1.01), histograms[0], 3), [0])


FLAT = np.full((2, 6), 1 / 6, np.float32)
BAD_VALUES: list[tuple[Floats, Floats, int, str]] = [
    (FLAT, FLAT[0, :5], 1, "model: expected 6 bins, as in histograms, got 5"),
    (FLAT, FLAT[0], 4, "groups: expected a divisor of 6, got 4"),
    (FLAT, FLAT[0], 0, "groups: expected a divisor of 6, got 0"),
    (-FLAT, FLAT[0], 3, "histograms: expected finite numbers, none negative"),
    (FLAT, -FLAT[0], 3, "model: expected finite numbers, none negative"),
    (FLAT * np.float32(np.nan), FLAT[0], 3, "histograms: expected finite numbers, none negative"),
    (FLAT, FLAT[0] * np.float32(np.inf), 3, "model: expected finite numbers, none negative"),
]


@pytest.mark.parametrize(("histograms", "model", "groups", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, histograms: Floats, model: Floats, groups: int, message: str) -> None:
    """Widths that differ, groups that don't divide them, and entries that are no histogram's are named."""
    with pytest.raises(ValueError, match=message):
        kernels.bhattacharyya(histograms, model, groups)


BAD_TYPES: list[tuple[Any, Any, type[Exception], str]] = [
    (FLAT.astype(float), FLAT[0], TypeError, r"histograms: expected float32 \(N, K\), got float64"),
    (FLAT, FLAT, ValueError, r"model: expected float32 \(K,\), got float32 \(2, 6\)"),
    (FLAT[:, ::2], FLAT[0], ValueError, "histograms: expected a C-contiguous"),
]


@pytest.mark.parametrize(("histograms", "model", "error", "message"), BAD_TYPES)
def test_native_refuses(histograms: Any, model: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.bhattacharyya(histograms, model, 3)
