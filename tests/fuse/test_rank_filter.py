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

from tests.kernel_arguments import Place, argument, with_argument

EPS = float(np.finfo(np.float64).eps)
SHARPNESS, CONTRAST_WEIGHT = 20.0, 8.0
IMAGE, LAST, NOISE, DYNAMICS, BOUNDS, DETECTION, PATTERN, APPEARANCE, FACTORS, FLAT = range(10)
PARTICLES, WEIGHTS, OFFSET = (LAST, 0), (LAST, 1), (LAST, 2)
WHITE, CORRELATION = (NOISE, 0), (NOISE, 1)
SHARE = DETECTION, 2
STILL, UNBOUNDED = ((0.0,) * 4, (1.0,) * 4), ((-np.inf,) * 4, (np.inf,) * 4)
FLATNESS = 0.1


def case(
    seed: int, count: int = 20, share: float = 0.3, nearest: bool = False, offset: float | None = None
) -> list[Any]:
    """A picture, particles in it, how they move, where they are detected, and what the target looks like."""
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 256, (40, 60, 3)).astype(np.uint8)
    particles = rng.normal([30, 20, 9, 11], [4, 4, 1, 1], (count, 4))
    noise = rng.standard_normal((count, 4))
    dynamics = tuple(rng.normal(size=4).tolist()), (3.0, 2.0, 0.5, 0.4)
    bounds = (5.0, 5.0, 2.0, 2.0), (50.0, 35.0, 20.0, 20.0)
    detection = (33.0, 22.0), (4.0, 1.0, 3.0), share
    maps, table = rng.random((2, 3, 20), np.float32), rng.random((4, 4, 4), np.float32)
    appearance = maps, np.array([0.7, 0.3]), nearest, table
    return [
        image,
        (particles, rng.random(count) + 0.01, offset),
        (noise, 0.6),
        dynamics,
        bounds,
        detection,
        (grid(5, 4), ring(9, 1.3, 1.8)),
        appearance,
        (SHARPNESS, CONTRAST_WEIGHT),
        FLATNESS,
    ]


@given(
    st.integers(0, 2**32),
    st.integers(1, 40),
    st.sampled_from([0.0, 0.1, 0.9]),
    st.booleans(),
    st.none() | st.floats(0, 0.99),
)
def test_twin_steps_the_same(
    seed: int, count: int, share: float, nearest: bool, offset: float | None
) -> None:
    """Particles agree to a few roundings, what follows of them to some hundred: the terms of a log weight
    are below 100, and a weighted mean changes by the extent of the particles, below 50, times that of the
    weights.

    A sample that crosses the border of a pixel would change more; places are rounded to float32, 4e-6 px, in
    both alike, and particles differ by 1e-14.
    """
    arguments = case(seed, count, share, nearest, offset)
    native, twin = _core.rank_filter(*arguments), reference.rank_filter(*arguments)
    assert [np.shape(each) for each in native] == [np.shape(each) for each in twin]
    assert_allclose(native[0], twin[0], rtol=0, atol=50 * 8 * EPS)
    assert_allclose(native[1], twin[1], rtol=100 * 50 * EPS, atol=EPS)
    assert_allclose(native[2], twin[2], rtol=100 * 200 * EPS)
    assert_allclose(native[3], twin[3], rtol=0, atol=50 * 100 * 50 * EPS)
    assert_allclose(native[4], twin[4], rtol=0, atol=100 * 50 * EPS)
    assert_array_equal(native[5], twin[5])
    assert_allclose(native[6], twin[6], rtol=0, atol=1e-11)


@pytest.mark.parametrize("share", [0.0, 0.3])
@pytest.mark.parametrize("nearest", [False, True])
@pytest.mark.parametrize("offset", [None, 0.4])
def test_joins_the_kernels_that_it_stands_for(
    kernels: Kernels, share: float, nearest: bool, offset: float | None
) -> None:
    """Bit for bit, where the noise isn't correlated, and weights whose logarithms aren't 0 are resampled."""
    arguments = case(1, 100, share, nearest, offset)
    if offset is None:
        arguments = with_argument(arguments, WEIGHTS, np.ones(100))
    arguments = with_argument(arguments, CORRELATION, 0.0)
    image, (particles, weights, _), (noise, _), dynamics, bounds, detected, *look, _ = arguments
    mean, (first, cross, second), _ = map(np.array, detected)
    (drift, scale), (lower, upper) = map(np.array, dynamics), map(np.array, bounds)
    detection = mean, np.array([[first, 0], [cross, second]]), share
    if offset is not None:
        particles = particles[kernels.resample(weights, offset)]
    moved = kernels.propose(particles, (drift, scale), noise, detection, (lower, upper))
    likelihood = kernels.rank_likelihood(image, moved, *look)
    weights, _ = kernels.reweight(likelihood, moved, particles, (drift, scale), detection)
    ellipse, _, effective = kernels.summarize(moved, weights)
    its_own = kernels.rank_likelihood(image, ellipse[None], *look)[0]
    window = kernels.rank_window(image, ellipse, look[0][0], look[1][0], FLATNESS)
    expected = (moved, weights, effective, ellipse, its_own, *window)
    for ours, theirs in zip(kernels.rank_filter(*arguments), expected, strict=True):
        assert_array_equal(ours, theirs)


