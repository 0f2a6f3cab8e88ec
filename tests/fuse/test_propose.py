# SPDX-License-Identifier: MIT
"""The mixture proposal."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import grouped

Case = dict[str, Any]
PARTS = {"dynamics": ("drift", "scale"), "detection": ("mean", "root", "share"), "bounds": ("lower", "upper")}


def case(count: int = 40, dimensions: int = 4, seed: int = 0, **changes: object) -> Case:
    """Values that `propose` takes, those in its tuples one by one; bounds wide open."""
    random = np.random.default_rng(seed)
    arguments: Case = {
        "particles": random.normal(100, 20, (count, dimensions)),
        "drift": random.normal(0, 5, dimensions),
        "scale": random.uniform(0, 10, dimensions),
        "noise": random.normal(size=(count, dimensions)),
        "mean": random.normal(100, 20, 2),
        "root": np.array([[8.0, 0.0], [-3.0, 5.0]]),
        "share": 0.3,
        "lower": np.full(dimensions, -np.inf),
        "upper": np.full(dimensions, np.inf),
    }
    return arguments | changes


def propose(k: Kernels, values: Case) -> NDArray[np.float64]:
    """The particles that a set of kernels draws."""
    return k.propose(**grouped(values, PARTS))


@pytest.mark.parametrize("seed", range(20))
def test_twin_moves_the_same(seed: int) -> None:
    """Native and reference agree to the last bit for any N, D, K and share: both add up in one order."""
    random = np.random.default_rng(seed)
    count, dimensions = int(random.integers(0, 70)), int(random.integers(2, 8))
    bounds = {"lower": np.full(dimensions, 80.0), "upper": np.full(dimensions, 120.0)}
    seen = int(random.integers(1, dimensions + 1))
    gaussian = {"mean": random.normal(100, 20, seen), "root": np.tril(random.normal(0, 3, (seen, seen)))}
    gaussian["root"][np.diag_indices(seen)] = random.uniform(1, 5, seen)
    arguments = case(count, dimensions, seed, share=random.uniform(), **bounds, **gaussian)
    assert_array_equal(propose(_core, arguments), propose(reference, arguments))


def spread_noise(dimensions: int) -> NDArray[np.float64]:
    """2D points with mean 0 and covariance I exactly (the unscented transform's)."""
    return np.sqrt(dimensions) * np.concatenate([np.eye(dimensions), -np.eye(dimensions)])


def test_moments_of_the_dynamics(kernels: Kernels) -> None:
    """Noise of mean 0 and covariance I moves one particle to mean x + drift, covariance diag(scale^2)."""
    noise = spread_noise(4)
    arguments = case(8, particles=np.tile([50.0, 60.0, 10.0, 12.0], (8, 1)), noise=noise, share=0.0)
    moved = propose(kernels, arguments)
    assert_allclose(moved.mean(axis=0), arguments["particles"][0] + arguments["drift"])
    assert_allclose(np.cov(moved.T, ddof=0), np.diag(arguments["scale"] ** 2), atol=1e-12)


def test_moments_of_the_detection(kernels: Kernels) -> None:
    """The detected share has mean and covariance root root^T, its other dimensions follow the dynamics."""
    noise = np.zeros((16, 4))
    noise[1::2] = spread_noise(4)
    arguments = case(16, noise=noise, share=0.5)
    detected = propose(kernels, arguments)[1::2]
    assert_allclose(detected[:, :2].mean(axis=0), arguments["mean"])
    assert_allclose(np.cov(detected[:, :2].T, ddof=0), arguments["root"] @ arguments["root"].T)
    dynamics = propose(kernels, arguments | {"share": 0.0})
    assert_array_equal(detected[:, 2:], dynamics[1::2, 2:])


def test_the_detected_are_spread_evenly(kernels: Kernels) -> None:
    """floor(share N) particles are detected, no two gaps between them differ by more than one, the rest is as
    without.
    """
    arguments = case(100, share=0.23)
    mixed, dynamics = propose(kernels, arguments), propose(kernels, arguments | {"share": 0.0})
    detected = np.flatnonzero(np.any(mixed[:, :2] != dynamics[:, :2], axis=1))
    assert len(detected) == 23
    assert np.ptp(np.diff(detected)) <= 1


def test_stays_inside_the_bounds(kernels: Kernels) -> None:
    """What would leave the bounds stands on them, and what would not is untouched."""
    lower, upper = np.array([90.0, 95.0, -np.inf, 100.0]), np.array([110.0, 95.0, 100.0, np.inf])
    free, held = propose(kernels, case(200)), propose(kernels, case(200, lower=lower, upper=upper))
    assert np.all((held >= lower) & (held <= upper))
    inside = (free >= lower) & (free <= upper)
    assert 0 < inside.mean() < 1
    assert_array_equal(held[inside], free[inside])


def test_without_detection_its_gaussian_is_not_read(kernels: Kernels) -> None:
    """With a share of 0 there may be no Gaussian: NaN and zeros pass and change nothing."""
    nothing = {"mean": np.full(2, np.nan), "root": np.zeros((2, 2)), "share": 0.0}
    assert_array_equal(propose(kernels, case(**nothing)), propose(kernels, case(share=0.0)))


def test_inputs_untouched(kernels: Kernels) -> None:
    """The particles that go in are not moved in place."""
    arguments = case()
    before = arguments["particles"].copy()
    propose(kernels, arguments)
    assert_array_equal(arguments["particles"], before)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"particles": np.zeros((40, 1))}, r"noise: expected shape \(40, 1\), got \(40, 4\)"),
        ({"particles": np.full((40, 4), np.nan)}, "particles: expected finite numbers, got nan"),
        ({"noise": np.zeros((39, 4))}, r"noise: expected shape \(40, 4\), got \(39, 4\)"),
        ({"noise": np.full((40, 4), -np.inf)}, "noise: expected finite numbers, got -inf"),
        ({"drift": np.zeros(3)}, r"drift: expected shape \(4,\), got \(3,\)"),
        ({"drift": np.full(4, np.inf)}, "drift: expected finite numbers, got inf"),
        ({"scale": np.array([1.0, 1.0, -2.0, 1.0])}, "scale: expected no negative number, got -2"),
        ({"scale": np.full(4, np.nan)}, "scale: expected finite numbers, got nan"),
        ({"share": 1.0}, r"share: expected a number in \[0, 1\), got 1"),
        ({"share": -0.5}, r"share: expected a number in \[0, 1\), got -0.5"),
        ({"share": np.nan}, r"share: expected a number in \[0, 1\), got nan"),
        ({"mean": np.zeros(5)}, "mean: expected 1 to 4 numbers, got 5"),
        ({"mean": np.zeros(0)}, "mean: expected 1 to 4 numbers, got 0"),
        ({"mean": np.zeros(3)}, r"root: expected shape \(3, 3\), got \(2, 2\)"),
        ({"mean": np.full(2, np.nan)}, "mean: expected finite numbers, got nan"),
        ({"root": np.eye(3)}, r"root: expected shape \(2, 2\), got \(3, 3\)"),
        ({"root": np.full((2, 2), np.inf)}, "root: expected finite numbers, got inf"),
        ({"root": np.diag([1.0, 0.0])}, "root: expected a diagonal above 0, got 0"),
        ({"lower": np.zeros(3)}, r"lower: expected shape \(4,\), got \(3,\)"),
        ({"upper": np.zeros(5)}, r"upper: expected shape \(4,\), got \(5,\)"),
        ({"lower": np.full(4, 7.0), "upper": np.full(4, 6.0)}, "lower: expected no number above upper"),
        ({"lower": np.full(4, np.nan)}, "lower: expected no number above upper, got nan"),
    ],
)
def test_refuses_values(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        propose(kernels, case(**changes))


@pytest.mark.parametrize("name", ["particles", "drift", "scale", "noise", "mean", "root", "lower", "upper"])
def test_converts_nothing(name: str) -> None:
    """Single precision and strided views are named, never converted."""
    values = case()[name]
    with pytest.raises(TypeError, match=f"{name}: expected float64"):
        propose(_core, case(**{name: values.astype(np.float32)}))
    with pytest.raises(ValueError, match=f"{name}: expected a C-contiguous"):
        propose(_core, case(**{name: np.repeat(values, 2, axis=-1)[..., ::2]}))
