# SPDX-License-Identifier: MIT
"""The estimate of weighted particles."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
EPSILON = np.finfo(float).eps


def cloud(count: int = 60, dimensions: int = 4, seed: int = 0) -> tuple[Floats, Floats]:
    """Particles far from the origin compared with their spread, and weights, some of them 0."""
    random = np.random.default_rng(seed)
    weights = random.exponential(size=count) * (random.random(count) < 0.8)
    weights[0] = 1.0
    return random.normal(300, 10, (count, dimensions)), weights


@pytest.mark.parametrize("seed", range(20))
def test_twin_sums_up_the_same(seed: int) -> None:
    """Sums of N terms differ by 2 N eps of the largest |x|, in products by 4 |x| times that."""
    random = np.random.default_rng(seed)
    particles, weights = cloud(int(random.integers(1, 70)), int(random.integers(1, 8)), seed)
    slack, size = 2 * len(particles) * EPSILON, np.abs(particles).max()
    native, twin = _core.summarize(particles, weights), reference.summarize(particles, weights)
    assert_allclose(native[0], twin[0], rtol=0, atol=slack * size)
    assert_allclose(native[1], twin[1], rtol=0, atol=4 * slack * size**2)
    assert_allclose(native[2], twin[2], rtol=2 * slack)


def test_numpy_has_the_same_moments(kernels: Kernels) -> None:
    """Mean and covariance are those of np.average and np.cov with these weights."""
    particles, weights = cloud()
    mean, covariance, _ = kernels.summarize(particles, weights)
    assert_allclose(mean, np.average(particles, axis=0, weights=weights))
    assert_allclose(covariance, np.cov(particles.T, aweights=weights, ddof=0), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("equal", [1, 7, 60])
def test_effective_size_counts_equal_weights(kernels: Kernels, equal: int) -> None:
    """Of 60 particles with k equal weights and 0 otherwise k are effective."""
    weights = np.where(np.arange(60) < equal, 0.2, 0.0)
    assert_allclose(kernels.summarize(cloud()[0], weights)[2], equal)


def test_one_particle(kernels: Kernels) -> None:
    """A single particle is its own mean, without spread."""
    mean, covariance, effective = kernels.summarize(np.array([[3.0, 4.0]]), np.array([0.5]))
    assert_array_equal(mean, [3.0, 4.0])
    assert_array_equal(covariance, np.zeros((2, 2)))
    assert effective == 1.0


@pytest.mark.parametrize("seed", range(5))
def test_covariance_is_one(kernels: Kernels, seed: int) -> None:
    """The covariance is symmetric and nowhere negative, even with fewer particles than dimensions."""
    particles, weights = cloud(3, 6, seed)
    _, covariance, effective = kernels.summarize(particles, weights)
    assert_allclose(covariance, covariance.T, rtol=0, atol=1e-12)
    assert np.linalg.eigvalsh(covariance).min() >= -1e-12 * np.trace(covariance)
    assert 1 - 1e-12 <= effective <= 3 + 1e-12


@pytest.mark.parametrize("factor", [1e-300, 1e300])
def test_scale_of_the_weights_cancels(kernels: Kernels, factor: float) -> None:
    """Weights a factor 1e300 larger or smaller give the same summary."""
    particles, weights = cloud()
    for scaled, plain in zip(
        kernels.summarize(particles, weights * factor), kernels.summarize(particles, weights), strict=True
    ):
        assert_allclose(scaled, plain, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("particles", "weights", "message"),
    [
        (np.zeros((3, 2)), np.ones(4), r"weights: expected shape \(3,\), got \(4,\)"),
        (np.zeros((3, 2)), np.zeros(3), "weights: expected a finite sum above 0, got 0"),
        (np.zeros((0, 2)), np.zeros(0), "weights: expected a finite sum above 0, got 0"),
        (np.zeros((1, 2)), np.array([-1.0]), "weights: expected finite numbers, none negative, got -1"),
        (np.zeros((1, 2)), np.array([np.nan]), "weights: expected finite numbers, none negative, got nan"),
        (np.full((1, 2), np.nan), np.ones(1), "particles: expected finite numbers, got nan"),
    ],
)
def test_refuses_values(kernels: Kernels, particles: Floats, weights: Floats, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        kernels.summarize(particles, weights)


def test_converts_nothing() -> None:
    """Single precision and strided views are named, never converted."""
    particles, weights = cloud()
    with pytest.raises(TypeError, match="particles: expected float64"):
        _core.summarize(particles.astype(np.float32), weights)
    with pytest.raises(ValueError, match="particles: expected a C-contiguous"):
        _core.summarize(particles[:, ::2], weights)
    with pytest.raises(ValueError, match="weights: expected a C-contiguous"):
        _core.summarize(particles[:30], weights[::2])
