# SPDX-License-Identifier: MIT
"""Colors of a target and of its surround, learned frame by frame."""

import copy
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, argument, with_argument

EPS = float(np.finfo(np.float32).eps)


def case(seed: int, n: int = 50, side: int = 8) -> list[Any]:
    """A picture, an ellipse in it, places in and round, histograms of sum 1, a rate, a rare share."""
    rng = np.random.default_rng(seed)
    image = rng.normal([90, 120, 160], 30, (40, 50, 3)).clip(0, 255).astype(np.uint8)
    pattern = rng.uniform(-1, 1, (n, 2)), rng.uniform(-2, 2, (n + 3, 2))
    cubes = [cube / cube.sum() for cube in rng.random((2, side, side, side), np.float32)]
    return [image, np.array([24.0, 19.0, 8.0, 11.0]), pattern, *cubes, rng.random(), 1e-4]


@given(st.integers(0, 2**32), st.integers(0, 300), st.sampled_from([1, 2, 4, 16, 64]))
def test_twin_learns_the_same(seed: int, n: int, side: int) -> None:
    """They agree but for how often a histogram is rounded: counts / n, then four float32 operations."""
    native, twin = (k.learn_contrast(*case(seed, n, side)) for k in (_core, reference))
    for own, other in zip(native, twin, strict=True):
        assert own.dtype == other.dtype == np.float32
        assert own.shape == (side, side, side)
        assert_allclose(own, other, rtol=4 * EPS, atol=4 * EPS)


def test_first_frame_is_its_histograms(kernels: Kernels) -> None:
    """From zeros with a rate of 1 the histograms are NumPy's histogramdd of the samples, each of sum 1."""
    image, ellipse, pattern = case(1, 400)[:3]
    nothing = np.zeros((8, 8, 8), np.float32)
    learned = kernels.learn_contrast(image, ellipse, pattern, nothing, nothing, 1.0, 1e-4)
    for histogram, places in zip(learned[:2], pattern, strict=True):
        samples = kernels.sample_ellipses(image, ellipse[None], places)[0].T
        counts, _ = np.histogramdd(samples, bins=8, range=3 * [(0, 256)])
        assert_allclose(histogram, counts / len(places), rtol=EPS)


def test_table_is_bayes_rule(kernels: Kernels) -> None:
    """Equal shares give 1/2, a color of the target alone 1, of the surround alone 0, an unseen one 0."""
    image = np.repeat(np.array([[10, 200, 100]], np.uint8)[..., None], 3, axis=2)
    where = np.array([1.5, 0.5, 1.0, 1.0])
    inside, around = (np.array([[x, 0.0] for x in columns]) for columns in ((-1.0, 0.0), (-1.0, 1.0)))
    nothing = np.zeros((4, 4, 4), np.float32)
    table = kernels.learn_contrast(image, where, (inside, around), nothing, nothing, 1.0, 1e-6)[2]
    assert table[0, 0, 0] == pytest.approx(1 / 2, abs=1e-6)
    assert table[3, 3, 3] == pytest.approx(1, abs=1e-5)
    assert table[1, 1, 1] == 0
    assert table[2, 2, 2] == 0


@given(st.integers(0, 2**32))
def test_blends_linearly(seed: int) -> None:
    """A rate of 0 changes nothing, a rate in between lies between, and sums stay 1."""
    *seen, target, surround, rate, rare = case(seed)
    for k in (_core, reference):
        kept, learned, new = (
            k.learn_contrast(*seen, target, surround, each, rare)[0] for each in (0.0, rate, 1.0)
        )
        assert_array_equal(kept, target)
        assert_allclose(learned, target + rate * (new - target), rtol=0, atol=4 * EPS)
        assert learned.sum(dtype=float) == pytest.approx(1, abs=512 * EPS)


def test_arguments_stay_as_they_are(kernels: Kernels) -> None:
    """What is blended is new memory."""
    arguments = case(2)
    before = copy.deepcopy(arguments)
    kernels.learn_contrast(*arguments)
    for now, then in zip(_numbers(arguments), _numbers(before), strict=True):
        assert_array_equal(now, then)


def _numbers(arguments: list[Any]) -> list[Any]:
    image, ellipse, pattern, *others = arguments
    return [image, ellipse, *pattern, *others]


BAD: list[tuple[Place, Any, str]] = [
    (0, np.zeros((0, 4, 3), np.uint8), "image: expected at least one pixel, got none"),
    (1, np.zeros(5), "ellipse: expected shape"),
    (1, np.full(4, np.nan), "ellipse: expected finite numbers, got nan"),
    ((2, 0), np.full((50, 2), np.inf), "inside: expected finite numbers, got inf"),
    ((2, 1), np.zeros((50, 3)), "around: expected shape"),
    (3, np.zeros((3, 3, 3), np.float32), r"target: expected shape \(B, B, B\)"),
    (4, np.zeros((4, 4, 4), np.float32), "surround: expected the target's shape"),
    (5, -0.1, r"rate: expected a number in \[0, 1\], got -0.1"),
    (5, np.nan, r"rate: expected a number in \[0, 1\], got nan"),
    (6, 0.0, "rare: expected a number above 0, got 0"),
    (6, np.nan, "rare: expected a number above 0, got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.learn_contrast(*with_argument(case(0), place, value))


@pytest.mark.parametrize("place", [0, 1, (2, 0), (2, 1), 3, 4])
def test_native_refuses_other_types(place: Place) -> None:
    """No array is converted."""
    arguments = case(0)
    other = argument(arguments, place).astype(np.float16)
    with pytest.raises(TypeError, match="float16"):
        _core.learn_contrast(*with_argument(arguments, place, other))
