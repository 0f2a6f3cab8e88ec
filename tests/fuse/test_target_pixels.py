# SPDX-License-Identifier: MIT
"""Target pixels by Bayes' rule."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]
Floats = NDArray[np.float64]
Case = dict[str, Any]
EPS32 = float(np.finfo(np.float32).eps)
RANGES = [(-4.0, 4.0), (-3.0, 5.0), (0.0, 16.0)]

corners = st.floats(-20, 100) | st.integers(-3, 75).map(float)
rectangles = st.tuples(corners, corners, corners, corners)


def plane(rng: np.random.Generator, shape: tuple[int, int], low: float, high: float) -> Plane:
    """Readings beyond the range too, a fifth of them missing or infinite, some on the edges of bins."""
    values = rng.uniform(low - 1, high + 1, shape).astype(np.float32)
    values[rng.random(shape) < 0.1] = low
    missing = rng.random(shape) < 0.2
    values[missing] = rng.choice(np.array([np.nan, np.nan, np.inf, -np.inf], np.float32), shape)[missing]
    return values


def case(
    shape: tuple[int, int] = (60, 80), cues: int = 3, bins: int = 64, seed: int = 0, **changes: Any
) -> Case:
    """Arguments of `target_pixels`: densities that some bins have nothing of."""
    rng = np.random.default_rng(seed)
    height, width = shape
    densities = [rng.random(bins) * (rng.random(bins) < 0.7) for _ in range(cues)]
    arguments: Case = {
        "planes": [plane(rng, shape, *each) for each in RANGES[:cues]],
        "densities": [each / max(each.sum(), 1e-9) for each in densities],
        "ranges": RANGES[:cues],
        "window": (0.3 * width, 0.25 * height, 0.7 * width, 0.8 * height),
        "candidate": (0.1 * width, 0.05 * height, 0.85 * width, 0.95 * height),
        "threshold": 0.5,
    }
    return arguments | changes


def around(cues: int = 3, bins: int = 64, seed: int = 0) -> list[Floats]:
    """Densities of what isn't the target, of which a part lies outside the range; some bins nearly empty."""
    rng = np.random.default_rng(seed)
    shares = [rng.random(bins) * rng.choice([1, 1, 1e-9, 1e-200], bins) + 1e-300 for _ in range(cues)]
    return [each / each.sum() * rng.uniform(0.3, 1) for each in shares]


def assert_same(arguments: Case) -> None:
    """All is compared and computed alike, so to the last bit."""
    for ours, theirs in zip(*(k.target_pixels(**arguments) for k in (_core, reference)), strict=True):
        assert_array_equal(ours, theirs, strict=True)


@given(
    st.tuples(st.integers(0, 4), st.integers(0, 70)),
    st.integers(1, 3),
    st.integers(1, 90),
    st.integers(0, 2**32),
    rectangles,
    rectangles,
    st.floats(0, 1, exclude_min=True),
    st.booleans(),
)
def test_twin_decides_the_same(
    shape: tuple[int, int],
    cues: int,
    bins: int,
    seed: int,
    window: Any,
    candidate: Any,
    threshold: float,
    measured: bool,
) -> None:
    """Native and reference agree exactly, for any planes, densities, rectangles, threshold, alternatives."""
    changes = {"window": window, "candidate": candidate, "threshold": threshold}
    changes["alternatives"] = around(cues, bins, seed) if measured else None
    assert_same(case(shape, cues, bins, seed, **changes))


@pytest.mark.parametrize("bins", [63, 64, 65])  # of which up to 64 fit registers
@pytest.mark.parametrize("cues", [1, 2, 3])
def test_twin_decides_views_the_same(cues: int, bins: int) -> None:
    """They agree on parts of larger planes, whose rows are padded, each otherwise, and on a whole frame."""
    arguments = case((120, 160), cues, bins)
    assert_same(arguments)
    parts = [each[5:105, 3 + k : 3 + k + 150] for k, each in enumerate(arguments["planes"])]
    assert_same(arguments | {"planes": parts})


