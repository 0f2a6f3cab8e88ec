# SPDX-License-Identifier: MIT
"""Colors of a target and of its surround, learned frame by frame."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

EPS = float(np.finfo(np.float32).eps)


def colors(rng: np.random.Generator, n: int, level: float) -> NDArray[np.uint8]:
    """Samples (1, 3, n) round one level."""
    return rng.normal(level, 30, (1, 3, n)).clip(0, 255).astype(np.uint8)


def case(seed: int, n: int = 50, side: int = 8) -> list[Any]:
    """Samples in and round, histograms of sum 1, a rate, a rare share."""
    rng = np.random.default_rng(seed)
    cubes = [cube / cube.sum() for cube in rng.random((2, side, side, side), np.float32)]
    return [colors(rng, n, 90), colors(rng, n + 3, 160), *cubes, rng.random(), 1e-4]


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
    inside, around, *_ = case(1, 400)
    nothing = np.zeros((8, 8, 8), np.float32)
    target, surround, _ = kernels.learn_contrast(inside, around, nothing, nothing, 1.0, 1e-4)
    for histogram, samples in ((target, inside), (surround, around)):
        counts, _ = np.histogramdd(samples[0].T, bins=8, range=3 * [(0, 256)])
        assert_allclose(histogram, counts / samples.shape[2], rtol=EPS)


def test_table_is_bayes_rule(kernels: Kernels) -> None:
    """Equal shares give 1/2, a color of the target alone 1, of the surround alone 0, an unseen one 0."""
    samples = np.array([[[10, 10, 200, 200]] * 3], np.uint8)
    others = np.array([[[10, 10, 100, 100]] * 3], np.uint8)
    nothing = np.zeros((4, 4, 4), np.float32)
    table = kernels.learn_contrast(samples, others, nothing, nothing, 1.0, 1e-6)[2]
    assert table[0, 0, 0] == pytest.approx(1 / 2, abs=1e-6)
    assert table[3, 3, 3] == pytest.approx(1, abs=1e-5)
    assert table[1, 1, 1] == 0
    assert table[2, 2, 2] == 0


@given(st.integers(0, 2**32))
def test_blends_linearly(seed: int) -> None:
    """A rate of 0 changes nothing, a rate in between lies between, and sums stay 1."""
    inside, around, target, surround, rate, rare = case(seed)
    for k in (_core, reference):
        kept, learned, new = (
            k.learn_contrast(inside, around, target, surround, each, rare)[0] for each in (0.0, rate, 1.0)
        )
        assert_array_equal(kept, target)
        assert_allclose(learned, target + rate * (new - target), rtol=0, atol=4 * EPS)
        assert learned.sum(dtype=float) == pytest.approx(1, abs=512 * EPS)


def test_arguments_stay_as_they_are(kernels: Kernels) -> None:
    """What is blended is new memory."""
    arguments = case(2)
    before = [np.copy(each) for each in arguments]
    kernels.learn_contrast(*arguments)
    for now, then in zip(arguments, before, strict=True):
        assert_array_equal(now, then)


BAD: list[tuple[int, Any, str]] = [
    (0, np.zeros((2, 3, 4), np.uint8), "inside: expected the samples of one ellipse, got 2"),
    (1, np.zeros((0, 3, 4), np.uint8), "around: expected the samples of one ellipse, got 0"),
    (2, np.zeros((3, 3, 3), np.float32), r"target: expected shape \(B, B, B\)"),
    (3, np.zeros((4, 4, 4), np.float32), "surround: expected the target's shape"),
    (4, -0.1, r"rate: expected a number in \[0, 1\], got -0.1"),
    (4, np.nan, r"rate: expected a number in \[0, 1\], got nan"),
    (5, 0.0, "rare: expected a number above 0, got 0"),
    (5, np.nan, "rare: expected a number above 0, got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: int, value: Any, message: str) -> None:
    """Wrong values and shapes are named."""
    arguments = case(0)
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        kernels.learn_contrast(*arguments)


@pytest.mark.parametrize("place", range(4))
def test_native_refuses_other_types(place: int) -> None:
    """No array is converted."""
    arguments = case(0)
    arguments[place] = arguments[place].astype(np.float64)
    with pytest.raises(TypeError, match="float64"):
        _core.learn_contrast(*arguments)