def test_noise_of_the_semi_axes_is_correlated(kernels: Kernels) -> None:
    """Of 4000 particles without drift and detection, by NumPy's corrcoef; each axis keeps its deviation."""
    arguments = case(4, 4000, 0.0)
    start = np.array([30.0, 20.0, 9.0, 11.0])
    arguments = with_argument(arguments, PARTICLES, np.tile(start, (4000, 1)))
    arguments[DYNAMICS], arguments[BOUNDS] = STILL, UNBOUNDED
    steps = kernels.rank_filter(*arguments)[0] - start
    assert_allclose(np.corrcoef(steps.T)[2, 3], 0.6, atol=4 * 0.64 / np.sqrt(4000))
    assert_allclose(steps.std(axis=0), 1, atol=4 / np.sqrt(2 * 4000))


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
    arguments[:5] = image, (particles, np.ones(200), None), (np.zeros((200, 4)), 0.6), STILL, UNBOUNDED
    arguments = with_argument(arguments, (APPEARANCE, 3), table)
    moved, weights, effective, ellipse, *_ = kernels.rank_filter(*arguments)
    assert_array_equal(moved, particles)
    assert np.hypot(*(ellipse[:2] - 40.5)) < 0.5 * np.hypot(*(particles[:, :2].mean(axis=0) - 40.5))
    assert 1 <= effective < 200
    arguments = with_argument(arguments, WEIGHTS, np.full(200, 0.01))
    assert_allclose(kernels.rank_filter(*arguments)[1], weights, rtol=1e-12)


def test_a_particle_without_weight_has_none(kernels: Kernels) -> None:
    """Its logarithm is that of 1e-300, whatever the image says; resampling doesn't choose it."""
    arguments = case(3)
    argument(arguments, WEIGHTS)[7] = 0
    _, weights, *_ = kernels.rank_filter(*arguments)
    assert 0 <= weights[7] < 1e-200
    assert weights.sum() == pytest.approx(1, abs=1e-12)
    arguments = with_argument(arguments, OFFSET, 0.5)
    arguments[NOISE], arguments[DYNAMICS] = (np.zeros((20, 4)), 0.6), STILL
    moved = kernels.rank_filter(*with_argument(arguments, SHARE, 0.0))[0]
    assert not (moved == argument(arguments, PARTICLES)[7]).all(axis=1).any()


BAD: list[tuple[Place, Any, str]] = [
    (IMAGE, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (PARTICLES, np.zeros((0, 4)), "particles: expected at least one, got none"),
    (PARTICLES, np.zeros((20, 5)), "particles: expected shape"),
    (PARTICLES, np.full((20, 4), np.nan), "particles: expected finite numbers, got nan"),
    (WEIGHTS, np.zeros(19), "weights: expected"),
    (WEIGHTS, np.zeros(20), "weights: expected"),
    (WEIGHTS, np.full(20, -0.5), "weights: expected"),
    (WEIGHTS, np.full(20, np.nan), "weights: expected"),
    (OFFSET, 1.0, r"offset: expected a number in \[0, 1\), got 1"),
    (WHITE, np.zeros((19, 4)), "white: expected"),
    (CORRELATION, 1.5, r"correlation: expected a number in \[-1, 1\], got 1.5"),
    (CORRELATION, np.nan, r"correlation: expected a number in \[-1, 1\], got nan"),
    ((DYNAMICS, 1), (-1.0,) * 4, "scale: expected no negative number"),
    ((BOUNDS, 0), (99.0,) * 4, "lower: expected no number above upper"),
    (SHARE, 1.0, r"share: expected a number in \[0, 1\), got 1"),
    ((APPEARANCE, 0), np.zeros((2, 3, 19), np.float32), "models: expected"),
    ((APPEARANCE, 1), np.ones(3), "shares: expected"),
    ((FACTORS, 0), np.nan, "sharpness: expected a finite number, got nan"),
    (FLAT, -1.0, "flat: expected a number from 0, got -1"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.rank_filter(*with_argument(case(0), place, value))


ARRAYS: list[Place] = [IMAGE, PARTICLES, WEIGHTS, WHITE]
ARRAYS += [(PATTERN, 0), (PATTERN, 1), (APPEARANCE, 0), (APPEARANCE, 1), (APPEARANCE, 3)]


@pytest.mark.parametrize("place", ARRAYS)
def test_native_refuses_other_types(place: Place) -> None:
    """No array is converted."""
    arguments = case(0)
    other = argument(arguments, place).astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.rank_filter(*with_argument(arguments, place, other))


@pytest.mark.parametrize(
    ("place", "value", "error", "message"),
    [
        (LAST, None, TypeError, "incompatible function arguments"),
        (LAST, (1, 2), ValueError, "last: expected a tuple of 3, got one of 2"),
        (CORRELATION, "high", TypeError, "noise: expected a number in it, got str"),
        (OFFSET, "none", TypeError, "last: expected a number in it, got str"),
        ((BOUNDS, 1), np.ones(4), TypeError, "bounds: expected a tuple in it, got numpy.ndarray"),
        ((APPEARANCE, 2), 1, TypeError, "appearance: expected True or False in it, got int"),
        ((PATTERN, 1), [[0.0, 0.0]], TypeError, "around: expected a NumPy array, float64"),
    ],
)
def test_native_says_what_is_wrong_in_a_tuple(
    place: Place, value: Any, error: type[Exception], message: str
) -> None:
    """Its size, or a part of another type, is named."""
    with pytest.raises(error, match=message):
        _core.rank_filter(*with_argument(case(0), place, value))
