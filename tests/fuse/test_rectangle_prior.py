# SPDX-License-Identifier: MIT
"""What is known of rectangles before they are looked at."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import norm
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import grouped

Floats = NDArray[np.float64]
Case = dict[str, Any]
PARTS = {"mean_size": ("size", "spread"), "measured": ("state", "deviation", "max_cost")}
EPS = float(np.finfo(np.float64).eps)


def case(count: int = 40, dimensions: int = 5, seed: int = 0, **changes: Any) -> Case:
    """Values that `rectangle_prior` takes: states near a mean size and a measured state, part by part."""
    rng = np.random.default_rng(seed)
    states = rng.normal(0, 1, (count, dimensions))
    states[:, -2:] = rng.uniform(0.1, 3, (count, 2))
    arguments: Case = {
        "states": states,
        "size": rng.uniform(0.3, 2, 2),
        "spread": rng.uniform(0.1, 0.5, 2),
        "state": rng.normal(0, 1, dimensions),
        "deviation": rng.uniform(0.05, 1, dimensions),
        "max_cost": 12.0,
    }
    return arguments | changes


def rectangle_prior(k: Kernels, values: Case) -> Floats:
    """The prior that a set of kernels gives."""
    return k.rectangle_prior(**grouped(values, PARTS))


@given(st.integers(0, 2**32), st.integers(0, 40), st.integers(2, 9), st.floats(0, 1e6) | st.just(np.inf))
def test_twin_knows_the_same(seed: int, count: int, dimensions: int, most: float) -> None:
    """Native and reference agree for any N and D: of D + 2 squares, all of one sign, each is rounded twice
    but for its logarithm, which two libraries compute to 4 ulps; and their sum D + 2 times.
    """
    arguments = case(count, dimensions, seed, max_cost=most)
    native, twin = (rectangle_prior(k, arguments) for k in (_core, reference))
    assert native.shape == (count,)
    assert_allclose(native, twin, rtol=(2 * 4 + 4 + dimensions + 2) * EPS)


def test_agrees_with_densities(kernels: Kernels) -> None:
    """Without a limit it is the logarithm of log-normal densities of the sizes, and normal ones of the state,
    SciPy's, each over its density at its mode.
    """
    arguments = case(30, max_cost=np.inf)
    states, size, spread, state, deviation, _ = arguments.values()
    # The mode of log(s / size), not of s: without the 1 / s of the change of variables.
    expected = norm.logpdf(np.log(states[:, 3:]), np.log(size), spread) - norm.logpdf(0, 0, spread)
    measured = norm.logpdf(states, state, deviation) - norm.logpdf(0, 0, deviation)
    assert_allclose(
        rectangle_prior(kernels, arguments), expected.sum(axis=1) + measured.sum(axis=1), rtol=1e-12
    )


@pytest.mark.parametrize(("least", "most"), [(-1e-9, 1e-9), (-1.0, 1.0), (-300.0, 300.0), (-323.0, 308.0)])
def test_sizes_of_any_magnitude(kernels: Kernels, least: float, most: float) -> None:
    """Logarithms are NumPy's to 4 ulps: of sizes next to the mean one, far from it, and subnormal."""
    size = 10.0 ** np.linspace(least, most, 101)
    states = np.column_stack([size, size])
    nothing = np.zeros(2), np.full(2, np.inf), 0.0
    found = kernels.rectangle_prior(states, (np.ones(2), np.ones(2)), nothing)
    assert_allclose(found, -(np.log(size) ** 2), rtol=(2 * 4 + 3) * EPS)


def test_example_by_hand(kernels: Kernels) -> None:
    """One deviation off costs half a nat, two cost two, of size or state, and a far state costs the most."""
    size, spread = np.array([0.5, 2.0]), np.array([0.25, 0.5])
    state, deviation = np.array([1.0, 0.5, 2.0]), np.array([0.5, np.inf, np.inf])
    at = np.array([1.0, 0.5, 2.0])
    states = np.array(
        [
            at,
            at * [1, np.exp(0.25), 1],
            at * [1, 1, np.exp(-1)],
            at + [1, 0, 0],
            at - [50, 0, 0],
            at * [51, 1, np.exp(0.5)],
        ]
    )
    prior = kernels.rectangle_prior(states, (size, spread), (state, deviation, 3.0))
    assert_allclose(prior, [0, -0.5, -2, -2, -3, -3.5], rtol=8 * EPS)


def test_twice_is_as_far_as_half(kernels: Kernels) -> None:
    """Sizes count by their ratio to the mean: twice and half of it cost the same, and scale by two changes
    nothing.
    """
    unmeasured = {"deviation": np.full(2, np.inf)}
    sizes = case(20, 2, **unmeasured)
    prior = rectangle_prior(kernels, sizes)
    mirrored = rectangle_prior(kernels, sizes | {"states": sizes["size"] ** 2 / sizes["states"]})
    assert_allclose(prior, mirrored, rtol=20 * EPS, atol=20 * EPS)
    twice = rectangle_prior(kernels, sizes | {"states": 2 * sizes["states"], "size": 2 * sizes["size"]})
    assert_array_equal(prior, twice)


