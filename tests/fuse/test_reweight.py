# SPDX-License-Identifier: MIT
"""Importance weights under the mixture proposal."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.special import logsumexp
from scipy.stats import multivariate_normal, norm
from tricue import _core, reference
from tricue.kernels import Kernels, load

from tests.kernel_arguments import grouped

Case = dict[str, Any]
PARTS = {"dynamics": ("drift", "scale"), "detection": ("mean", "root", "share")}
EPSILON = np.finfo(float).eps


def case(count: int = 40, dimensions: int = 4, seed: int = 0, **changes: object) -> Case:
    """Values that `reweight` takes, those in its tuples one by one."""
    random = np.random.default_rng(seed)
    previous = random.normal(100, 20, (count, dimensions))
    arguments: Case = {
        "log_likelihood": -random.exponential(10, count),
        "proposed": previous + random.normal(0, 8, (count, dimensions)),
        "previous": previous,
        "drift": random.normal(0, 5, dimensions),
        "scale": random.uniform(1, 10, dimensions),
        "mean": random.normal(100, 20, 2),
        "root": np.array([[8.0, 0.0], [-3.0, 5.0]]),
        "share": 0.3,
    }
    return arguments | changes


def log_ratio(arguments: Case) -> Any:
    """Log of detection over dynamics, N / p, by SciPy."""
    seen = len(arguments["mean"])
    position = arguments["proposed"][:, :seen]
    moved = position - arguments["previous"][:, :seen] - arguments["drift"][:seen]
    log_p = norm.logpdf(moved, scale=arguments["scale"][:seen]).sum(axis=1)
    covariance = arguments["root"] @ arguments["root"].T
    return multivariate_normal.logpdf(position, arguments["mean"], covariance) - log_p


def reweight(k: Kernels, values: Case) -> tuple[NDArray[np.float64], float]:
    """The weights that a set of kernels gives, and the log evidence."""
    return k.reweight(**grouped(values, PARTS))


@pytest.mark.parametrize("seed", range(20))
def test_twin_weighs_the_same(seed: int) -> None:
    """Both round a dozen logs of at most `size` each, so weights agree to 32 eps size of themselves."""
    random = np.random.default_rng(seed)
    arguments = case(int(random.integers(1, 70)), int(random.integers(2, 8)), seed, share=random.uniform())
    arguments["log_likelihood"][random.random(len(arguments["log_likelihood"])) < 0.2] = -np.inf
    size = 1 + np.abs(log_ratio(arguments)).max() + 100
    native, twin = reweight(_core, arguments), reweight(reference, arguments)
    assert_allclose(native[0], twin[0], rtol=32 * EPSILON * size, atol=1e-300)
    assert_allclose(native[1], twin[1], atol=32 * EPSILON * size)


@pytest.mark.parametrize("seen", [1, 2, 4])
def test_equation_2(kernels: Kernels, seen: int) -> None:
    """Weights are L p / (share N + (1 - share) p) with SciPy's densities, the evidence is their log mean."""
    arguments = case()
    arguments["mean"] = arguments["proposed"].mean(axis=0)[:seen]
    arguments["root"] = np.tril(np.random.default_rng(seen).normal(0, 3, (seen, seen))) + 20 * np.eye(seen)
    share, log_likelihood = arguments["share"], arguments["log_likelihood"]
    expected = log_likelihood - np.log(share * np.exp(log_ratio(arguments)) + 1 - share)
    weights, log_evidence = reweight(kernels, arguments)
    assert_allclose(weights, np.exp(expected - logsumexp(expected)), rtol=1e-10)
    assert_allclose(log_evidence, logsumexp(expected) - np.log(40), rtol=1e-10)


def test_posterior_of_a_gaussian(kernels: Kernels) -> None:
    """Proposed and weighed, evidence and mean are the Kalman filter's, whatever the detection says."""
    random, count = np.random.default_rng(5), 40_000
    measured, noise, start = np.array([14.0, 7.0]), 3.0, np.tile([10.0, 10.0], (count, 1))
    drift, scale = np.array([1.0, -1.0]), np.array([4.0, 2.0])
    detection = np.array([13.0, 8.0]), np.array([[3.0, 0.0], [1.0, 2.0]]), 0.5
    everywhere = np.full(2, -np.inf), np.full(2, np.inf)
    draws = random.normal(size=(count, 2))
    proposed = kernels.propose(start, (drift, scale), draws, detection, everywhere)
    log_likelihood = norm.logpdf(measured, proposed, noise).sum(axis=1)
    weights, log_evidence = kernels.reweight(log_likelihood, proposed, start, (drift, scale), detection)
    prediction, variance = start[0] + drift, scale**2
    truth = prediction + variance / (variance + noise**2) * (measured - prediction)
    error = np.sqrt(weights @ (proposed - truth) ** 2 * (weights**2).sum())  # one standard error
    assert np.all(np.abs(weights @ proposed - truth) < 4 * error)
    evidence = norm.logpdf(measured, prediction, np.sqrt(variance + noise**2)).sum()
    assert abs(log_evidence - evidence) < 4 * np.sqrt((weights**2).sum() - 1 / count)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
