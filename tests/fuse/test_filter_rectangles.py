# SPDX-License-Identifier: MIT
"""A step of the particle filter on rectangles: one call for stages that have tests of their own."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import with_parts

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
Case = dict[str, Any]
CAMERA = np.array([100.0, 101, 39.5, 29.5])
STATE = np.array([0.1, -0.05, 2.0, 0.4, 0.7])
LEVELS = 32
PLACES = (14, 10, 1.25, 12)
PARTS = {
    "before": ("particles", "weights", "offset"),
    "detection": ("mean", "root", "share"),
    "likelihood": (
        *("model", "middle", "span", "places", "reach", "occluder_margin"),
        *("linear", "sharpness", "contrast"),
    ),
    "prior": ("mean_size", "measured"),
}


def picture(seed: int = 0) -> Depth:
    """A box of 20x35 pixels at 2 m, which STATE is, before a wall, with noise and gaps."""
    rng = np.random.default_rng(seed)
    depth = np.full((60, 80), 4.0, np.float32)
    depth[10:45, 35:55] = 2.0
    depth += rng.normal(0, 0.03, depth.shape).astype(np.float32)
    depth[rng.random(depth.shape) < 0.1] = np.nan
    return depth


def case(seed: int = 0, count: int = 40, **changes: Any) -> Case:
    """All arguments, with some of them changed."""
    rng = np.random.default_rng(seed)
    usual: Case = {
        "depth": picture(seed),
        "camera": CAMERA,
        "before": (
            rng.normal(STATE, [0.1, 0.1, 0.1, 0.02, 0.02], (count, 5)),
            rng.dirichlet(np.ones(count)),
            float(rng.random()),
        ),
        "noise": rng.standard_normal((2, count, 5)),
        "dynamics": (np.array([0.01, 0, 0.02, 0, 0]), np.array([0.05, 0.04, 0.05, 0.03, 0.03])),
        "bounds": (
            np.array([-np.inf, -np.inf, 0.3, 0.1, 0.1]),
            np.array([np.inf, np.inf, 8, np.inf, np.inf]),
        ),
        "detection": (STATE, np.diag([0.05, 0.06, 0.06, 0.06, 0.08]), 0.4),
        "refinement": (np.array([0.06, 0.05, 0.05, 0.02, 0.03]), 0.1),
        "likelihood": (rng.dirichlet(np.ones(LEVELS)), 0.0, 0.5, PLACES, 0.5, 0.3, False, 30.0, 8.0),
        "prior": ((np.array([0.4, 0.7]), np.array([0.25, 0.2])), (STATE, np.full(5, 0.07), 12.0)),
    }
    return with_parts(usual, PARTS, changes)


def assert_same(arguments: Case) -> None:
    """Log-likelihoods of up to 100 nats are rounded, and so are the sums of the estimate: 1e-11 of the
    weights and of what follows from them.
    """
    native, twin = (k.filter_rectangles(**arguments) for k in (_core, reference))
    for one, other in zip(native, twin, strict=True):
        assert one.shape == other.shape
        assert_allclose(one, other, rtol=1e-11, atol=1e-13)


@given(
    st.integers(0, 2**32),
    st.integers(1, 20),
    st.booleans(),
    st.booleans(),
    st.sampled_from([(0.0, 0.5), (3.0, 2.9)]),
    st.sampled_from([0.0, 0.4]),
)
def test_twin_follows_alike(
    seed: int, count: int, twice: bool, linear: bool, levels: tuple[float, float], share: float
) -> None:
    """Native and reference agree, with one or two samplings, each likelihood, and a detection or none."""
    noise, (middle, span) = case(seed, count)["noise"][: 1 + twice], levels
    assert_same(case(seed, count, noise=noise, linear=linear, middle=middle, span=span, share=share))


def test_is_what_its_stages_are() -> None:
    """The native kernel returns what the native stages, called one by one, return: the same bits."""
    arguments = case()
    model, _, _, _, reach, occluder_margin, *_ = arguments["likelihood"]
    view, prior = ((model, reach), PLACES, occluder_margin), arguments["prior"]

    def log_likelihood(states: Floats) -> Floats:
        seen = _core.depth_contrast(arguments["depth"], CAMERA, states, *view)
        likeness = -30.0 * seen[:, 0] * seen[:, 0] + 8.0 * (seen[:, 1] - seen[:, 3])
        return likeness + _core.rectangle_prior(states, *prior)

    particles, weights, offset = arguments["before"]
    previous = particles[_core.resample(weights, offset)]
    dynamics, detection = arguments["dynamics"], arguments["detection"]
    first = _core.propose(previous, dynamics, arguments["noise"][0], detection, arguments["bounds"])
    weights, _ = _core.reweight(log_likelihood(first), first, previous, dynamics, detection)
    mean, *_ = _core.summarize(first, weights)
    spread, min_size = arguments["refinement"]
    close = mean + spread * arguments["noise"][1]
    np.maximum(close[:, 3:], min_size, out=close[:, 3:])
    weights, _ = _core.reweight(
        log_likelihood(close), close, close, (dynamics[0], spread), (*detection[:2], 0.0)
    )
    mean, covariance, _ = _core.summarize(close, weights)
    found = _core.filter_rectangles(**arguments)
    for one, other in zip(found, (close, weights, mean, covariance), strict=False):
        assert_array_equal(one, other)
    observed = _core.depth_contrast(arguments["depth"], CAMERA, mean[None], *view)
    assert_array_equal(found[4], observed[0])


@pytest.mark.parametrize(("levels", "reach"), [((0.0, 0.5), 0.03), ((0.0, 0.03), 0.5), ((2.0, 0.5), 0.03)])
def test_levels_and_reach_differ(kernels: Kernels, levels: tuple[float, float], reach: float) -> None:
    """The distance and the histogram are those over the model's levels, the shares those within the reach."""
    middle, span = levels
    arguments = case(middle=middle, span=span, reach=reach)
    _, _, state, _, observed, histogram = kernels.filter_rectangles(**arguments)
    depth, (model, *_), per_meter = arguments["depth"], arguments["likelihood"], CAMERA[:2] / state[2]
    (shares,) = kernels.depth_contrast(depth, CAMERA, state[None], (model, reach), PLACES, 0.3)
    assert_allclose(observed[1:], shares[1:], rtol=1e-12)
    place = state[:2] * per_meter + (CAMERA[2:] + 0.5)
    rectangle = np.array([*place, *(state[3:] * per_meter), middle or state[2]])
    v, u = np.meshgrid(*((2 * np.arange(n) + 1) / n - 1 for n in (14, 10)), indexing="ij")
    places = np.column_stack([u.ravel(), v.ravel()])
    distance = kernels.depth_distance(depth, rectangle[None], (model, span), places, 0.3)[0, 0]
    assert_allclose(observed[0], distance, rtol=1e-12)
    assert_allclose(histogram, kernels.rectangle_histogram(depth, rectangle, LEVELS, places, span))


