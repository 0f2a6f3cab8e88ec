# SPDX-License-Identifier: MIT
"""The Kalman filter's update in Joseph's form."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.spatial.distance import mahalanobis
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]


def spread(rng: np.random.Generator, size: int) -> Floats:
    """A random covariance with variances of 0.5 and more, symmetric to the last bit."""
    root = rng.normal(size=(size, size))
    square = root @ root.T + 0.5 * np.eye(size)
    return np.asarray((square + square.T) / 2)


def case(seed: int = 0, size: int = 4, measured: int = 2, **changes: Any) -> dict[str, Any]:
    """Arguments of random numbers."""
    rng = np.random.default_rng(seed)
    return {
        "mean": rng.normal(0, 10, size),
        "covariance": spread(rng, size),
        "measurement": rng.normal(0, 10, measured),
        "observation": rng.normal(size=(measured, size)),
        "noise": spread(rng, measured),
    } | changes


@pytest.mark.parametrize(
    ("size", "measured"),
    [(1, 1), (2, 1), (1, 3), (4, 2), (6, 3), (7, 7), (10, 7), (12, 12), (13, 3), (5, 15)],
)
@pytest.mark.parametrize("seed", range(5))
def test_twin_corrects_the_same(size: int, measured: int, seed: int) -> None:
    """Native solves by Cholesky, the twin inverts: they differ by eps times S's condition, here below 1e4."""
    arguments = case(seed, size, measured)
    native, twin = _core.kalman_update(**arguments), reference.kalman_update(**arguments)
    assert np.linalg.cond(twin[3]) < 1e4
    for ours, theirs in zip(native, twin, strict=True):
        assert ours.shape == theirs.shape
        assert_allclose(ours, theirs, rtol=0, atol=1e-11 * max(1, abs(theirs).max()))


def test_closed_form(kernels: Kernels) -> None:
    """One number measured: P R / (P + R), and the mean between prediction and measurement by P / (P + R)."""
    p, r, x, z = 3.0, 1.0, 10.0, 14.0
    column = np.array([[1.0]])
    mean, covariance, innovation, total = kernels.kalman_update(
        np.array([x]), p * column, np.array([z]), column, r * column
    )
    assert_allclose(covariance, [[p * r / (p + r)]], rtol=1e-15)
    assert_allclose(mean, [x + p / (p + r) * (z - x)], rtol=1e-15)
    assert innovation[0] == z - x
    assert total[0, 0] == p + r


@pytest.mark.parametrize("seed", range(10))
def test_adds_information(kernels: Kernels, seed: int) -> None:
    """The information filter's form: inverse covariances add, and so do the means they weigh."""
    arguments = case(seed, 5, 3)
    x, p, z, h, r = arguments.values()
    mean, covariance, _, _ = kernels.kalman_update(**arguments)
    information = np.linalg.inv(p) + h.T @ np.linalg.inv(r) @ h
    weighed = np.linalg.inv(p) @ x + h.T @ np.linalg.inv(r) @ z
    assert_allclose(np.linalg.inv(covariance), information, rtol=1e-8, atol=1e-8)
    assert_allclose(mean, np.linalg.solve(information, weighed), rtol=1e-9, atol=1e-9)


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """cv2.KalmanFilter.correct, in float64, gives the same, though not in Joseph's form."""
    for seed in range(10):
        arguments = case(seed, 6, 3)
        baseline = cv2.KalmanFilter(6, 3, 0, cv2.CV_64F)
        baseline.statePre, baseline.errorCovPre = (
            arguments["mean"][:, None].copy(),
            arguments["covariance"].copy(),
        )
        baseline.measurementMatrix, baseline.measurementNoiseCov = (
            arguments["observation"],
            arguments["noise"],
        )
        expected = baseline.correct(arguments["measurement"][:, None])[:, 0]
        mean, covariance, _, _ = kernels.kalman_update(**arguments)
        assert_allclose(mean, expected, rtol=1e-10, atol=1e-10)
        assert_allclose(covariance, baseline.errorCovPost, rtol=1e-9, atol=1e-10)


def test_one_by_one_is_all_at_once(kernels: Kernels) -> None:
    """Measurements with independent noise may come one after the other."""
    arguments = case(5, 4, 3, noise=np.diag([0.5, 1.0, 2.0]))
    mean, covariance, _, _ = kernels.kalman_update(**arguments)
    x, p = arguments["mean"], arguments["covariance"]
    for k in range(3):
        parts = arguments["measurement"][[k]], arguments["observation"][[k]]
        x, p, _, _ = kernels.kalman_update(x, p, *parts, arguments["noise"][k : k + 1, k : k + 1].copy())
    assert_allclose(x, mean, rtol=1e-11)
    assert_allclose(p, covariance, rtol=1e-11, atol=1e-12)


