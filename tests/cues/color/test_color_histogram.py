# SPDX-License-Identifier: MIT
"""Color histograms of samples."""

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

Image = NDArray[np.uint8]
DIVISORS = [1, 2, 4, 8, 16, 32, 64, 128, 256]
some_samples = arrays(np.uint8, st.tuples(st.integers(0, 3), st.just(3), st.integers(1, 20)))


@given(some_samples, st.sampled_from(DIVISORS))
def test_twin_counts_the_same(samples: Image, bins: int) -> None:
    """Native and reference agree to the last bit: whole counts, one division, one rounding."""
    assert_array_equal(_core.color_histogram(samples, bins), reference.color_histogram(samples, bins))


@pytest.mark.parametrize("bins", DIVISORS)
def test_agrees_with_opencv(kernels: Kernels, samples: Image, bins: int) -> None:
    """OpenCV's calcHist of each plane counts the same; the result is float32 (N, 3 bins)."""
    histograms = kernels.color_histogram(samples, bins)
    assert histograms.dtype == np.float32
    assert histograms.shape == (len(samples), 3 * bins)
    for row, planes in zip(histograms, samples, strict=True):
        counts = [cv2.calcHist([plane], [0], None, [bins], [0, 256]).ravel() for plane in planes]
        assert_allclose(row * samples.shape[2], np.concatenate(counts), rtol=1e-6)


def test_example_by_hand(kernels: Kernels) -> None:
    """Levels 0, 127, 128, 255 in two bins: the border between them is 128."""
    samples = np.array([[[0, 127, 128, 255], [0, 127, 127, 127], [128, 255, 255, 200]]], np.uint8)
    assert_array_equal(kernels.color_histogram(samples, 2), [[0.5, 0.5, 1, 0, 0, 1]])


def test_sums_to_one(kernels: Kernels, samples: Image) -> None:
    """Each channel's bins sum to 1 within the rounding of 64 floats."""
    sums = kernels.color_histogram(samples, 64).reshape(-1, 64).sum(axis=1, dtype=np.float64)
    assert_allclose(sums, 1, rtol=0, atol=64 * np.finfo(np.float32).eps)


def test_order_does_not_matter(kernels: Kernels, samples: Image) -> None:
    """Samples read the other way round have the same histogram."""
    turned = np.ascontiguousarray(samples[:, :, ::-1])
    assert_array_equal(kernels.color_histogram(samples, 16), kernels.color_histogram(turned, 16))


def test_bins_nest(kernels: Kernels, samples: Image) -> None:
    """Half as many bins hold what two neighbors of the finer histogram hold together."""
    fine, coarse = kernels.color_histogram(samples, 64), kernels.color_histogram(samples, 32)
    assert_allclose(fine[:, ::2] + fine[:, 1::2], coarse, rtol=1e-6)


@pytest.mark.parametrize("bins", [-16, 0, 3, 24, 512])
def test_refuses_uneven_bins(kernels: Kernels, bins: int) -> None:
    """Bins that don't divide 256 are an error that says so."""
    with pytest.raises(ValueError, match=f"bins: expected a divisor of 256, got {bins}"):
        kernels.color_histogram(np.zeros((1, 3, 4), np.uint8), bins)


def test_refuses_no_samples(kernels: Kernels) -> None:
    """Ellipses without samples have no histogram."""
    with pytest.raises(ValueError, match="samples: expected at least one for each ellipse, got none"):
        kernels.color_histogram(np.zeros((2, 3, 0), np.uint8), 16)


BAD: list[tuple[Any, type[Exception], str]] = [
    ([[[1], [2], [3]]], TypeError, "samples: expected a NumPy array"),
    (np.zeros((1, 3, 4)), TypeError, r"samples: expected uint8 samples \(N, 3, n\), got float64"),
    (np.zeros((3, 4), np.uint8), ValueError, "samples: expected uint8 samples"),
    (np.zeros((1, 4, 4), np.uint8), ValueError, "samples: expected uint8 samples"),
    (np.zeros((1, 3, 8), np.uint8)[:, :, ::2], ValueError, "samples: expected a C-contiguous"),
]


@pytest.mark.parametrize(("samples", "error", "message"), BAD)
def test_native_refuses(samples: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.color_histogram(samples, 16)