@given(st.integers(0, 2**32), st.floats(0, 20))
def test_costs_at_most_the_most(seed: int, most: float) -> None:
    """A measured state costs from nothing to ``most``, whatever its deviation, and at the best both are at
    their best: no prior is above 0.
    """
    measured = case(30, seed=seed, max_cost=most)
    nothing = measured | {"deviation": np.full(5, np.inf)}
    sharp = measured | {"deviation": np.full(5, 1e-300)}
    for kernels in (_core, reference):
        alone = rectangle_prior(kernels, nothing)
        cost = alone - rectangle_prior(kernels, measured)
        assert cost.min() >= 0
        assert cost.max() <= most + 50 * EPS * np.abs(alone).max()
        assert_allclose(alone - rectangle_prior(kernels, sharp), most, rtol=1e-9, atol=1e-9)
        assert alone.max() <= 0


@pytest.mark.parametrize(
    "unmeasured", [{"deviation": np.full(5, np.inf)}, {"max_cost": 0.0}], ids=["wide", "free"]
)
def test_not_measured(kernels: Kernels, unmeasured: Case) -> None:
    """Infinite deviations, or a cost of at most nothing, leave the sizes alone: the state isn't seen."""
    here, there = case(**unmeasured), case(**unmeasured, state=np.full(5, 7.0))
    assert_array_equal(rectangle_prior(kernels, here), rectangle_prior(kernels, there))
    average = here | {"states": np.column_stack([here["states"][:, :3], np.tile(here["size"], (40, 1))])}
    assert_array_equal(rectangle_prior(kernels, average), 0)


def test_each_by_itself(kernels: Kernels) -> None:
    """A state's prior is its own in any company, and inputs stay as they are."""
    arguments = case(12)
    before = arguments["states"].copy()
    together = rectangle_prior(kernels, arguments)
    alone = [rectangle_prior(kernels, arguments | {"states": before[[i]]})[0] for i in range(12)]
    assert_allclose(together, alone, rtol=(2 * 4 + 4 + 7) * EPS)  # NumPy's loops for one and for many differ
    assert_array_equal(arguments["states"], before)


BAD_VALUES: list[tuple[Case, str]] = [
    ({"states": np.ones((3, 1))}, "states: expected 2 columns or more, got 1"),
    ({"states": np.full((3, 5), np.nan)}, "states: expected finite numbers, got nan"),
    ({"states": np.ones((3, 5)) * [1, 1, 1, 0, 1]}, "states: expected sizes above 0, got 0"),
    ({"states": np.ones((3, 5)) * [1, 1, 1, 1, -2]}, "states: expected sizes above 0, got -2"),
    ({"states": np.ones((3, 4))}, r"state: expected shape \(4,\), got \(5,\)"),
    ({"size": np.ones(3)}, r"size: expected shape \(2,\), got \(3,\)"),
    ({"size": np.array([1.0, np.inf])}, "size: expected finite numbers, got inf"),
    ({"size": np.array([1.0, 0])}, "size: expected numbers above 0, got 0"),
    ({"spread": np.ones(1)}, r"spread: expected shape \(2,\), got \(1,\)"),
    ({"spread": np.array([1.0, np.nan])}, "spread: expected finite numbers, got nan"),
    ({"spread": np.array([-1.0, 1])}, "spread: expected numbers above 0, got -1"),
    ({"state": np.zeros(4)}, r"state: expected shape \(5,\), got \(4,\)"),
    ({"state": np.full(5, -np.inf)}, "state: expected finite numbers, got -inf"),
    ({"deviation": np.ones(6)}, r"deviation: expected shape \(5,\), got \(6,\)"),
    ({"deviation": np.zeros(5)}, "deviation: expected numbers above 0, got 0"),
    ({"deviation": np.full(5, np.nan)}, "deviation: expected numbers above 0, got nan"),
    ({"max_cost": -1.0}, "max_cost: expected a number of at least 0, got -1"),
    ({"max_cost": np.nan}, "max_cost: expected a number of at least 0, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD_VALUES)
def test_refuses_values(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        rectangle_prior(kernels, case(3, **changes))


@pytest.mark.parametrize("name", ["states", "size", "spread", "state", "deviation"])
def test_converts_nothing(name: str) -> None:
    """Single precision and strided views are named, never converted."""
    values = case()[name]
    with pytest.raises(TypeError, match=f"{name}: expected float64"):
        rectangle_prior(_core, case(**{name: values.astype(np.float32)}))
    with pytest.raises(ValueError, match=f"{name}: expected a C-contiguous"):
        rectangle_prior(_core, case(**{name: np.repeat(values, 2, axis=-1)[..., ::2]}))
