# SPDX-License-Identifier: MIT
"""Joint color histograms."""

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
BINS = [1, 2, 4, 8, 16, 32, 64]


@given(arrays(np.uint8, st.tuples(st.integers(0, 3), st.just(3), st.integers(0, 20))), st.sampled_from(BINS))
def test_twin_counts_the_same(samples: Image, bins: int) -> None:
    """They agree to one rounding: whole counts, one division (float32 against float64)."""
    native, twin = _core.joint_histogram(samples, bins), reference.joint_histogram(samples, bins)
    assert_allclose(native, twin, rtol=np.finfo(np.float32).eps)


@pytest.mark.parametrize("bins", BINS)
def test_agrees_with_opencv(kernels: Kernels, samples: Image, bins: int) -> None:
    """OpenCV's calcHist of the three planes counts the same."""
    histograms = kernels.joint_histogram(samples, bins)
    assert histograms.shape == (len(samples), bins**3)
    for row, planes in zip(histograms, samples, strict=True):
        counts = cv2.calcHist(list(planes[:, None]), [0, 1, 2], None, 3 * [bins], 3 * [0, 256])
        assert_allclose(row * samples.shape[2], counts.ravel(), rtol=1e-6, atol=1e-6)


def test_order_does_not_matter(kernels: Kernels, samples: Image) -> None:
    """Samples read the other way round have the same histogram, of sum 1."""
    histograms = kernels.joint_histogram(samples, 8)
    assert_array_equal(kernels.joint_histogram(np.ascontiguousarray(samples[:, :, ::-1]), 8), histograms)
    assert_allclose(histograms.sum(axis=1, dtype=np.float64), 1, atol=1e-5)


def test_no_samples_have_an_empty_histogram(kernels: Kernels) -> None:
    """Without samples all cells are 0, not NaN."""
    assert_array_equal(kernels.joint_histogram(np.zeros((2, 3, 0), np.uint8), 4), np.zeros((2, 64)))


@pytest.mark.parametrize("bins", [-1, 0, 3, 128])
def test_refuses_other_bins(kernels: Kernels, bins: int) -> None:
    """Bins that are no power of two up to 64 are an error that says so."""
    with pytest.raises(ValueError, match=f"bins: expected a power of two from 1 to 64, got {bins}"):
        kernels.joint_histogram(np.zeros((1, 3, 4), np.uint8), bins)