@pytest.mark.parametrize("cues", [1, 2, 3])
def test_agrees_with_bayes(kernels: Kernels, cues: int) -> None:
    """The posterior is P L / (P L + U) of probabilities as they are, read off by NumPy's digitize where the
    prior is 1; the rounding is float32's, of some ten operations.
    """
    whole = (0, 0, 80, 60)
    arguments = case(cues=cues, window=whole, candidate=whole)
    likelihood, uniform = np.ones((60, 80)), 1.0
    for values, density, (low, high) in zip(*list(arguments.values())[:3], strict=True):
        edges = np.linspace(low, high, 65)  # binary numbers
        at = np.digitize(np.nan_to_num(values, nan=np.inf), edges)
        likelihood *= np.concatenate([[0], density, [0]])[at] / np.diff(edges)[0]
        uniform /= high - low
    expected = likelihood / (likelihood + uniform)
    mask, posterior = kernels.target_pixels(**arguments)
    assert_allclose(posterior, expected, rtol=10 * EPS32)
    clear = abs(expected - 0.5) > 1e-5
    assert_array_equal(mask[clear], expected[clear] > 0.5)
    assert 0.01 < mask.mean() < 0.9


@pytest.mark.parametrize("cues", [1, 2, 3])
def test_agrees_with_bayes_of_two_densities(kernels: Kernels, cues: int) -> None:
    """So it is P L / (P L + A) of measured alternatives, as far as their ratio is a float."""
    whole = (0, 0, 80, 60)
    rng = np.random.default_rng(1)
    alternatives = [0.8 * each / each.sum() for each in rng.random((3, 64)) + 0.01][:cues]
    arguments = case(cues=cues, window=whole, candidate=whole, alternatives=alternatives)
    likelihood, other = np.ones((60, 80)), np.ones((60, 80))
    of_cues = zip(*list(arguments.values())[:3], alternatives, strict=True)
    for values, density, (low, high), alternative in of_cues:
        at = np.digitize(np.nan_to_num(values, nan=np.inf), np.linspace(low, high, 65))
        likelihood *= np.concatenate([[0], density, [0]])[at]
        other *= np.concatenate([[0.2], alternative, [0.2]])[at]
    _, posterior = kernels.target_pixels(**arguments)
    assert_allclose(posterior, likelihood / (likelihood + other), rtol=10 * EPS32)
    assert not np.allclose(posterior, kernels.target_pixels(**arguments | {"alternatives": None})[1])


def test_even_alternatives(kernels: Kernels) -> None:
    """Alternatives of 1 / bins, a power of two, are those that there are without, to the last bit."""
    even = {"alternatives": [np.full(64, 1 / 64)] * 3}
    for ours, theirs in zip(*(kernels.target_pixels(**case() | each) for each in (even, {})), strict=True):
        assert_array_equal(ours, theirs)


def test_what_is_as_frequent_round_the_target(kernels: Kernels) -> None:
    """Readings as frequent round the target as on it say nothing: with all of them only the prior counts."""
    density = np.arange(1, 65) / np.arange(1, 65).sum()
    same = {"densities": [density] * 3, "alternatives": [density] * 3}
    arguments = case(**same)
    _, posterior = kernels.target_pixels(**arguments)
    there = [(p >= low) & (p < high) for p, (low, high) in zip(arguments["planes"], RANGES, strict=True)]
    share = prior(kernels, (60, 80), arguments["window"], arguments["candidate"])
    assert_allclose(posterior, np.all(there, axis=0) * share / (share + 1), rtol=8 * EPS32)


def test_what_is_hardly_round_the_target(kernels: Kernels) -> None:
    """Ratios beyond any float make a pixel the target's, never NaN; one impossible cue rules it out."""
    least, whole = np.full(2, 5e-324), (0, 0, 2, 1)
    planes = [np.array([[0.1, 0.1]], np.float32), np.array([[0.1, 0.1]], np.float32)]
    planes.append(np.array([[0.1, 0.9]], np.float32))
    densities = [np.array([1.0, 0])] * 3
    _, posterior = kernels.target_pixels(planes, densities, [(0, 1)] * 3, whole, whole, 0.5, [least] * 3)
    assert_array_equal(posterior, [[1, 0]])