def test_least_squares(kernels: Kernels) -> None:
    """A line through 50 noisy points, taken one by one, is NumPy's weighted least squares."""
    rng = np.random.default_rng(1)
    t = np.linspace(0, 5, 50)
    deviations = rng.uniform(0.1, 1, 50)
    z = 3 - 2 * t + rng.normal(0, deviations)
    mean, covariance = np.zeros(2), 1e9 * np.eye(2)
    for time, value, deviation in zip(t, z, deviations, strict=True):
        row, noise = np.array([[1.0, time]]), np.array([[deviation**2]])
        mean, covariance, _, _ = kernels.kalman_update(mean, covariance, np.array([value]), row, noise)
    slope_first, expected = np.polyfit(t, z, 1, w=1 / deviations, cov="unscaled")
    assert_allclose(mean, slope_first[::-1], rtol=1e-6)
    assert_allclose(covariance, expected[::-1, ::-1], rtol=1e-5)


def test_innovation_is_honest(kernels: Kernels) -> None:
    """Over 4,000 steps of a walk with these noises, y S^-1 y and the error squared average M and D."""
    rng = np.random.default_rng(2)
    f, q = np.array([[1, 1], [0, 1.0]]), np.diag([0.01, 0.04])
    h, r = np.array([[1.0, 0.0]]), np.array([[0.5]])
    state, mean, covariance = np.zeros(2), np.zeros(2), np.zeros((2, 2))
    innovations, errors = [], []
    for _ in range(4000):
        state = f @ state + rng.normal(0, np.sqrt(q.diagonal()))
        mean, covariance = kernels.kalman_predict(mean, covariance, f, q)
        z = h @ state + rng.normal(0, np.sqrt(r[0]))
        mean, covariance, y, s = kernels.kalman_update(mean, covariance, z, h, r)
        innovations.append(y @ np.linalg.solve(s, y))
        errors.append((state - mean) @ np.linalg.solve(covariance, state - mean))
    assert abs(np.mean(innovations) - 1) < 0.1
    assert abs(np.mean(errors) - 2) < 0.2


def test_sharp_measurements_stay_covariances(kernels: Kernels) -> None:
    """200 measurements 1e6 times sharper than what was known leave a covariance: their information's."""
    rng = np.random.default_rng(0)
    covariance, information, noise = np.eye(3), np.eye(3), np.array([[1e-12]])
    for _ in range(200):
        row = 1 + rng.normal(0, 0.1, (1, 3))
        _, covariance, _, _ = kernels.kalman_update(np.zeros(3), covariance, np.zeros(1), row, noise)
        information += row.T @ row / noise
        assert_array_equal(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance).min() > 0
    expected = 1 / np.linalg.eigvalsh(information)[::-1]
    assert_allclose(np.linalg.eigvalsh(covariance), expected, rtol=1e-3)


@pytest.mark.parametrize("seed", range(5))
def test_never_knows_less(kernels: Kernels, seed: int) -> None:
    """Any measurement takes away from the covariance, and one as predicted leaves the mean."""
    arguments = case(seed, 5, 2)
    _, covariance, _, _ = kernels.kalman_update(**arguments)
    assert np.linalg.eigvalsh(arguments["covariance"] - covariance).min() >= -1e-12
    as_predicted = arguments["observation"] @ arguments["mean"]
    mean, same, innovation, _ = kernels.kalman_update(**arguments | {"measurement": as_predicted})
    assert_allclose(innovation, 0, atol=1e-13)
    assert_allclose(mean, arguments["mean"], rtol=1e-12)
    assert_array_equal(same, covariance)


def test_without_noise_it_is_believed(kernels: Kernels) -> None:
    """An exact measurement of two of four numbers becomes the state, and leaves them without variance."""
    arguments = case(6, observation=np.eye(2, 4), noise=np.zeros((2, 2)))
    mean, covariance, _, _ = kernels.kalman_update(**arguments)
    assert_allclose(mean[:2], arguments["measurement"], rtol=1e-13)
    assert_allclose(covariance[:2], 0, atol=1e-13)
    assert covariance.diagonal()[2:].min() > 0.1


