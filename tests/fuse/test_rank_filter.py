# SPDX-License-Identifier: MIT
"""One step of the color particle tracker's filter."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid, ring

EPS = float(np.finfo(np.float64).eps)
SHARPNESS, CONTRAST_WEIGHT = 20.0, 8.0
IMAGE, PARTICLES, LOG_WEIGHTS, NOISE, LOOK = 0, 1, 2, 3, slice(11, None)


def case(seed: int, count: int = 20, share: float = 0.3, nearest: bool = False) -> list[Any]:
    """All arguments: a picture, particles in it, how they move, where they are detected, and the look."""
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 256, (40, 60, 3)).astype(np.uint8)
    particles = rng.normal([30, 20, 9, 11], [4, 4, 1, 1], (count, 4))
    noise = rng.standard_normal((count, 4))
    drift, scale = rng.normal(size=4), np.array([3.0, 2.0, 0.5, 0.4])
    lower, upper = np.array([5.0, 5, 2, 2]), np.array([50.0, 35, 20, 20])
    mean, root = np.array([33.0, 22.0]), np.array([[4.0, 0.0], [1.0, 3.0]])
    inside, around = grid(5, 4), ring(9, 1.3, 1.8)
    maps, table = rng.random((2, 3, 20), np.float32), rng.random((4, 4, 4), np.float32)
    moves = [drift, scale, lower, upper, mean, root, share]
    look = [inside, around, maps, np.array([0.7, 0.3]), nearest, table, SHARPNESS, CONTRAST_WEIGHT]
    return [image, particles, -rng.random(count), noise, *moves, *look]


@given(st.integers(0, 2**32), st.integers(1, 40), st.sampled_from([0.0, 0.1, 0.9]), st.booleans())
def test_twin_steps_the_same(seed: int, count: int, share: float, nearest: bool) -> None:
    """Particles agree to a few roundings, what follows of them to some hundred: the terms of a log weight
    are below 100, and a weighted mean changes by the extent of the particles, below 50, times that of the
    weights.

    A sample that crosses the border of a pixel would change more; places are rounded to float32, 4e-6 px, in
    both alike, and particles differ by 1e-14.
    """
    arguments = case(seed, count, share, nearest)
    native, twin = _core.rank_filter(*arguments), reference.rank_filter(*arguments)
    assert [np.shape(each) for each in native] == [np.shape(each) for each in twin]
    assert_allclose(native[0], twin[0], rtol=0, atol=50 * 8 * EPS)
    assert_allclose(native[1], twin[1], rtol=100 * 50 * EPS, atol=EPS)
    assert_allclose(native[2], twin[2], rtol=100 * 200 * EPS)
    assert_allclose(native[3], twin[3], rtol=0, atol=50 * 100 * 50 * EPS)
    assert_allclose(native[4], twin[4], rtol=0, atol=100 * 50 * EPS)


@pytest.mark.parametrize("share", [0.0, 0.3])
@pytest.mark.parametrize("nearest", [False, True])
def test_joins_the_kernels_that_it_stands_for(kernels: Kernels, share: float, nearest: bool) -> None:
    """It is propose, rank_likelihood plus log_weights, reweight, summarize, rank_likelihood, bit for bit."""
    arguments = case(1, 100, share, nearest)
    image, particles, log_weights, noise, drift, scale, lower, upper, *detection = arguments[:11]
    look = arguments[LOOK]
    moved = kernels.propose(particles, drift, scale, noise, *detection, lower, upper)
    likelihood = kernels.rank_likelihood(image, moved, *look) + log_weights
    weights, _ = kernels.reweight(likelihood, moved, particles, drift, scale, *detection)
    ellipse, _, effective = kernels.summarize(moved, weights)
    its_own = kernels.rank_likelihood(image, ellipse[None], *look)[0]
    for ours, expected in zip(
        kernels.rank_filter(*arguments), (moved, weights, effective, ellipse, its_own), strict=True
    ):
        assert_array_equal(ours, expected)


def test_finds_the_disk(kernels: Kernels) -> None:
    """Particles around a red disk on blue, with a table that is 1 for red: their mean is nearer to it than
    before, and equal weights don't change it.
    """
    y, x = np.indices((80, 80)) - 40
    image: NDArray[np.uint8] = np.where((x**2 + y**2 < 144)[..., None], [0, 0, 255], [255, 0, 0]).astype(
        np.uint8
    )
    arguments = case(2, 200, 0.0)
    rng = np.random.default_rng(0)
    particles = np.concatenate([rng.normal(46, 4, (200, 2)), np.full((200, 2), 12.0)], axis=1)
    table = np.zeros((2, 2, 2), np.float32)
    table[0, 0, 1] = 1
    arguments[:4] = image, particles, np.zeros(200), np.zeros((200, 4))
    arguments[4:8] = np.zeros(4), np.ones(4), np.full(4, -np.inf), np.full(4, np.inf)
    arguments[16] = table
    moved, weights, effective, ellipse, _ = kernels.rank_filter(*arguments)
    assert_array_equal(moved, particles)
    assert np.hypot(*(ellipse[:2] - 40.5)) < 0.5 * np.hypot(*(particles[:, :2].mean(axis=0) - 40.5))
    assert 1 <= effective < 200
    arguments[LOG_WEIGHTS] = np.full(200, -5.0)
    assert_allclose(kernels.rank_filter(*arguments)[1], weights, rtol=1e-12)


def test_a_weightless_particle_stays_so(kernels: Kernels) -> None:
    """A log weight of -infinity gives the weight 0, whatever the image says."""
    arguments = case(3)
    arguments[LOG_WEIGHTS][7] = -np.inf
    _, weights, *_ = kernels.rank_filter(*arguments)
    assert weights[7] == 0
    assert weights.sum() == pytest.approx(1, abs=1e-12)


BAD: list[tuple[int, Any, str]] = [
    (IMAGE, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (PARTICLES, np.zeros((0, 4)), "particles: expected at least one, got none"),
    (PARTICLES, np.zeros((20, 5)), "particles: expected shape"),
    (PARTICLES, np.full((20, 4), np.nan), "particles: expected finite numbers, got nan"),
    (LOG_WEIGHTS, np.zeros(19), "log_weights: expected"),
    (LOG_WEIGHTS, np.full(20, 0.5), "log_weights: expected numbers up to 0, got 0.5"),
    (LOG_WEIGHTS, np.full(20, np.nan), "log_weights: expected numbers up to 0, got nan"),
    (NOISE, np.zeros((19, 4)), "noise: expected"),
    (5, -np.ones(4), "scale: expected no negative number"),
    (6, np.full(4, 99.0), "lower: expected no number above upper"),
    (10, 1.0, r"share: expected a number in \[0, 1\), got 1"),
    (13, np.zeros((2, 3, 19), np.float32), "models: expected"),
    (14, np.ones(3), "shares: expected"),
    (17, np.nan, "sharpness: expected a finite number, got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: int, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = case(0)
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        kernels.rank_filter(*arguments)


@pytest.mark.parametrize("place", [*range(10), *range(11, 15), 16])
def test_native_refuses_other_types(place: int) -> None:
    """No argument is converted."""
    arguments = case(0)
    arguments[place] = arguments[place].astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.rank_filter(*arguments)
