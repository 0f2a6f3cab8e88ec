# SPDX-License-Identifier: MIT
"""Points from stereo measurements, and how sure they are."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import Intrinsics, StereoRig, _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
CAMERA = np.array([140.0, 152.0, 79.5, 60.25])
BASELINE = 0.12


def case(seed: int = 0, count: int = 50, **changes: Any) -> dict[str, Any]:
    """Measurements over a picture of 160x120, a covariance each."""
    rng = np.random.default_rng(seed)
    roots = rng.normal(0, 0.5, (count, 3, 3))
    return {
        "measurements": rng.uniform([0, 0, 2], [160, 120, 30], (count, 3)),
        "variances": roots @ roots.transpose(0, 2, 1),
        "camera": CAMERA,
        "baseline": BASELINE,
    } | changes


def project(points: Floats) -> Floats:
    """(N, 3) u, v, d of points."""
    fx, fy, cx, cy = CAMERA
    x, y, z = points.T
    return np.stack([fx * x / z + cx, fy * y / z + cy, fx * BASELINE / z], axis=1)


@pytest.mark.parametrize("count", [0, 1, 2, 50])
@pytest.mark.parametrize("shared", [True, False])
def test_twin_sees_the_same(count: int, shared: bool) -> None:
    """Points agree to the last bit; covariances are sums of nine products, so to 16 eps of the greatest."""
    arguments = case(count, count, **({"variances": np.array([1.0, 2.0, 0.0])} if shared else {}))
    points, covariances = _core.back_project(**arguments)
    twin_points, twin_covariances = reference.back_project(**arguments)
    assert_array_equal(points, twin_points, strict=True)
    slack = 16 * np.finfo(float).eps * abs(twin_covariances).max(initial=0)
    assert_allclose(covariances, twin_covariances, rtol=0, atol=slack)
    assert covariances.shape == (count, 3, 3)


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """cv2.reprojectImageTo3D, in float32, has the same points."""
    fx, _, cx, cy = camera = CAMERA[[0, 0, 2, 3]]  # OpenCV's matrix has one focal length
    disparity = np.random.default_rng(1).uniform(2, 30, (30, 40)).astype(np.float32)
    q = np.array([[1, 0, 0, -cx], [0, 1, 0, -cy], [0, 0, 0, fx], [0, 0, 1 / BASELINE, 0]])
    expected = cv2.reprojectImageTo3D(disparity, q).reshape(-1, 3)
    v, u = np.mgrid[:30, :40]
    measurements = np.stack([u.ravel(), v.ravel(), disparity.ravel()], axis=1).astype(np.float64)
    points, _ = kernels.back_project(measurements, np.ones(3), camera, BASELINE)
    assert_allclose(points, expected, rtol=1e-5, atol=1e-6)


def test_agrees_with_the_rig(kernels: Kernels) -> None:
    """They are StereoRig's and Intrinsics' own points, and project to where they were seen."""
    measurements = case()["measurements"]
    rig = StereoRig(Intrinsics(*CAMERA, 160, 120), BASELINE)
    points, _ = kernels.back_project(**case())
    u, v, d = measurements.T
    assert_allclose(points, rig.intrinsics.back_project(u, v, rig.depth(d)), rtol=1e-14)
    assert_allclose(project(points), measurements, rtol=1e-12, atol=1e-11)


def test_covariance_by_finite_differences(kernels: Kernels) -> None:
    """J of J S J^T is that of central differences of the points."""
    arguments = case(2, 20)
    _, covariances = kernels.back_project(**arguments)
    step, measurements = 1e-4, arguments["measurements"]
    columns = []
    for axis in np.eye(3) * step:
        ahead, _ = kernels.back_project(**arguments | {"measurements": measurements + axis})
        behind, _ = kernels.back_project(**arguments | {"measurements": measurements - axis})
        columns.append((ahead - behind) / (2 * step))
    jacobians = np.stack(columns, axis=2)
    expected = jacobians @ arguments["variances"] @ jacobians.transpose(0, 2, 1)
    assert_allclose(covariances, expected, rtol=1e-6, atol=1e-7 * abs(expected).max())


def test_covariance_of_a_sample(kernels: Kernels) -> None:
    """20,000 noisy measurements of one point scatter as its covariance says."""
    rng = np.random.default_rng(3)
    variances = np.array([0.3, 0.2, 0.05]) ** 2
    truth = project(np.array([[0.2, -0.1, 1.5]]))
    _, covariance = kernels.back_project(truth, variances, CAMERA, BASELINE)
    noisy = truth + rng.normal(0, np.sqrt(variances), (20000, 3))
    points, _ = kernels.back_project(noisy, variances, CAMERA, BASELINE)
    assert_allclose(np.cov(points.T), covariance[0], rtol=0.04, atol=0.02 * covariance[0].diagonal().min())


def test_depth_error_grows_with_the_square(kernels: Kernels) -> None:
    """The closed form var z = (z^2 / (fx b))^2 var d, and, on the axis, var x = (z / fx)^2 var u."""
    z = np.array([0.8, 1.6, 4.0])
    measurements = project(np.stack([0 * z, 0 * z, z], axis=1))
    _, covariances = kernels.back_project(measurements, np.array([0.04, 0.09, 0.0625]), CAMERA, BASELINE)
    assert_allclose(covariances[:, 2, 2], (z**2 / (CAMERA[0] * BASELINE)) ** 2 * 0.0625, rtol=1e-12)
    assert_allclose(covariances[:, 0, 0], (z / CAMERA[0]) ** 2 * 0.04, rtol=1e-12)
    assert_allclose(covariances[:, 1, 1], (z / CAMERA[1]) ** 2 * 0.09, rtol=1e-12)


def test_covariances_are_some(kernels: Kernels) -> None:
    """Covariances are symmetric to the last bit and nowhere negative, also of a single certain direction."""
    direction = np.array([1.0, -2.0, 0.5])
    for variances in (case()["variances"], np.tile(np.outer(direction, direction), (50, 1, 1)), np.zeros(3)):
        _, covariances = kernels.back_project(**case(variances=variances))
        assert_array_equal(covariances, covariances.transpose(0, 2, 1))
        largest = abs(covariances).max(initial=1e-300)
        assert np.linalg.eigvalsh(covariances).min() >= -1e-14 * largest


def test_nothing_measured(kernels: Kernels) -> None:
    """Disparities that aren't above 0, and what isn't finite, give NaN there and nowhere else."""
    rows = [[9, 9, 0], [9, 9, -1], [9, 9, np.nan], [np.inf, 9, 5], [9, np.nan, 5], [9, 9, np.inf], [9, 9, 5]]
    points, covariances = kernels.back_project(np.array(rows, float), np.ones(3), CAMERA, BASELINE)
    assert np.isnan(points[:-1]).all()
    assert np.isnan(covariances[:-1]).all()
    assert np.isfinite(points[-1]).all()
    assert np.isfinite(covariances[-1]).all()


SKEW = np.array([[1.0, 0.5, 0], [0, 1, 0], [0, 0, 1]])
BAD: list[tuple[dict[str, Any], str]] = [
    ({"measurements": np.zeros((2, 2))}, r"measurements: expected shape \(2, 3\), got \(2, 2\)"),
    ({"camera": np.ones(3)}, r"camera: expected shape \(4,\), got \(3,\)"),
    ({"camera": np.array([1, 1, np.nan, 0])}, "camera: expected finite numbers, got nan"),
    ({"camera": np.array([0.0, 1, 0, 0])}, "camera: expected focal lengths above 0, got 0"),
    ({"camera": np.array([1.0, -1, 0, 0])}, "camera: expected focal lengths above 0, got -1"),
    ({"baseline": 0.0}, "baseline: expected a finite number above 0, got 0"),
    ({"baseline": np.inf}, "baseline: expected a finite number above 0, got inf"),
    ({"variances": np.ones(4)}, "variances: expected"),
    ({"variances": np.ones((2, 3, 2))}, "variances: expected"),
    (
        {"variances": np.ones((3, 3, 3))},
        "variances: expected one covariance for each of 2 measurements, got 3",
    ),
    ({"variances": np.array([1.0, np.nan, 1])}, "variances: expected finite numbers, got nan"),
    ({"variances": np.array([1.0, -2, 1])}, "variances: expected no negative variance, got -2"),
    (
        {"variances": np.stack([np.eye(3), SKEW])},
        "variances: expected a symmetric matrix, got entries that differ",
    ),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.back_project(**case(0, 2, **changes))


def test_converts_nothing() -> None:
    """Single precision and lists are named, never converted."""
    with pytest.raises(TypeError, match="measurements: expected float64"):
        _core.back_project(**case(measurements=np.ones((50, 3), np.float32)))
    with pytest.raises(TypeError, match="variances: expected a NumPy array"):
        _core.back_project(**case(variances=[1.0, 1.0, 1.0]))
