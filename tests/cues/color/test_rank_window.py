# SPDX-License-Identifier: MIT
"""The order of the pixels in one ellipse, and its correlation with rank maps."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats
from tricue import _core, reference
from tricue.kernels import Kernels

FLAT = 0.1
EPS = float(np.finfo(np.float64).eps)


def case(seed: int, n: int = 30, models: int = 2) -> list[Any]:
    """All arguments: a picture, an ellipse over its edge, a pattern, rank maps, and the least spread."""
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 256, (rng.integers(1, 40), rng.integers(1, 60), 3)).astype(np.uint8)
    ellipse = np.concatenate([rng.uniform(-10, 60, 2), rng.uniform(0, 20, 2)])
    return [image, ellipse, rng.uniform(-1, 1, (n, 2)), rng.random((models, 3, n), np.float32), FLAT]


def inner_case(seed: int, n: int = 30) -> list[Any]:
    """The same with the ellipse inside the picture."""
    arguments = case(seed, n)
    arguments[0] = np.random.default_rng(seed).integers(0, 256, (40, 60, 3)).astype(np.uint8)
    arguments[1] = np.array([30.0, 20, 12, 15])
    return arguments


@given(st.integers(0, 2**32), st.integers(1, 300), st.integers(0, 3))
def test_twin_sees_the_same(seed: int, n: int, models: int) -> None:
    """Ranks are the same bit for bit, correlations to the order of sums: each has 3 n terms of at most 1, and
    what they are divided by is at least FLAT.
    """
    arguments = case(seed, n, models)
    (native, ours), (twin, theirs) = (k.rank_window(*arguments) for k in (_core, reference))
    assert native.dtype == twin.dtype == np.float32
    assert native.shape == twin.shape == (3, n)
    assert ours.shape == theirs.shape == (models,)
    assert_array_equal(native, twin)
    assert_allclose(ours, theirs, rtol=0, atol=4 * (3 * n) ** 2 * EPS / FLAT)


def test_ranks_are_those_of_the_samples(kernels: Kernels) -> None:
    """They are color_ranks of sample_ellipses, bit for bit."""
    for seed in range(5):
        image, ellipse, pattern, *others = case(seed)
        samples = kernels.sample_ellipses(image, ellipse[None], pattern)
        ranks, _ = kernels.rank_window(image, ellipse, pattern, *others)
        assert_array_equal(ranks, kernels.color_ranks(samples)[0])


@pytest.mark.parametrize("seed", range(5))
def test_correlation_is_spearmans(kernels: Kernels, seed: int) -> None:
    """With the map of another window it is SciPy's Pearson correlation of both maps' ranks, or 0 below 0.

    Maps are float32, so their means are 1/2 to n roundings of 6e-8.
    """
    image, ellipse, pattern, *_ = inner_case(seed, n=96)
    other = np.random.default_rng(seed).integers(0, 256, (1, 3, 96)).astype(np.uint8)
    mixed = kernels.sample_ellipses(image, ellipse[None], pattern) // 3 + other // 2
    maps = kernels.color_ranks(np.concatenate([other, mixed.astype(np.uint8)]))
    ranks, correlations = kernels.rank_window(image, ellipse, pattern, maps, FLAT)
    expected = [max(stats.pearsonr(ranks.ravel(), each.ravel()).statistic, 0) for each in maps]
    assert_allclose(correlations, expected, atol=1e-5)
    assert correlations[1] > 0.2


def test_itself_and_its_reverse(kernels: Kernels) -> None:
    """A window correlates with its own map by 1, with that of the inverted picture by 0."""
    *window, maps, _ = inner_case(3)
    image, *where = window
    maps = np.stack([kernels.rank_window(each, *where, maps, FLAT)[0] for each in (image, ~image)])
    _, correlations = kernels.rank_window(*window, maps, FLAT)
    assert correlations[0] == pytest.approx(1, abs=1e-6)
    assert correlations[1] == 0


def test_flat_windows_have_no_order(kernels: Kernels) -> None:
    """A uniform picture, and a uniform map, correlate with nothing, not even with themselves."""
    image, ellipse, pattern, maps, _ = inner_case(4)
    even = np.full((1, 3, 30), 0.5, np.float32)
    for picture, models in ((np.full_like(image, 7), np.concatenate([even, maps])), (image, even)):
        _, correlations = kernels.rank_window(picture, ellipse, pattern, models, FLAT)
        assert not correlations.any()


BAD: list[tuple[int, Any, str]] = [
    (0, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (1, np.full(4, np.nan), "ellipse: expected finite numbers, got nan"),
    (1, np.zeros(5), "ellipse: expected"),
    (2, np.zeros((30, 3)), "pattern: expected shape"),
    (2, np.full((30, 2), np.inf), "pattern: expected finite numbers, got inf"),
    (3, np.full((2, 3, 30), 1.5, np.float32), r"models: expected ranks in \[0, 1\], got 1.5"),
    (3, np.zeros((2, 3, 29), np.float32), "models: expected"),
    (4, -1.0, "flat: expected a number from 0, got -1"),
    (4, np.nan, "flat: expected a number from 0, got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: int, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = case(0)
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        kernels.rank_window(*arguments)


def test_refuses_to_rank_nothing(kernels: Kernels) -> None:
    """Without places there is no order."""
    arguments = case(0)
    arguments[2], arguments[3] = np.zeros((0, 2)), np.zeros((2, 3, 0), np.float32)
    with pytest.raises(ValueError, match="pattern: expected at least one place, got none"):
        kernels.rank_window(*arguments)


@pytest.mark.parametrize("place", [0, 1, 2, 3])
def test_native_refuses_other_types(place: int) -> None:
    """No argument is converted."""
    arguments = case(0)
    arguments[place] = arguments[place].astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.rank_window(*arguments)
