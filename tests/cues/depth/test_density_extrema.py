# SPDX-License-Identifier: MIT
"""Maxima and minima of a density."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from scipy.signal import find_peaks
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]

# Few different values make plateaus and ties, many make neither. Those of 32 bits can be scaled exactly.
stairs = arrays(np.float64, st.integers(0, 30), elements=st.integers(0, 4).map(float))
slopes = arrays(np.float64, st.integers(0, 60), elements=st.floats(0, 1, width=32))
prominences = st.sampled_from([0.0, 0.1, 1.0, 2.0, 3.0, np.inf]) | st.floats(0, 1, width=32)


def scipy_maxima(density: Floats, prominence: float) -> Any:
    """What SciPy finds where the density is 0 outside."""
    peaks, _ = find_peaks(np.concatenate([[0.0], density, [0.0]]), prominence=prominence)
    return peaks - 1


@given(stairs | slopes, prominences)
def test_twin_finds_the_same(density: Floats, prominence: float) -> None:
    """Native and reference agree exactly: all is comparisons and one subtraction."""
    native, twin = (k.density_extrema(density, prominence) for k in (_core, reference))
    for ours, theirs in zip(native, twin, strict=True):
        assert ours.dtype == theirs.dtype == np.int64
        assert_array_equal(ours, theirs)


@given(stairs | slopes, prominences)
def test_agrees_with_scipy(density: Floats, prominence: float) -> None:
    """SciPy's find_peaks finds the same maxima, ends, plateaus and ties included."""
    for k in (_core, reference):
        assert_array_equal(k.density_extrema(density, prominence)[0], scipy_maxima(density, prominence))


def test_agrees_with_scipy_on_a_density(kernels: Kernels) -> None:
    """So it does on smooth densities of 256 levels, whose maxima become fewer with the prominence."""
    rng = np.random.default_rng(0)
    density = kernels.depth_density(rng.poisson(3, 256).astype(float), 3.0)
    counts = []
    for prominence in (0, 1e-5, 1e-4, 1e-3, 1):
        maxima, _ = kernels.density_extrema(density, prominence)
        assert_array_equal(maxima, scipy_maxima(density, prominence))
        counts.append(len(maxima))
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[3] > 0 == counts[4]


def test_example_by_hand(kernels: Kernels) -> None:
    """Maxima at both ends, a plateau's middle rounded down, a bump too low, the first of equal minima."""
    density = np.array([5.0, 1, 1, 4, 4, 4, 4, 2, 2.5, 0, 3])
    maxima, minima = kernels.density_extrema(density, 1.0)
    assert_array_equal(maxima, [0, 4, 10])
    assert_array_equal(minima, [1, 9])
    assert_array_equal(kernels.density_extrema(density, 0.5)[0], [0, 4, 8, 10])


def test_prominence_reaches_to_what_is_higher(kernels: Kernels) -> None:
    """The lower of two hills is as prominent as it stands above the pass, the higher as it is high."""
    density = np.array([0.0, 6, 2, 5, 0])
    for prominence, expected in ((3, [1, 3]), (3.5, [1]), (6, [1]), (6.5, [])):
        assert_array_equal(kernels.density_extrema(density, prominence)[0], expected)


@given(stairs | slopes, prominences)
def test_minima_divide(density: Floats, prominence: float) -> None:
    """Each minimum lies between its maxima, lower than both, and nothing between them is lower."""
    maxima, minima = _core.density_extrema(density, prominence)
    assert len(minima) == max(len(maxima) - 1, 0)
    for a, low, b in zip(maxima[:-1], minima, maxima[1:], strict=True):
        assert a < low < b
        assert density[low] < min(density[a], density[b])
        assert density[low] == density[a:b].min()


@given(slopes, prominences, st.integers(-3, 3))
def test_scale(density: Floats, prominence: float, power: int) -> None:
    """A density in other units, and the prominence with it, has its extrema where they were."""
    factor = 2.0**power
    for here, there in zip(
        _core.density_extrema(density, prominence),
        _core.density_extrema(factor * density, factor * prominence),
        strict=True,
    ):
        assert_array_equal(here, there)


@pytest.mark.parametrize("levels", [0, 1, 9])
def test_nothing_there(kernels: Kernels, levels: int) -> None:
    """A density of zeros, or of no levels, has neither maxima nor minima."""
    for found in kernels.density_extrema(np.zeros(levels), 0.0):
        assert found.shape == (0,)


def test_flat(kernels: Kernels) -> None:
    """Equal levels are one plateau, with one maximum in the middle."""
    assert_array_equal(kernels.density_extrema(np.full(8, 0.125), 0.125)[0], [3])


@pytest.mark.parametrize(
    ("density", "prominence", "message"),
    [
        (np.array([0.5, -0.5]), 0.0, "density: expected finite numbers, none negative, got -0.5"),
        (np.array([0.5, np.nan]), 0.0, "density: expected finite numbers, none negative, got nan"),
        (np.array([np.inf]), 0.0, "density: expected finite numbers, none negative, got inf"),
        (np.ones(3), -0.1, "prominence: expected a number of at least 0, got -0.1"),
        (np.ones(3), np.nan, "prominence: expected a number of at least 0, got nan"),
    ],
)
def test_refuses(kernels: Kernels, density: Floats, prominence: float, message: str) -> None:
    """What is no density, and a prominence that is none, is named."""
    with pytest.raises(ValueError, match=message):
        kernels.density_extrema(density, prominence)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones(7, np.float32), TypeError, r"density: expected float64 \(N,\), got float32"),
    (np.ones((7, 1)), ValueError, r"density: expected float64 \(N,\), got float64 \(7, 1\)"),
    (np.ones(7)[::2], ValueError, "density: expected a C-contiguous"),
]


@pytest.mark.parametrize(("density", "error", "message"), BAD)
def test_native_refuses(density: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.density_extrema(density, 0.0)