def test_units_do_not_matter(kernels: Kernels) -> None:
    """Meters and pixels in one measurement: a scale of 1e8 between them is no singular matrix."""
    unit = np.array([1e-4, 1e4])
    plain, scaled = case(7), case(7)
    scaled["measurement"] = plain["measurement"] * unit
    scaled["observation"] = plain["observation"] * unit[:, None]
    scaled["noise"] = plain["noise"] * np.outer(unit, unit)
    for ours, theirs in zip(
        kernels.kalman_update(**scaled)[:2], kernels.kalman_update(**plain)[:2], strict=True
    ):
        assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_far_off_widens_first(kernels: Kernels, seed: int) -> None:
    """Beyond the largest distance, by SciPy's mahalanobis, it is the update of the covariance that is larger
    by the square of how much; within it the distance changes no bit.
    """
    arguments = case(seed, 6, 3)
    mean, covariance, innovation, total = kernels.kalman_update(**arguments)
    distance = mahalanobis(innovation, np.zeros(3), np.linalg.inv(total))
    same = kernels.kalman_update(**arguments, max_distance=1.01 * distance)
    for ours, plain in zip(same, (mean, covariance, innovation, total), strict=True):
        assert_array_equal(ours, plain)
    widened = kernels.kalman_update(**arguments, max_distance=distance / 3)
    expected = kernels.kalman_update(**arguments | {"covariance": 9 * arguments["covariance"]})
    for ours, theirs in zip(widened, expected, strict=True):
        assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9 * abs(theirs).max())


@pytest.mark.parametrize("seed", range(5))
def test_twin_widens_the_same(seed: int) -> None:
    """Native and reference agree where the measurement is far off, as where it isn't."""
    arguments = case(seed, 6, 3, max_distance=0.1)
    for ours, theirs in zip(
        _core.kalman_update(**arguments), reference.kalman_update(**arguments), strict=True
    ):
        assert_allclose(ours, theirs, rtol=0, atol=1e-11 * max(1, abs(theirs).max()))


SKEW = np.array([[1.0, 0.5], [0.0, 1.0]])
SINGULAR = "noise: expected with the state's a positive definite innovation covariance, got one that isn't"
BAD: list[tuple[dict[str, Any], str]] = [
    ({"mean": np.zeros(0)}, "mean: expected at least one number, got none"),
    ({"mean": np.array([0, 0, np.inf, 0])}, "mean: expected finite numbers, got inf"),
    ({"covariance": np.eye(3)}, r"covariance: expected shape \(4, 4\), got \(3, 3\)"),
    ({"covariance": np.diag([1.0, 1, -3, 1])}, "covariance: expected no negative variance, got -3"),
    ({"measurement": np.zeros(0)}, "measurement: expected at least one number, got none"),
    ({"measurement": np.array([1, np.nan])}, "measurement: expected finite numbers, got nan"),
    ({"observation": np.ones((4, 2))}, r"observation: expected shape \(2, 4\), got \(4, 2\)"),
    ({"observation": np.full((2, 4), np.nan)}, "observation: expected finite numbers, got nan"),
    ({"noise": np.eye(4)}, r"noise: expected shape \(2, 2\), got \(4, 4\)"),
    ({"noise": SKEW}, "noise: expected a symmetric matrix, got entries that differ by 0.5"),
    ({"noise": np.array([[1.0, 9.0], [9.0, 1.0]]), "covariance": 0.01 * np.eye(4)}, SINGULAR),
    ({"noise": np.zeros((2, 2)), "covariance": np.zeros((4, 4))}, SINGULAR),
    ({"noise": np.zeros((2, 2)), "observation": np.ones((2, 4)) / 3}, SINGULAR),
    ({"covariance": 1e200 * np.eye(4), "observation": 1e200 * np.eye(2, 4)}, SINGULAR),
    ({"max_distance": 0.0}, "max_distance: expected a number above 0, got 0"),
    ({"max_distance": np.nan}, "max_distance: expected a number above 0, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, and so is an innovation that can't be weighed."""
    with np.errstate(over="ignore", invalid="ignore"), pytest.raises(ValueError, match=message):
        kernels.kalman_update(**case(**changes))


def test_converts_nothing() -> None:
    """Single precision and columns are named, never converted."""
    with pytest.raises(TypeError, match="measurement: expected float64"):
        _core.kalman_update(**case(measurement=np.zeros(2, np.float32)))
    with pytest.raises(ValueError, match="measurement: expected float64"):
        _core.kalman_update(**case(measurement=np.zeros((2, 1))))
