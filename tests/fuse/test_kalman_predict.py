# SPDX-License-Identifier: MIT
"""The Kalman filter's prediction."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
EPSILON = np.finfo(float).eps


def spread(rng: np.random.Generator, size: int) -> Floats:
    """A random covariance, symmetric to the last bit."""
    root = rng.normal(size=(size, size))
    return np.asarray((root @ root.T + (root @ root.T).T) / 2)


def case(seed: int = 0, size: int = 4, **changes: Any) -> dict[str, Any]:
    """Arguments of random numbers."""
    rng = np.random.default_rng(seed)
    return {
        "mean": rng.normal(0, 10, size),
        "covariance": spread(rng, size),
        "transition": rng.normal(size=(size, size)),
        "noise": spread(rng, size),
    } | changes


@pytest.mark.parametrize("size", [1, 2, 3, 6, 7, 12, 13])
@pytest.mark.parametrize("seed", range(5))
def test_twin_predicts_the_same(size: int, seed: int) -> None:
    """Sums of up to D^2 products differ by D^2 eps of the sum of the products' sizes."""
    arguments = case(seed, size)
    mean, covariance = _core.kalman_predict(**arguments)
    twin_mean, twin_covariance = reference.kalman_predict(**arguments)
    x, p, f, q = map(abs, arguments.values())
    slack = size**2 * EPSILON
    assert (abs(mean - twin_mean) <= slack * (f @ x)).all()
    assert (abs(covariance - twin_covariance) <= slack * (f @ p @ f.T + q)).all()


def test_closed_form(kernels: Kernels) -> None:
    """Constant velocity for a time t: position spreads by t^2 of the velocity's variance."""
    t = 0.5
    mean, covariance = kernels.kalman_predict(
        np.array([1.0, 4.0]), np.diag([0.25, 2.0]), np.array([[1, t], [0, 1]]), np.diag([0.125, 1.0])
    )
    assert_array_equal(mean, [1 + 4 * t, 4])
    assert_array_equal(covariance, [[0.25 + 2 * t**2 + 0.125, 2 * t], [2 * t, 3.0]])


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """cv2.KalmanFilter.predict, in float64, gives the same."""
    for seed in range(10):
        arguments = case(seed, 5)
        baseline = cv2.KalmanFilter(5, 1, 0, cv2.CV_64F)
        baseline.statePost = arguments["mean"][:, None].copy()
        baseline.errorCovPost, baseline.transitionMatrix = (
            arguments["covariance"].copy(),
            arguments["transition"],
        )
        baseline.processNoiseCov = arguments["noise"]
        mean, covariance = kernels.kalman_predict(**arguments)
        assert_allclose(mean, baseline.predict()[:, 0], rtol=1e-12, atol=1e-12)
        assert_allclose(covariance, baseline.errorCovPre, rtol=1e-12, atol=1e-12)


def test_covariance_of_a_sample(kernels: Kernels) -> None:
    """100,000 states moved and disturbed scatter as the prediction says."""
    arguments = case(3, 3)
    rng = np.random.default_rng(0)
    states = rng.multivariate_normal(arguments["mean"], arguments["covariance"], 100000)
    states = states @ arguments["transition"].T
    states += rng.multivariate_normal(np.zeros(3), arguments["noise"], 100000)
    mean, covariance = kernels.kalman_predict(**arguments)
    scale = np.sqrt(covariance.diagonal())
    assert_allclose(states.mean(axis=0), mean, rtol=0, atol=5 * scale.max() / np.sqrt(100000))
    assert_allclose(np.cov(states.T) / np.outer(scale, scale), covariance / np.outer(scale, scale), atol=0.03)


def test_two_steps_are_one(kernels: Kernels) -> None:
    """Without noise between them, two transitions are their product."""
    first, second = case(1), case(2)
    still = np.zeros((4, 4))
    mean, covariance = kernels.kalman_predict(**first | {"noise": still})
    twice = kernels.kalman_predict(mean, covariance, second["transition"], still)
    product = second["transition"] @ first["transition"]
    once = kernels.kalman_predict(**first | {"transition": product, "noise": still})
    assert_allclose(twice[0], once[0], rtol=1e-12, atol=1e-12)
    assert_allclose(twice[1], once[1], rtol=1e-12, atol=1e-11)


def test_standing_still_adds_noise(kernels: Kernels) -> None:
    """With F = I, the paper's (6), the mean stays and the covariance grows by Q, to the last bit."""
    arguments = case(4, transition=np.eye(4))
    mean, covariance = kernels.kalman_predict(**arguments)
    assert_array_equal(mean, arguments["mean"])
    assert_array_equal(covariance, arguments["covariance"] + arguments["noise"])


@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e150])
def test_covariance_is_one(kernels: Kernels, scale: float) -> None:
    """Symmetric to the last bit and nowhere negative, at any scale, also of a state known exactly."""
    for seed in range(10):
        arguments = case(seed, 6, noise=np.zeros((6, 6)))
        arguments["covariance"] *= scale
        arguments["covariance"][seed % 6] = arguments["covariance"][:, seed % 6] = 0
        _, covariance = kernels.kalman_predict(**arguments)
        assert_array_equal(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance / scale).min() >= -1e-12 * np.trace(covariance / scale)


SKEW = np.eye(4) + np.eye(4, k=1) * 0.5
BAD: list[tuple[dict[str, Any], str]] = [
    ({"mean": np.zeros(0)}, "mean: expected at least one number, got none"),
    ({"mean": np.full(4, np.nan)}, "mean: expected finite numbers, got nan"),
    ({"mean": -np.full(4, np.nan)}, "mean: expected finite numbers, got nan"),
    ({"covariance": np.eye(3)}, r"covariance: expected shape \(4, 4\), got \(3, 3\)"),
    ({"covariance": np.full((4, 4), np.inf)}, "covariance: expected finite numbers, got inf"),
    ({"covariance": -np.eye(4)}, "covariance: expected no negative variance, got -1"),
    ({"covariance": SKEW}, "covariance: expected a symmetric matrix, got entries that differ by 0.5"),
    ({"transition": np.zeros((4, 3))}, r"transition: expected shape \(4, 4\), got \(4, 3\)"),
    ({"transition": np.full((4, 4), np.nan)}, "transition: expected finite numbers, got nan"),
    ({"noise": np.zeros((5, 5))}, r"noise: expected shape \(4, 4\), got \(5, 5\)"),
    ({"noise": np.diag([1.0, np.nan, 1, 1])}, "noise: expected finite numbers, got nan"),
    ({"noise": SKEW.T.copy()}, "noise: expected a symmetric matrix"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.kalman_predict(**case(**changes))


def test_converts_nothing() -> None:
    """Single precision and transposed views are named, never converted."""
    with pytest.raises(TypeError, match="noise: expected float64"):
        _core.kalman_predict(**case(noise=np.eye(4, dtype=np.float32)))
    with pytest.raises(ValueError, match="transition: expected a C-contiguous"):
        _core.kalman_predict(**case(transition=np.ones((4, 4)).T[:, ::-1]))
