# SPDX-License-Identifier: MIT
"""Sums of rank measures over sections, as the paper prints them."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
few_levels = arrays(
    np.uint8,
    st.tuples(st.integers(0, 2), st.just(3), st.integers(1, 12)),
    elements=st.sampled_from([0, 1, 2, 127, 128, 254, 255]),
)


def three(plane: NDArray[Any]) -> Image:
    """The same levels in all channels of one ellipse."""
    return np.ascontiguousarray(np.broadcast_to(plane.astype(np.uint8), (1, 3, len(plane))))


@given(few_levels, st.integers(1, 256))
def test_twin_sums_the_same(samples: Image, sections: int) -> None:
    """Native and reference agree to the last bit, ties and all: whole counts up to the one division."""
    assert_array_equal(_core.rank_sections(samples, sections), reference.rank_sections(samples, sections))


@pytest.mark.parametrize("sections", [1, 2, 7, 16, 256])
def test_twin_sums_the_same_at_every_size(samples: Image, sections: int) -> None:
    """They also agree for all usual sizes; the result is float32 (N, 3, S)."""
    native = _core.rank_sections(samples, sections)
    assert native.dtype == np.float32
    assert native.shape == (len(samples), 3, sections)
    assert_array_equal(native, reference.rank_sections(samples, sections))


def printed(levels: Image, sections: int) -> list[Fraction]:
    """(17), (19)-(28) on fractions, one level after the other."""
    ranks = [Fraction(sum(int(level) <= limit for level in levels), len(levels)) for limit in range(256)]
    quantized = [min((abs(r - Fraction(n, sections)), r) for r in ranks)[1] for n in range(sections + 1)]
    sums = [sum(rank for rank in ranks if quantized[n] <= rank <= quantized[n + 1]) for n in range(sections)]
    return [Fraction(a) / sum(sums) for a in sums]


@pytest.mark.parametrize("sections", [1, 3, 8])
def test_agrees_with_fractions(kernels: Kernels, sections: int) -> None:
    """The printed equations, computed with fractions, give the same within the rounding of a float."""
    levels = np.random.default_rng(0).normal(120, 40, 30).clip(0, 255).astype(np.uint8)
    expected = np.array(printed(levels, sections), np.float64)
    assert_allclose(kernels.rank_sections(three(levels), sections)[0, 0], expected, rtol=1e-7)


def test_every_level_once(kernels: Kernels) -> None:
    """With r(l) = (l + 1)/256 and 256 sections q(n) = n/256, a(n) = (2n + 1)/256, of sum 256."""
    expected = (2 * np.arange(256) + 1) / 256 / 256
    assert_allclose(kernels.rank_sections(three(np.arange(256)), 256)[0, 1], expected, rtol=1e-7)


@pytest.mark.parametrize("level", [1, 100, 255])
def test_one_level(kernels: Kernels, level: int) -> None:
    """Ranks are 0 below the only level and 1 from there on: of two sections the second holds all."""
    assert_array_equal(kernels.rank_sections(three(np.full(5, level)), 2), np.tile([0.0, 1.0], (1, 3, 1)))


def test_borders_count_on_both_sides(kernels: Kernels) -> None:
    """Of 256 levels 128 have rank 1/2, 128 rank 1: with S = 2 q = 1/2, 1/2, 1 and a = 64, 64 + 128."""
    assert_allclose(
        kernels.rank_sections(three(np.array([0, 128])), 2)[0, 2], [64 / 256, 192 / 256], rtol=1e-7
    )


def test_sums_to_one(kernels: Kernels, samples: Image) -> None:
    """Each channel's sections sum to 1 and none is negative."""
    result = kernels.rank_sections(samples, 16)
    assert_allclose(result.sum(axis=2, dtype=np.float64), 1, rtol=0, atol=16 * np.finfo(np.float32).eps)
    assert (result >= 0).all()


def test_order_does_not_matter(kernels: Kernels, samples: Image) -> None:
    """Only how often a level occurs counts, not where."""
    turned = np.ascontiguousarray(samples[:, :, ::-1])
    assert_array_equal(kernels.rank_sections(samples, 16), kernels.rank_sections(turned, 16))


def test_is_not_illumination_invariant(kernels: Kernels) -> None:
    """The sums run over levels, so half the brightness changes them: spatial ranks are the default."""
    levels = np.random.default_rng(0).normal(120, 30, 251).clip(0, 255)
    bright, dark = kernels.rank_sections(three(levels), 8), kernels.rank_sections(three(levels // 2), 8)
    assert np.abs(bright - dark).max() > 0.1


@pytest.mark.parametrize("sections", [-1, 0, 257])
def test_refuses_other_sections(kernels: Kernels, sections: int) -> None:
    """(19) asks for N <= L = 256 sections."""
    with pytest.raises(ValueError, match=f"sections: expected 1 to 256, got {sections}"):
        kernels.rank_sections(np.zeros((1, 3, 4), np.uint8), sections)


def test_refuses_no_samples(kernels: Kernels) -> None:
    """Ellipses without samples have no ranks."""
    with pytest.raises(ValueError, match="samples: expected at least one for each ellipse, got none"):
        kernels.rank_sections(np.zeros((2, 3, 0), np.uint8), 16)


WRONG_TYPE: Any = np.zeros((1, 3, 4))


def test_native_refuses() -> None:
    """Samples of another type or shape are named."""
    with pytest.raises(TypeError, match="samples: expected uint8 samples"):
        _core.rank_sections(WRONG_TYPE, 16)
    with pytest.raises(ValueError, match="samples: expected uint8 samples"):
        _core.rank_sections(np.zeros((1, 2, 4), np.uint8), 16)
