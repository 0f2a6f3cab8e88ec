# SPDX-License-Identifier: MIT
"""A table over colors."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
SIDES = [1, 2, 4, 8, 16, 32, 64]


@pytest.mark.parametrize("side", SIDES)
def test_twin_reads_the_same(samples: Image, side: int) -> None:
    """Native and reference read the same entries for all sizes; the result is float32 (N, n)."""
    table = np.random.default_rng(side).random((side, side, side), np.float32)
    native = _core.color_lookup(samples, table)
    assert native.dtype == np.float32
    assert native.shape == (len(samples), samples.shape[2])
    assert_array_equal(native, reference.color_lookup(samples, table))


@pytest.mark.parametrize("side", SIDES)
def test_table_of_its_own_indices(kernels: Kernels, samples: Image, side: int) -> None:
    """A table whose entries are 10000 i + 100 j + k gives back the cells of blue, green, red."""
    i, j, k = np.indices((side, side, side))
    values = kernels.color_lookup(samples, (10000 * i + 100 * j + k).astype(np.float32))
    b, g, r = np.floor(samples.astype(float) * side / 256).transpose(1, 0, 2)
    assert_array_equal(values, 10000 * b + 100 * g + r)


def test_sums_back_to_the_histogram(kernels: Kernels) -> None:
    """A table that is the samples' own joint histogram, looked up, averages to the sum of its squares."""
    samples = np.random.default_rng(0).integers(0, 256, (1, 3, 4096), np.uint8)
    cells = tuple(samples[0] // 64)
    counts = np.zeros((4, 4, 4))
    np.add.at(counts, cells, 1)
    table = (counts / 4096).astype(np.float32)
    assert kernels.color_lookup(samples, table).mean(dtype=np.float64) == np.square(table.astype(float)).sum()


def test_values_pass_through(kernels: Kernels) -> None:
    """Whatever the table holds comes out unchanged, infinity and NaN too: they are the caller's."""
    table = np.array([-np.inf, np.nan, 1e-40, 3, 4, 5, 6, 7], np.float32).reshape(2, 2, 2)
    samples = np.array([[[0, 0, 0], [0, 0, 200], [0, 200, 0]]], np.uint8)
    assert_array_equal(kernels.color_lookup(samples, table), np.array([[-np.inf, np.nan, 1e-40]], np.float32))


@pytest.mark.parametrize("shape", [(3, 3, 3), (128, 128, 128), (0, 0, 0)])
def test_refuses_other_tables(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """A side that isn't a power of two up to 64 is an error that says so."""
    with pytest.raises(
        ValueError, match=r"table: expected shape \(B, B, B\), B a power of two up to 64, got"
    ):
        kernels.color_lookup(np.zeros((1, 3, 4), np.uint8), np.zeros(shape, np.float32))


GOOD = np.zeros((8, 8, 8), np.float32)
BAD: list[tuple[Any, type[Exception], str]] = [
    (GOOD.astype(float), TypeError, r"table: expected float32 \(B, B, B\), got float64"),
    (GOOD[0], ValueError, r"table: expected float32 \(B, B, B\)"),
    (GOOD.reshape(64, 1, 8), ValueError, r"table: expected float32 \(B, B, B\)"),
    (GOOD[:4, ::2, ::2], ValueError, "table: expected a C-contiguous"),
]


@pytest.mark.parametrize(("table", "error", "message"), BAD)
def test_native_refuses(table: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.color_lookup(np.zeros((1, 3, 4), np.uint8), table)