def test_finds_the_box(kernels: Kernels) -> None:
    """Particles up to 0.2 m away come to the box within 4 cm, as the contrast alone says where it ends; the
    histogram there is that of the box's noise.
    """
    away = STATE + np.array([0.15, -0.1, 0.1, 0.05, 0.05])
    model = np.zeros(LEVELS)
    model[LEVELS // 2 - 3 : LEVELS // 2 + 3] = 1 / 6
    estimate = away
    arguments = case(count=200, model=model, measured=(STATE, np.full(5, np.inf), 0.0), share=0.0)
    particles, weights, offset = np.tile(away, (200, 1)), np.full(200, 1 / 200), arguments["before"][2]
    for _ in range(4):
        arguments["before"] = particles, weights, offset
        particles, weights, estimate, _, observed, histogram = kernels.filter_rectangles(**arguments)
    assert_allclose(estimate[:3], STATE[:3], atol=0.04)
    assert observed[1] > 0.8
    assert histogram[LEVELS // 2 - 5 : LEVELS // 2 + 5].sum() > 0.9


def test_nothing_in_sight(kernels: Kernels) -> None:
    """Before an image without any depth the weights are those of the prior, and the histogram is empty."""
    nowhere = case(depth=np.full((60, 80), np.nan, np.float32), detection=(STATE, np.eye(5), 0.0))
    particles, weights, mean, _, observed, histogram = kernels.filter_rectangles(**nowhere)
    prior = kernels.rectangle_prior(particles, *nowhere["prior"])
    expected = np.exp(prior - prior.max())
    assert_allclose(weights, expected / expected.sum(), rtol=1e-9)
    assert_allclose(mean, weights @ particles, rtol=1e-9)
    assert_array_equal(observed, [1, 0, 0, 0])
    assert not histogram.any()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"particles": np.ones((40, 4))}, r"particles: expected shape \(40, 5\), got \(40, 4\)"),
        ({"particles": np.full((40, 5), np.nan)}, "particles: expected finite numbers, got nan"),
        ({"offset": 1.0}, r"offset: expected a number in \[0, 1\), got 1"),
        ({"noise": np.zeros((3, 40, 5))}, "noise: expected 1 to 2, got 3"),
        ({"noise": np.zeros((2, 9, 5))}, r"noise: expected shape \(40, 5\), got \(9, 5\)"),
        ({"noise": np.full((1, 40, 5), np.inf)}, "noise: expected finite numbers, got inf"),
        ({"refinement": (np.ones(4), 0.1)}, r"scale: expected shape \(5,\), got \(4,\)"),
        ({"refinement": (-np.ones(5), 0.1)}, "scale: expected no negative number, got -1"),
        ({"refinement": (np.ones(5), 0.0)}, "min_size: expected a finite number above 0, got 0"),
        ({"middle": -1.0}, "middle: expected a finite number, not negative, got -1"),
        ({"span": 0.0}, "reach: expected a finite number above 0, got 0"),
        ({"reach": -1.0}, "reach: expected a finite number above 0, got -1"),
        ({"sharpness": np.nan}, "sharpness: expected a finite number, got nan"),
        ({"linear": True, "contrast": np.inf}, "contrast: expected a finite number, got inf"),
        ({"places": (0, 10, 1.25, 12)}, "rows: expected 1 to 64, got 0"),
        ({"model": np.ones(3)}, "model: expected a sum of 1, or of 0, got 3"),
    ],
)
def test_refuses(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        kernels.filter_rectangles(**case(**changes))


@pytest.mark.parametrize("name", ["depth", "camera", "particles", "weights", "noise", "model"])
def test_converts_nothing(name: str) -> None:
    """Another type is named, not converted."""
    usual = case()
    arrays = {"particles": usual["before"][0], "weights": usual["before"][1], "model": usual["likelihood"][0]}
    other = (usual | arrays)[name].astype(np.float16)
    with pytest.raises(TypeError, match=f"{name}: expected .*float16"):
        _core.filter_rectangles(**case(**{name: other}))


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"before": (np.ones((40, 5)), 0.5)}, ValueError, "before: expected a tuple of 3, got one of 2"),
        ({"offset": None}, TypeError, "before: expected a number in it, got NoneType"),
        ({"places": [14, 10, 1.25, 12]}, TypeError, "likelihood: expected a tuple in it, got list"),
        ({"places": (14.0, 10, 1.25, 12)}, TypeError, "places: expected an integer in it, got float"),
        ({"linear": "linear"}, TypeError, "likelihood: expected True or False in it, got str"),
        ({"measured": (STATE, 12.0)}, ValueError, "measured: expected a tuple of 3, got one of 2"),
    ],
)
def test_native_says_what_is_wrong_in_a_tuple(changes: Case, error: type[Exception], message: str) -> None:
    """Its size, or a part of another type, is named."""
    with pytest.raises(error, match=message):
        _core.filter_rectangles(**case(**changes))


def test_close_draws_stay_beyond_the_nearest_depth(kernels: Kernels) -> None:
    """Around a target just beyond the lower bound of Z the second sampling goes no nearer."""
    near = STATE * [1, 1, 0.155, 1, 1]
    found = kernels.filter_rectangles(
        **case(3, particles=np.tile(near, (40, 1)), detection=(near, np.diag([0.05] * 5), 0.4))
    )
    assert found[0][:, 2].min() == 0.3