@pytest.mark.parametrize("measured", [False, True])
def test_says_what_is_likely(kernels: Kernels, measured: bool) -> None:
    """Drawn as the model says, target pixels from the densities, others evenly, or from the alternatives, a
    tenth of each value outside its range, P target pixels to 1 other by the prior: of pixels with a
    posterior of about q a share q belongs to the target, within four standard deviations.
    """
    rng = np.random.default_rng(0)
    shape, bins = (400, 500), 32
    arguments = case(shape, bins=bins, window=(100, 100, 400, 300), candidate=(0, 0, 500, 400))
    flat = {"densities": [np.full(bins, 1 / bins)] * 3, "planes": [np.ones(shape, np.float32)] * 3}
    share = kernels.target_pixels(**arguments | flat)[1]  # P / (P + 1): nothing but the prior
    target = rng.random(shape) < share
    peaked = np.exp(-0.5 * ((np.arange(bins) - 12) / 5) ** 2)
    peaked /= peaked.sum()
    sloping = 0.9 * np.arange(1, bins + 1) / np.arange(1, bins + 1).sum()
    others = np.append(sloping if measured else np.full(bins, 1 / bins), 0.1 * measured)
    planes = []
    for low, high in RANGES:
        at = np.where(target, rng.choice(bins, shape, p=peaked), rng.choice(bins + 1, shape, p=others))
        planes.append((low + (at + rng.random(shape)) * (high - low) / bins).astype(np.float32))
    drawn = {"planes": planes, "densities": [peaked] * 3, "alternatives": [sloping] * 3 if measured else None}
    _, posterior = kernels.target_pixels(**arguments | drawn)
    for low in np.arange(0, 1, 0.1):
        inside = (posterior >= low) & (posterior < low + 0.1)
        expected = posterior[inside].mean(dtype=float)
        deviation = np.sqrt(expected * (1 - expected) / inside.sum())
        assert inside.sum() > 1000
        assert abs(target[inside].mean() - expected) < 4 * deviation + 1e-6


def prior(kernels: Kernels, shape: tuple[int, int], window: Any, candidate: Any) -> Floats:
    """What the posterior says where values say nothing."""
    arguments = case(shape, 1, 4, window=window, candidate=candidate, densities=[np.full(4, 0.25)])
    arguments["planes"] = [np.zeros(shape, np.float32)]
    share = kernels.target_pixels(**arguments)[1].astype(float)
    return np.asarray(share / (1 - share))


def test_prior_by_hand(kernels: Kernels) -> None:
    """The prior is 1 in the window and falls linearly to 0 at the candidate region's edge, at each side by
    its own distance; the lesser of column and row counts.
    """
    found = prior(kernels, (7, 11), (4, 2, 7, 4), (0, 0, 9, 6))
    columns = [0.125, 0.375, 0.625, 0.875, 1, 1, 1, 0.75, 0.25, 0, 0]
    rows = [0.25, 0.75, 1, 1, 0.75, 0.25, 0]
    assert_allclose(found, np.minimum(*np.ix_(rows, columns)), rtol=8 * EPS32)


