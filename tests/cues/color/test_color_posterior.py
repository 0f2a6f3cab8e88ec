# SPDX-License-Identifier: MIT
"""A table over the colors of an image."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
SIDES = [1, 2, 4, 8, 16, 32, 64]


def picture(seed: int, height: int, width: int) -> Image:
    """An image of random colors."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


@given(st.integers(0, 2**32), st.integers(0, 9), st.integers(0, 150), st.sampled_from(SIDES))
def test_twin_reads_the_same(seed: int, height: int, width: int, side: int) -> None:
    """Native and reference read the same entries for images of any size, and nothing of an empty one."""
    image, table = picture(seed, height, width), np.random.default_rng(side).random(3 * [side], np.float32)
    native = _core.color_posterior(image, table)
    assert_array_equal(native, reference.color_posterior(image, table), strict=True)


@pytest.mark.parametrize("view", [np.s_[3:40, 5:50], np.s_[::2], np.s_[:1, :1], np.s_[:, 7:8]])
def test_parts_of_images(view: Any) -> None:
    """Padded rows, every second row, one pixel, one column: read by both alike."""
    image, table = picture(0, 60, 90)[view], np.random.default_rng(1).random((16, 16, 16), np.float32)
    native = _core.color_posterior(image, table)
    assert_array_equal(native, reference.color_posterior(image, table), strict=True)


@pytest.mark.parametrize("side", SIDES)
def test_table_of_its_own_indices(kernels: Kernels, side: int) -> None:
    """A table whose entries are 10000 i + 100 j + k gives back the cells of blue, green, red."""
    i, j, k = np.indices((side, side, side))
    image = picture(side, 20, 70)
    values = kernels.color_posterior(image, (10000 * i + 100 * j + k).astype(np.float32))
    b, g, r = np.floor(image.astype(float) * side / 256).transpose(2, 0, 1)
    assert_array_equal(values, 10000 * b + 100 * g + r)


def test_is_the_lookup_of_samples(kernels: Kernels) -> None:
    """It is color_lookup of the same colors, channel by channel."""
    image, table = picture(2, 30, 40), np.random.default_rng(3).random((8, 8, 8), np.float32)
    samples = np.ascontiguousarray(image.reshape(-1, 3).T)[None]
    expected = kernels.color_lookup(samples, table).reshape(30, 40)
    assert_array_equal(kernels.color_posterior(image, table), expected)


@pytest.mark.parametrize("shape", [(3, 3, 3), (128, 128, 128), (0, 0, 0)])
def test_refuses_other_tables(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """A side that isn't a power of two up to 64 is an error that says so."""
    with pytest.raises(
        ValueError, match=r"table: expected shape \(B, B, B\), B a power of two up to 64, got"
    ):
        kernels.color_posterior(picture(0, 2, 2), np.zeros(shape, np.float32))


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="image: expected a uint8 BGR image"):
        _core.color_posterior(np.zeros((2, 2, 3)), np.zeros((2, 2, 2), np.float32))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="table: expected float32"):
        _core.color_posterior(picture(0, 2, 2), np.zeros((2, 2, 2)))  # type: ignore[arg-type]
