# SPDX-License-Identifier: MIT
"""The mean color of a histogram."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from tricue import _core, reference
from tricue.kernels import Kernels

spaces = st.tuples(*[st.integers(1, 12)] * 3)


@given(spaces, st.integers(1, 255), st.integers(0, 2**32))
def test_twin_measures_the_same(bins: tuple[int, int, int], chroma: int, seed: int) -> None:
    """Native and reference agree within the rounding of sums of up to 1728 levels below 766."""
    histogram = np.random.default_rng(seed).random(int(np.prod(bins))) + 1e-3
    native = _core.histogram_mean(histogram, (bins, chroma))
    assert_allclose(native, reference.histogram_mean(histogram, (bins, chroma)), rtol=0, atol=1e-10)


@pytest.mark.parametrize("seed", range(5))
def test_agrees_with_the_mean_of_pixels(kernels: Kernels, seed: int) -> None:
    """Within half a bin it's the mean of the pixels, and exactly so on an axis of a bin a level."""
    image = np.random.default_rng(seed).integers(90, 120, (20, 30, 3), np.uint8)
    b, g, r = image.reshape(-1, 3).astype(float).T
    truth = np.array([(b - g).mean(), (g - r).mean(), (b + g + r).mean()])
    for bins, chroma in (((32, 32, 4), 64), ((64, 16, 16), 32), ((64, 1, 1), 32), ((1, 64, 1), 32)):
        cells = kernels.color_bins(image, (0, 0, 30, 20), (bins, chroma), 1)
        histogram = np.bincount(cells.ravel(), minlength=int(np.prod(bins))).astype(float)
        width = np.array([2 * chroma, 2 * chroma, 766]) / bins
        error = np.abs(kernels.histogram_mean(histogram, (bins, chroma)) - truth)
        assert np.all(error <= (width - 1) / 2 + 1e-12)


def test_example_by_hand(kernels: Kernels) -> None:
    """Bins of -64..-1 and 0..63, of -64..63, and of 0..382 and 383..765: three quarters in the upper ones."""
    histogram = np.array([1.0, 0, 0, 3])
    assert_allclose(kernels.histogram_mean(histogram, ((2, 1, 2), 64)), [15.5 - 0.0, -0.5, 191 + 0.75 * 383])


@given(spaces, st.integers(0, 2**32), st.floats(1e-6, 1e6))
def test_scale_does_not_matter(bins: tuple[int, int, int], seed: int, scale: float) -> None:
    """Counts and shares have the same mean, and it lies within the axes."""
    histogram = np.random.default_rng(seed).random(int(np.prod(bins))) + 1e-3
    mean = _core.histogram_mean(histogram, (bins, 64))
    assert_allclose(_core.histogram_mean(histogram * scale, (bins, 64)), mean, rtol=0, atol=1e-9)
    assert np.all((mean >= [-64, -64, 0]) & (mean <= [63, 63, 765]))


BAD: list[tuple[dict[str, Any], str]] = [
    ({"histogram": np.ones(7)}, r"histogram: expected shape \(8,\), got \(7,\)"),
    ({"histogram": np.zeros(8)}, "histogram: expected a finite sum above 0, got 0"),
    ({"histogram": np.full(8, 1e308)}, "histogram: expected a finite sum above 0, got inf"),
    ({"histogram": np.full(8, np.nan)}, "histogram: expected finite numbers, got nan"),
    ({"histogram": -np.ones(8)}, "histogram: expected no negative number, got -1"),
    ({"space": ((2, 0, 4), 64)}, "bins: expected 1 to 256 on each axis"),
    ({"space": ((2, 2, 2), 0)}, "chroma: expected 1 to 255, got 0"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.histogram_mean(**{"histogram": np.ones(8), "space": ((2, 2, 2), 64)} | changes)


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=r"histogram: expected float64 \(N,\), got int32"):
        _core.histogram_mean(np.ones(8, np.int32), ((2, 2, 2), 64))  # type: ignore[arg-type]