def test_no_weight_exceeds_its_likelihood_by_much(kernels: Kernels, share: float) -> None:
    """Before normalizing w <= L / (1 - share): the mixture's promise."""
    arguments = case(500, share=share)
    weights, log_evidence = reweight(kernels, arguments)
    with np.errstate(divide="ignore"):
        log_weights = np.log(weights) + log_evidence + np.log(500)
    assert np.all(log_weights <= arguments["log_likelihood"] - np.log1p(-share) + 1e-9)


def test_without_detection_weights_are_likelihoods(kernels: Kernels) -> None:
    """With a share of 0 the dynamics cancel, whatever their scale, and the Gaussian isn't read."""
    likelihood = np.array([0.5, 0.0, 0.25, 0.25])
    nothing = {"mean": np.full(2, np.nan), "root": np.zeros((2, 2)), "share": 0.0, "scale": np.zeros(4)}
    with np.errstate(divide="ignore"):
        weights, log_evidence = reweight(kernels, case(4, log_likelihood=np.log(likelihood), **nothing))
    assert_allclose(weights, likelihood, rtol=4 * EPSILON)
    assert_allclose(log_evidence, np.log(0.25))


def test_brightness_of_the_likelihood_cancels(kernels: Kernels) -> None:
    """A constant added to every log-likelihood moves the log evidence alone, even by 10,000."""
    (weights, log_evidence), arguments = reweight(kernels, case()), case()
    arguments["log_likelihood"] -= 10_000
    shifted, lower = reweight(kernels, arguments)
    assert_allclose(shifted, weights, rtol=1e-10)
    assert_allclose(log_evidence - lower, 10_000)


def test_impossible_everywhere(kernels: Kernels) -> None:
    """Where no particle is possible the weights are uniform and the evidence is -infinity."""
    weights, log_evidence = reweight(kernels, case(log_likelihood=np.full(40, -np.inf)))
    assert_array_equal(weights, np.full(40, 1 / 40))
    assert log_evidence == -np.inf


big = st.floats(-1e300, 1e300)
small_or_big = st.one_of(st.floats(1e-300, 1e-290), st.floats(1e290, 1e300), st.just(1.0))


@pytest.mark.parametrize("name", ["native", "reference"])
@given(
    arrays(np.float64, 5, elements=st.one_of(big, st.just(-np.inf))),
    arrays(np.float64, (2, 5, 2), elements=big),
    arrays(np.float64, 2, elements=small_or_big),
    arrays(np.float64, 2, elements=small_or_big),
    st.floats(0, 1, exclude_max=True),
)
def test_never_overflows(
    name: Any, log_likelihood: Any, states: Any, scale: Any, root: Any, share: float
) -> None:
    """Any finite input, however large or small, gives weights in [0, 1] with sum 1, and no NaN."""
    nothing = np.zeros(2)
    weights, log_evidence = load(name).reweight(
        log_likelihood, states[0], states[1], (nothing, scale), (nothing, np.diag(root), share)
    )
    assert np.all((weights >= 0) & (weights <= 1))
    assert abs(weights.sum() - 1) < 1e-14
    assert not np.isnan(log_evidence)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"log_likelihood": np.zeros(39)}, r"log_likelihood: expected shape \(40,\), got \(39,\)"),
        ({"log_likelihood": np.zeros(0)}, "log_likelihood: expected at least one particle, got none"),
        ({"log_likelihood": np.full(40, np.nan)}, "log_likelihood: expected numbers below infinity, got nan"),
        ({"log_likelihood": np.full(40, np.inf)}, "log_likelihood: expected numbers below infinity, got inf"),
        ({"proposed": np.zeros((40, 1))}, r"previous: expected shape \(40, 1\), got \(40, 4\)"),
        ({"proposed": np.full((40, 4), np.nan)}, "proposed: expected finite numbers, got nan"),
        ({"previous": np.zeros((40, 5))}, r"previous: expected shape \(40, 4\), got \(40, 5\)"),
        ({"previous": np.full((40, 4), np.inf)}, "previous: expected finite numbers, got inf"),
        ({"drift": np.zeros(3)}, r"drift: expected shape \(4,\), got \(3,\)"),
        (
            {"scale": np.array([1.0, 0.0, 1.0, 1.0])},
            "scale: expected numbers above 0 where the mean has some",
        ),
        ({"scale": np.array([1.0, 1.0, 1.0, -1.0])}, "scale: expected no negative number, got -1"),
        ({"mean": np.zeros(5)}, "mean: expected 1 to 4 numbers, got 5"),
        ({"mean": np.zeros(3)}, r"root: expected shape \(3, 3\), got \(2, 2\)"),
        ({"root": np.diag([-1.0, 1.0])}, "root: expected a diagonal above 0, got -1"),
        ({"share": 1.0}, r"share: expected a number in \[0, 1\), got 1"),
    ],
)
def test_refuses_values(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        reweight(kernels, case(**changes))


@pytest.mark.parametrize("name", ["log_likelihood", "proposed", "previous", "drift", "scale", "mean", "root"])
def test_converts_nothing(name: str) -> None:
    """Single precision and strided views are named, never converted."""
    values = case()[name]
    with pytest.raises(TypeError, match=f"{name}: expected float64"):
        reweight(_core, case(**{name: values.astype(np.float32)}))
    with pytest.raises(ValueError, match=f"{name}: expected a C-contiguous"):
        reweight(_core, case(**{name: np.repeat(values, 2, axis=-1)[..., ::2]}))
