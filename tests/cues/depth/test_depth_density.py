# SPDX-License-Identifier: MIT
"""Kernel density of depth levels."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
EPS = float(np.finfo(np.float64).eps)

histograms = arrays(np.float64, st.integers(1, 40), elements=st.floats(0, 1e6))


def radius(bandwidth: float) -> int:
    """Where the kernel is cut."""
    return int(np.ceil(4 * bandwidth))


def rounding(levels: int, bandwidth: float) -> float:
    """Relative bound: sums of positive numbers, a rounding a term, of the histogram, of the kernel, of their
    products; exp and its argument, which is at most 8 or so after ten roundings.
    """
    return (levels + 2 * (2 * radius(bandwidth) + 1) + 100) * EPS


@given(histograms, st.floats(0.05, 1))
def test_twin_smooths_the_same(histogram: Floats, share: float) -> None:
    """Native and reference agree for any bandwidth up to the number of levels, within the order of sums."""
    bandwidth = share * len(histogram)
    native, twin = (k.depth_density(histogram, bandwidth) for k in (_core, reference))
    assert native.dtype == np.float64
    assert_allclose(native, twin, rtol=rounding(len(histogram), bandwidth), atol=1e-300)


@pytest.mark.parametrize("bandwidth", [0.01, 0.3, 1, 2.5, 7.3, 40, 256])
def test_agrees_with_scipy(kernels: Kernels, bandwidth: float) -> None:
    """SciPy's Gaussian filter, cut at the same level and reflected, gives the same."""
    histogram = np.random.default_rng(0).poisson(np.linspace(0, 30, 256) % 7).astype(float)
    truth = gaussian_filter1d(
        histogram / histogram.sum(), bandwidth, mode="reflect", radius=radius(bandwidth)
    )
    assert_allclose(
        kernels.depth_density(histogram, bandwidth), truth, rtol=2 * rounding(256, bandwidth), atol=1e-300
    )


def test_example_by_hand(kernels: Kernels) -> None:
    """At the end a quarter level's kernel (e^-8, 1, e^-8) puts what falls over back on the first level."""
    tail = np.exp(-8)
    density = kernels.depth_density(np.array([5.0, 0, 0, 0]), 0.25)
    assert_allclose(density, np.array([1 + tail, tail, 0, 0]) / (1 + 2 * tail), rtol=1e-14)


def test_spread_of_a_peak(kernels: Kernels) -> None:
    """One level far from the ends becomes a Gaussian of the bandwidth, but for what the cut at 4 takes."""
    peak = np.zeros(201)
    peak[100] = 3
    density, levels = kernels.depth_density(peak, 10), np.arange(201) - 100
    inside = np.abs(levels) <= 40
    assert_allclose(density[inside], np.exp(-(levels[inside] ** 2) / 200) / np.sqrt(200 * np.pi), rtol=1e-4)
    assert_array_equal(density[~inside], 0)


@given(histograms, st.floats(0.05, 1))
def test_sum_is_one(histogram: Floats, share: float) -> None:
    """Nothing is lost at the ends, and the pixels' number doesn't matter; zeros stay zeros."""
    for k in (_core, reference):
        density = k.depth_density(histogram, share * len(histogram))
        assert density.min() >= 0
        if histogram.sum() > 0:
            assert abs(density.sum() - 1) <= 2 * rounding(len(histogram), share * len(histogram))
        else:
            assert_array_equal(density, np.zeros(len(histogram)))


def test_mirror(kernels: Kernels) -> None:
    """A mirrored histogram has the mirrored density."""
    histogram = np.random.default_rng(1).random(50)
    density = kernels.depth_density(histogram, 3.0)
    mirrored = kernels.depth_density(np.ascontiguousarray(histogram[::-1]), 3.0)
    assert_allclose(density[::-1], mirrored, rtol=rounding(50, 3))


def test_flat_stays_flat(kernels: Kernels) -> None:
    """Equal levels stay equal, whatever the bandwidth, also where the kernel is wider than the range."""
    for bandwidth in (0.5, 3, 9):
        assert_allclose(kernels.depth_density(np.full(9, 4.0), bandwidth), np.full(9, 1 / 9), rtol=1e-13)


@pytest.mark.parametrize(
    ("histogram", "bandwidth", "message"),
    [
        (np.zeros(0), 1.0, "histogram: expected at least one level, got none"),
        (np.array([1.0, -2, 3]), 1.0, "histogram: expected finite numbers, none negative, got -2"),
        (np.array([1.0, np.nan]), 1.0, "histogram: expected finite numbers, none negative, got nan"),
        (np.array([1.0, np.inf]), 1.0, "histogram: expected finite numbers, none negative, got inf"),
        (np.full(2, 1e308), 1.0, "histogram: expected a finite sum, got inf"),
        (np.ones(7), 0.0, r"bandwidth: expected a number in \(0, 7\], got 0"),
        (np.ones(7), 7.5, r"bandwidth: expected a number in \(0, 7\], got 7.5"),
        (np.ones(7), np.nan, r"bandwidth: expected a number in \(0, 7\], got nan"),
    ],
)
def test_refuses(kernels: Kernels, histogram: Floats, bandwidth: float, message: str) -> None:
    """What is no histogram, and a bandwidth that is none or wider than the range, is named."""
    with pytest.raises(ValueError, match=message):
        kernels.depth_density(histogram, bandwidth)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones(7, np.float32), TypeError, r"histogram: expected float64 \(N,\), got float32"),
    (np.ones((7, 1)), ValueError, r"histogram: expected float64 \(N,\), got float64 \(7, 1\)"),
    (np.ones(7)[::2], ValueError, "histogram: expected a C-contiguous"),
]


@pytest.mark.parametrize(("histogram", "error", "message"), BAD)
def test_native_refuses(histogram: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.depth_density(histogram, 1.0)
