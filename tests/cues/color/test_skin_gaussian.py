# SPDX-License-Identifier: MIT
"""A Gaussian of skin's chrominance."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import multivariate_normal
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
MEAN = np.array([110.0, 152.5])
PRECISIONS = {
    "wide": np.array([[0.01, 0.004], [0.004, 0.02]]),
    "narrow": np.array([[0.8, -0.5], [-0.5, 0.6]]),
    "thin": np.array([[0.3, 0.25], [0.25, 0.22]]),
}


@pytest.fixture(params=list(PRECISIONS))
def precision(request: pytest.FixtureRequest) -> Floats:
    """Inverse covariances: wide, narrow, and long and thin."""
    return PRECISIONS[request.param]


def tolerance(precision: Floats, chroma_error: float) -> float:
    """Bound of the error of exp(-d^2/2) in floats, from that of the chrominance and of d^2.

    With the largest eigenvalue L of the precision, an error e of the chrominance changes d by sqrt(L) e at
    most, and d exp(-d^2/2) is below 0.61. The terms of d^2 sum to at most K d^2, K the condition number, each
    rounded four times, and d^2/2 exp(-d^2/2) is below 0.37. The exponential itself is good for 1e-6.
    """
    smallest, largest = np.linalg.eigvalsh(precision)
    eps = np.finfo(np.float32).eps
    return float(0.61 * np.sqrt(largest) * chroma_error + 0.37 * 4 * eps * largest / smallest + 1e-6)


def test_twin_evaluates_the_same(samples: Image, precision: Floats) -> None:
    """Native in floats and reference in doubles agree; chrominance is rounded a few times."""
    native = _core.skin_gaussian(samples, MEAN, precision)
    assert native.dtype == np.float32
    assert native.shape == (len(samples), samples.shape[2])
    twin = reference.skin_gaussian(samples, MEAN, precision)
    atol = tolerance(precision, chroma_error=4 * 256 * float(np.finfo(np.float32).eps))
    assert_allclose(native, twin, rtol=0, atol=atol)


def test_agrees_with_opencv_and_scipy(kernels: Kernels, precision: Floats) -> None:
    """SciPy's normal density over its peak, of OpenCV's Cb and Cr.

    OpenCV rounds Y (0.5, of which 0.71 at most reaches the chroma), the result (0.5), its constants (0.1).
    """
    image = np.random.default_rng(0).integers(0, 256, (50, 60, 3), np.uint8)
    ycrcb = cv2.cvtColor(image, cv2.COLOR_BGR2YCrCb).reshape(-1, 3).astype(float)
    normal = multivariate_normal(MEAN, np.linalg.inv(precision))
    baseline = normal.pdf(ycrcb[:, [2, 1]]) / normal.pdf(MEAN)
    samples = np.ascontiguousarray(image.reshape(-1, 3).T[None])
    ours = kernels.skin_gaussian(samples, MEAN, precision)[0]
    assert_allclose(ours, baseline, rtol=0, atol=tolerance(precision, chroma_error=0.96 * np.sqrt(2)))


def test_exponential(kernels: Kernels) -> None:
    """On black, whose chrominance is exact, exp is good for 1e-6 from 1 to the least normal floats."""
    black = np.zeros((1, 3, 70), np.uint8)
    for t in np.arange(0, 13.125, 0.125):
        value = kernels.skin_gaussian(black, np.array([128 + t, 128]), np.eye(2))
        assert_allclose(value, np.exp(-0.5 * t * t), rtol=1e-6)


def test_far_away(kernels: Kernels) -> None:
    """Where floats end the value is 0, not noise, infinity or NaN."""
    samples = np.array([[[0, 255], [0, 0], [255, 0]]], np.uint8)
    assert_array_equal(kernels.skin_gaussian(samples, MEAN, 1e30 * np.eye(2)), [[0, 0]])
    assert_array_equal(kernels.skin_gaussian(samples, np.full(2, 1e30), PRECISIONS["narrow"]), [[0, 0]])


@pytest.mark.parametrize("gray", [0, 77, 255])
def test_gray_has_no_chrominance(kernels: Kernels, gray: int) -> None:
    """Every gray lies at Cb = Cr = 128, so a Gaussian there has its peak, 1."""
    samples = np.full((1, 3, 9), gray, np.uint8)
    assert_allclose(kernels.skin_gaussian(samples, np.array([128.0, 128.0]), np.eye(2)), 1, atol=1e-6)


def test_primaries_at_the_ends_of_the_range(kernels: Kernels) -> None:
    """Full blue has Cb = 255.5 and full red Cr = 255.5: the full range of BT.601."""
    samples = np.array([[[255, 0], [0, 0], [0, 255]]], np.uint8)
    blue = kernels.skin_gaussian(samples, np.array([255.5, 128 - 0.114 * 255 / 1.402]), np.eye(2))
    red = kernels.skin_gaussian(samples, np.array([128 - 0.299 * 255 / 1.772, 255.5]), np.eye(2))
    assert_allclose([blue[0, 0], red[0, 1]], 1, atol=1e-6)


GOOD = np.zeros((1, 3, 2), np.uint8)
SINGULAR = np.ones((2, 2))
BAD_VALUES: list[tuple[Floats, Floats, str]] = [
    (np.zeros(3), np.eye(2), "mean: expected two finite numbers"),
    (np.array([1, np.nan]), np.eye(2), "mean: expected two finite numbers"),
    (MEAN, np.eye(3), r"precision: expected finite numbers \(2, 2\)"),
    (MEAN, np.full((2, 2), np.inf), r"precision: expected finite numbers \(2, 2\)"),
    (MEAN, SINGULAR, "precision: expected a symmetric, positive definite matrix"),
    (MEAN, -np.eye(2), "precision: expected a symmetric, positive definite matrix"),
    (MEAN, np.array([[1, 0.1], [0.2, 1]]), "precision: expected a symmetric, positive definite matrix"),
]


@pytest.mark.parametrize(("mean", "precision", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, mean: Floats, precision: Floats, message: str) -> None:
    """A mean or a precision that describes no Gaussian is named."""
    with pytest.raises(ValueError, match=message):
        kernels.skin_gaussian(GOOD, mean, precision)


BAD_TYPES: list[tuple[Any, Any, Any, type[Exception], str]] = [
    (GOOD.astype(float), MEAN, np.eye(2), TypeError, "samples: expected uint8 samples"),
    (GOOD, [1, 2], np.eye(2), TypeError, "mean: expected a NumPy array"),
    (GOOD, MEAN, np.eye(2, dtype=np.float32), TypeError, "precision: expected float64"),
    (GOOD, MEAN, np.ones(4), ValueError, "precision: expected float64"),
]


@pytest.mark.parametrize(("samples", "mean", "precision", "error", "message"), BAD_TYPES)
def test_native_refuses(
    samples: Any, mean: Any, precision: Any, error: type[Exception], message: str
) -> None:
    """Another type or shape is named, not converted."""
    with pytest.raises(error, match=message):
        _core.skin_gaussian(samples, mean, precision)
