# SPDX-License-Identifier: MIT
"""The likelihood by the order of the pixels in an ellipse and its colors against its surround."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, argument, with_argument

EPS = float(np.finfo(np.float64).eps)


SHARPNESS, CONTRAST_WEIGHT = 110.0, 8.0
IMAGE, ELLIPSES, PATTERN, APPEARANCE, FACTORS = range(5)
INSIDE, AROUND = (PATTERN, 0), (PATTERN, 1)
MODELS, SHARES, NEAREST, TABLE = ((APPEARANCE, part) for part in range(4))


def case(seed: int, ellipses: int = 5, n: int = 30, m: int = 7, models: int = 2, side: int = 16) -> list[Any]:
    """All arguments: a picture, ellipses over its edge, two patterns, rank maps, their shares, a table."""
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 256, (rng.integers(1, 40), rng.integers(1, 60), 3)).astype(np.uint8)
    places = rng.uniform(-10, 60, (ellipses, 2))
    sizes = rng.uniform(0, 20, (ellipses, 2))
    inside, around = rng.uniform(-1, 1, (n, 2)), rng.uniform(-2, 2, (m, 2))
    maps, table = rng.random((models, 3, n), np.float32), rng.random((side, side, side), np.float32)
    shares = rng.dirichlet(np.ones(models))
    return [
        image,
        np.concatenate([places, sizes], axis=1),
        (inside, around),
        (maps, shares, bool(rng.integers(2)), table),
        (SHARPNESS, CONTRAST_WEIGHT),
    ]


def rounding(n: int, m: int, models: int = 2) -> float:
    """At most: n + m roundings of a mean, M of a distance at most 1, and a few of the terms themselves."""
    return EPS * (
        CONTRAST_WEIGHT * (n + m) + SHARPNESS * 2 * (models + 2) + 4 * (SHARPNESS + CONTRAST_WEIGHT)
    )


@given(
    st.integers(0, 2**32),
    st.integers(0, 20),
    st.integers(1, 300),
    st.integers(1, 70),
    st.integers(1, 3),
    st.sampled_from([1, 2, 16, 64]),
)
def test_twin_measures_the_same(seed: int, ellipses: int, n: int, m: int, models: int, side: int) -> None:
    """They agree to the order of sums of float64."""
    arguments = case(seed, ellipses, n, m, models, side)
    native, twin = _core.rank_likelihood(*arguments), reference.rank_likelihood(*arguments)
    assert native.shape == (ellipses,)
    assert_allclose(native, twin, rtol=0, atol=rounding(n, m, models))


@pytest.mark.parametrize("view", [np.s_[3:40, 5:50], np.s_[:1, :1], np.s_[:1], np.s_[:, :1], np.s_[::2]])
def test_odd_images(view: Any) -> None:
    """Padded rows, one pixel, one row, one column, every second row: read by both alike."""
    _, *others = case(3)
    image = np.random.default_rng(0).integers(0, 256, (60, 90, 3)).astype(np.uint8)[view]
    native, twin = (k.rank_likelihood(image, *others) for k in (_core, reference))
    assert_allclose(native, twin, rtol=0, atol=rounding(30, 7))


@pytest.mark.parametrize("nearest", [False, True])
def test_joins_the_kernels_that_it_stands_for(kernels: Kernels, nearest: bool) -> None:
    """It is sample_ellipses, rank_distance and the mean of color_lookup, for 1, 8, 9 and 100 ellipses."""
    for count in (1, 8, 9, 100):
        arguments = with_argument(case(count, count), NEAREST, nearest)
        image, ellipses, pattern, (maps, shares, _, table), _ = arguments
        within, without = (kernels.sample_ellipses(image, ellipses, each) for each in pattern)
        distances = kernels.rank_distance(within, maps)
        distance = np.minimum(*distances.T) if nearest else (shares * distances).sum(axis=1)
        means = [kernels.color_lookup(each, table).mean(axis=1, dtype=float) for each in (within, without)]
        expected = CONTRAST_WEIGHT * (means[0] - means[1]) - SHARPNESS * distance**2
        assert_allclose(kernels.rank_likelihood(*arguments), expected, rtol=0, atol=rounding(30, 7))


def test_a_target_of_its_own_color(kernels: Kernels) -> None:
    """A red disk on blue, with a table that is 1 for red, gets the whole weight of the contrast; beside it
    none.
    """
    y, x = np.indices((80, 80)) - 40
    image: NDArray[np.uint8] = np.where((x**2 + y**2 < 200)[..., None], [0, 0, 255], [255, 0, 0]).astype(
        np.uint8
    )
    table = np.zeros((2, 2, 2), np.float32)
    table[0, 0, 1] = 1
    angle = np.linspace(0, 6, 20)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    ellipses = np.array([[40.5, 40.5, 13, 13], [70, 40.5, 13, 13]])
    maps = np.full((1, 3, 20), 0.5, np.float32)  # of a single color, as the disk: its distance is 0
    pattern, appearance = (0.9 * circle, 1.5 * circle), (maps, np.ones(1), False, table)
    log_likelihood = kernels.rank_likelihood(image, ellipses, pattern, appearance, (100.0, 3.0))
    assert log_likelihood[0] == 3
    assert log_likelihood[1] <= 0


@given(st.integers(0, 2**32))
def test_light_does_not_change_the_order(seed: int) -> None:
    """Without contrast, a strictly increasing change of each channel changes nothing, bit for bit."""
    image, *others, _ = case(seed)
    rng = np.random.default_rng(seed)
    curves = [np.sort(rng.choice(256, 128, replace=False)) for _ in range(3)]
    lit = np.stack([curve[image[..., c] // 2] for c, curve in enumerate(curves)], axis=-1).astype(np.uint8)
    for k in (_core, reference):
        ranks_alone = *others, (SHARPNESS, 0.0)
        assert_array_equal(k.rank_likelihood(lit, *ranks_alone), k.rank_likelihood(image // 2, *ranks_alone))


BAD: list[tuple[Place, Any, str]] = [
    (IMAGE, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (ELLIPSES, np.full((2, 4), np.nan), "ellipses: expected finite numbers, got nan"),
    (ELLIPSES, np.zeros((2, 5)), "ellipses: expected shape"),
    (INSIDE, np.zeros((30, 3)), "inside: expected shape"),
    (AROUND, np.zeros((0, 2)), "around: expected at least one place, got none"),
    (AROUND, np.full((2, 2), np.inf), "around: expected finite numbers, got inf"),
    (MODELS, np.full((2, 3, 30), 1.5, np.float32), r"models: expected ranks in \[0, 1\], got 1.5"),
    (MODELS, np.zeros((2, 3, 29), np.float32), "models: expected"),
    (MODELS, np.zeros((0, 3, 30), np.float32), "models: expected at least one rank map, got none"),
    (SHARES, np.ones(3), "shares: expected"),
    (SHARES, np.array([np.nan, 1]), "shares: expected finite numbers, got nan"),
    (TABLE, np.zeros((3, 3, 3), np.float32), r"table: expected shape \(B, B, B\), B a power of two"),
    ((FACTORS, 0), np.nan, "sharpness: expected a finite number, got nan"),
    ((FACTORS, 1), np.inf, "contrast_weight: expected a finite number, got inf"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.rank_likelihood(*with_argument(case(0), place, value))


def test_refuses_to_rank_nothing(kernels: Kernels) -> None:
    """Without places inside there is no order."""
    arguments = with_argument(case(0), INSIDE, np.zeros((0, 2)))
    arguments = with_argument(arguments, MODELS, np.zeros((2, 3, 0), np.float32))
    with pytest.raises(ValueError, match="inside: expected at least one place, got none"):
        kernels.rank_likelihood(*arguments)


@pytest.mark.parametrize("place", [IMAGE, ELLIPSES, INSIDE, AROUND, MODELS, SHARES, TABLE])
def test_native_refuses_other_types(place: Place) -> None:
    """No array is converted."""
    arguments = case(0)
    other = argument(arguments, place).astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.rank_likelihood(*with_argument(arguments, place, other))
