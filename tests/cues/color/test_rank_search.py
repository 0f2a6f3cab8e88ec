# SPDX-License-Identifier: MIT
"""The search around an ellipse for the most likely window."""

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
SHARPNESS, CONTRAST_WEIGHT = 110.0, 8.0
IMAGE, ELLIPSE, OFFSETS, PATTERN, APPEARANCE = range(5)
INSIDE, SHARES = (PATTERN, 0), (APPEARANCE, 1)


def case(seed: int, windows: int = 12, nearest: bool = False) -> list[Any]:
    """All arguments: a picture, an ellipse in it, windows around it, and what they are compared with."""
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 256, (40, 60, 3)).astype(np.uint8)
    ellipse = rng.uniform([20, 15, 4, 4], [40, 25, 12, 15])
    offsets = np.concatenate([rng.normal(0, 0.5, (windows, 2)), rng.uniform(0.8, 1.2, (windows, 2))], axis=1)
    pattern = grid(5, 4), ring(9, 1.3, 1.8)
    maps, table = rng.random((2, 3, 20), np.float32), rng.random((4, 4, 4), np.float32)
    appearance = maps, np.array([0.7, 0.3]), nearest, table
    return [image, ellipse, offsets, pattern, appearance, (SHARPNESS, CONTRAST_WEIGHT)]


def rounding(n: int = 20, m: int = 9) -> float:
    """Of a log-likelihood: n + m roundings of a mean, and a few of the terms themselves."""
    return EPS * (CONTRAST_WEIGHT * (n + m) + 8 * SHARPNESS + 4 * (SHARPNESS + CONTRAST_WEIGHT))


@given(st.integers(0, 2**32), st.integers(0, 40), st.booleans())
def test_twin_finds_the_same(seed: int, windows: int, nearest: bool) -> None:
    """Places are computed by the same roundings, so both read the same pixels."""
    arguments = case(seed, windows, nearest)
    native, twin = _core.rank_search(*arguments), reference.rank_search(*arguments)
    assert_array_equal(native[0], twin[0])
    assert_allclose(native[1:], twin[1:], rtol=0, atol=rounding())


@given(st.integers(0, 2**32), st.integers(0, 40))
def test_finds_the_most_likely_of_all_windows(seed: int, windows: int) -> None:
    """It is the maximum of rank_likelihood over the ellipse and its windows."""
    image, ellipse, offsets, *look = case(seed, windows)
    x, y, minor, major = ellipse
    moved = [(x + u * minor, y + v * major, a * minor, b * major) for u, v, a, b in offsets]
    every = np.array([tuple(ellipse), *moved])
    for k in (_core, reference):
        log_likelihood = k.rank_likelihood(image, every, *look)
        found, highest, here = k.rank_search(image, ellipse, offsets, *look)
        assert (highest, here) == (log_likelihood.max(), log_likelihood[0])
        assert_array_equal(found, every[log_likelihood.argmax()])


def test_goes_to_the_target(kernels: Kernels) -> None:
    """A red disk on blue, beside the ellipse and larger, is found with its place and size."""
    y, x = np.indices((80, 120))
    disk = (x - 70) ** 2 + (y - 40) ** 2 < 225
    image: NDArray[np.uint8] = np.where(disk[..., None], [0, 0, 255], [255, 0, 0]).astype(np.uint8)
    table = np.zeros((2, 2, 2), np.float32)
    table[0, 0, 1] = 1
    flat = np.full((1, 3, 40), 0.5, np.float32)  # the ranks of a single color
    pattern, appearance = (ring(40, 0.1, 0.9), ring(40, 1.1, 1.5)), (flat, np.ones(1), False, table)
    look = pattern, appearance, (100.0, 3.0)
    steps = np.array([(u, v, s, s) for u in (-1, 0, 1) for v in (-1, 0, 1) for s in (1, 1.5)])
    found, highest, here = kernels.rank_search(image, np.array([60.0, 50.0, 10.0, 10.0]), steps, *look)
    assert_array_equal(found, [70, 40, 15, 15])
    assert highest == 3
    assert here < 2


def test_takes_the_first_of_equal_windows(kernels: Kernels) -> None:
    """In a uniform image all windows are alike, and the ellipse stays where it is."""
    arguments = case(1)
    arguments[IMAGE] = np.full((40, 60, 3), 90, np.uint8)
    found, highest, here = kernels.rank_search(*arguments)
    assert_array_equal(found, arguments[ELLIPSE])
    assert highest == here


BAD: list[tuple[Place, Any, str]] = [
    (IMAGE, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (ELLIPSE, np.zeros(3), "ellipse: expected shape"),
    (ELLIPSE, np.array([1, 2, np.nan, 4]), "ellipse: expected finite numbers, got nan"),
    (OFFSETS, np.zeros((3, 3)), "offsets: expected shape"),
    (OFFSETS, np.full((3, 4), np.inf), "offsets: expected finite numbers, got inf"),
    (OFFSETS, np.full((1, 4), 1e308), "ellipses: expected finite numbers, got inf"),
    (INSIDE, np.zeros((20, 3)), "inside: expected shape"),
    (SHARES, np.ones(3), "shares: expected"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
@pytest.mark.filterwarnings("ignore:overflow")
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.rank_search(*with_argument(case(0), place, value))


ARRAYS: list[Place] = [IMAGE, ELLIPSE, OFFSETS, (PATTERN, 0), (PATTERN, 1)]
ARRAYS += [(APPEARANCE, 0), (APPEARANCE, 1), (APPEARANCE, 3)]


@pytest.mark.parametrize("place", ARRAYS)
def test_native_refuses_other_types(place: Place) -> None:
    """No array is converted."""
    arguments = case(0)
    other = argument(arguments, place).astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.rank_search(*with_argument(arguments, place, other))