def test_prior_agrees_with_interpolation(kernels: Kernels) -> None:
    """Along the rows and columns through the window it is what numpy.interp has between the edges."""
    window, candidate = (20.3, 15.2, 33.4, 40.9), (-7.5, 3.1, 60.2, 70.0)
    found = prior(kernels, (64, 72), window, candidate)
    for line, (a, b) in ((found[25], (0, 2)), (found[:, 25], (1, 3))):
        edges = [candidate[a], window[a], window[b], candidate[b]]
        expected = np.interp(np.arange(len(line)) + 0.5, edges, [0, 1, 1, 0])
        assert_allclose(line, expected, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("window", [(0, 0, 9, 6), (-5, -5, 20, 20), (1e-310, 5e-324, 9, 6)])
def test_window_as_large_as_the_candidate(kernels: Kernels, window: Any) -> None:
    """Where the window reaches the candidate region's edge, over it, or nearly, nothing falls; outside it is
    0.
    """
    expected = np.zeros((7, 11))
    expected[:6, :9] = 1
    assert_allclose(prior(kernels, (7, 11), window, (0, 0, 9, 6)), expected, rtol=4 * EPS32)


def test_needs_every_cue(kernels: Kernels) -> None:
    """A pixel that lacks one value, or has one outside the range, isn't the target's, however sure the
    others are.
    """
    sure = np.zeros(8)
    sure[4] = 1
    shape = (4, 5)
    planes = [np.full(shape, low + 4.5 * (high - low) / 8, np.float32) for low, high in RANGES]
    for k, strange in enumerate((np.nan, 4.0, -np.inf)):
        planes[k][k, 2] = strange
    whole = (0, 0, 5, 4)
    mask, posterior = kernels.target_pixels(planes, [sure] * 3, RANGES, whole, whole)
    expected = np.ones(shape)
    expected[:3, 2] = 0
    assert_array_equal(mask, expected)
    assert_allclose(posterior, expected * 512 / 513, rtol=2 * EPS32)


def test_no_density(kernels: Kernels) -> None:
    """Of a density of zeros, which a histogram without values has, nothing is the target's."""
    arguments = case()
    arguments["densities"][1] = np.zeros(64)
    for found in kernels.target_pixels(**arguments):
        assert not found.any()


def test_threshold(kernels: Kernels) -> None:
    """The mask is where the posterior is at least the threshold, that very posterior included."""
    arguments = case()
    _, posterior = kernels.target_pixels(**arguments)
    for threshold in [*np.unique(posterior)[1:].tolist()[::50], 0.3, 1.0]:
        mask, same = kernels.target_pixels(**arguments | {"threshold": threshold})
        assert_array_equal(mask, posterior >= np.float64(threshold))
        assert_array_equal(same, posterior)


@given(st.integers(0, 2**32), st.integers(0, 9), st.integers(0, 9))
def test_moves_along(seed: int, right: int, down: int) -> None:
    """Moved by whole pixels, rectangles and values give the same pixels, moved."""
    arguments = case((20, 30), seed=seed, window=(8, 4, 20, 15), candidate=(5, 2, 22, 17))
    moved = arguments | {
        name: tuple(np.add(arguments[name], (right, down, right, down))) for name in ("window", "candidate")
    }
    moved["planes"] = [np.pad(each, ((down, 0), (right, 0))) for each in arguments["planes"]]
    here, there = _core.target_pixels(**arguments)[1], _core.target_pixels(**moved)[1]
    assert_array_equal(there[down:, right:], here)


def test_order_of_cues(kernels: Kernels) -> None:
    """It doesn't matter which cue comes first, to the rounding of two products."""
    arguments = case()
    turned = {name: arguments[name][::-1] for name in ("planes", "densities", "ranges")}
    here, there = (kernels.target_pixels(**arguments | each)[1] for each in ({}, turned))
    assert_allclose(here, there, rtol=4 * EPS32)


def test_leaves_inputs_alone(kernels: Kernels) -> None:
    """Nothing is written into what is passed."""
    arguments, copy = case(alternatives=around()), case(alternatives=around())
    kernels.target_pixels(**arguments)
    for name in ("planes", "densities", "alternatives"):
        for ours, theirs in zip(arguments[name], copy[name], strict=True):
            assert_array_equal(ours, theirs)


ONE = np.ones((3, 3), np.float32)
HALVES = np.array([0.5, 0.5])
BAD_VALUES: list[tuple[Case, str]] = [
    ({"planes": [], "densities": [], "ranges": []}, "planes: expected 1 to 3, got 0"),
    (
        {"planes": [ONE] * 4, "densities": [HALVES] * 4, "ranges": [(0, 1)] * 4},
        "planes: expected 1 to 3, got 4",
    ),
    ({"planes": [ONE, ONE[:2], ONE]}, r"planes: expected shape \(3, 3\), got \(2, 3\)"),
    ({"densities": [HALVES]}, "densities: expected 3, as many as planes, got 1"),
    ({"ranges": [(0.0, 1.0)]}, "ranges: expected 3, as many as planes, got 1"),
    ({"densities": [np.empty(0)] * 3}, "bins: expected 1 to 65536, got 0"),
    ({"densities": [HALVES, -HALVES, HALVES]}, "densities: expected finite numbers, none negative, got -0.5"),
    ({"densities": [np.full(2, np.nan)] * 3}, "densities: expected finite numbers, none negative, got nan"),
    ({"densities": [np.ones(2)] * 3}, "densities: expected a sum of 1, or of 0, got 2"),
    ({"alternatives": [np.full(64, 1 / 64)]}, "alternatives: expected 3, as many as planes, got 1"),
    ({"alternatives": []}, "alternatives: expected 3, as many as planes, got 0"),
    ({"alternatives": [HALVES] * 3}, r"alternatives: expected shape \(64,\), got \(2,\)"),
    ({"alternatives": [np.zeros(64)] * 3}, "alternatives: expected finite numbers above 0, got 0"),
    ({"alternatives": [np.full(64, np.nan)] * 3}, "alternatives: expected finite numbers above 0, got nan"),
    ({"alternatives": [np.full(64, np.inf)] * 3}, "alternatives: expected finite numbers above 0, got inf"),
    ({"alternatives": [np.full(64, 1 / 32)] * 3}, "alternatives: expected a sum of at most 1, got 2"),
    ({"ranges": [(np.nan, 1)] * 3}, "low: expected a finite number, got nan"),
    ({"ranges": [(0, 0)] * 3}, "high: expected a finite number above low, got 0"),
    ({"window": (0, 0, np.nan, 1)}, "window: expected finite corners, got nan"),
    ({"candidate": (0, 0, np.inf, 1)}, "candidate: expected finite corners, got inf"),
    ({"threshold": 0.0}, r"threshold: expected a number in \(0, 1\], got 0"),
    ({"threshold": 1.5}, r"threshold: expected a number in \(0, 1\], got 1.5"),
    ({"threshold": np.nan}, r"threshold: expected a number in \(0, 1\], got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD_VALUES)
def test_refuses_values(kernels: Kernels, changes: Case, message: str) -> None:
    """Each argument that doesn't fit is named, with what was expected and what came."""
    with pytest.raises(ValueError, match=message):
        kernels.target_pixels(**case((3, 3)) | changes)


BAD_ARRAYS: list[tuple[Case, type[Exception], str]] = [
    ({"planes": [ONE.astype(float)] * 3}, TypeError, "planes: expected a float32 plane"),
    ({"planes": [ONE[:, ::-1]] * 3}, ValueError, "planes: expected packed pixels"),
    ({"planes": [ONE[0]] * 3}, ValueError, r"planes: expected a float32 plane \(H, W\), got float32 \(3,\)"),
    ({"densities": [HALVES.astype(np.float32)] * 3}, TypeError, r"densities: expected float64 \(N,\)"),
    ({"densities": [np.repeat(HALVES, 2)[::2]] * 3}, ValueError, "densities: expected a C-contiguous"),
    ({"alternatives": [HALVES.astype(np.float32)] * 3}, TypeError, r"alternatives: expected float64 \(N,\)"),
    ({"alternatives": [np.ones(128)[::2]] * 3}, ValueError, "alternatives: expected a C-contiguous"),
]


@pytest.mark.parametrize(("changes", "error", "message"), BAD_ARRAYS)
def test_converts_nothing(changes: Case, error: type[Exception], message: str) -> None:
    """Another type, rank or layout is named, never converted."""
    with pytest.raises(error, match=message):
        _core.target_pixels(**case((3, 3)) | changes)
