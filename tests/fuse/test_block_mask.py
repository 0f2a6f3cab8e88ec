# SPDX-License-Identifier: MIT
"""The pixels of the target's blocks."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]


def grid(x: float, y: float, size: float, rows: int, columns: int) -> Floats:
    """(rows * columns, 4) blocks side by side."""
    left, top = (
        each.ravel() for each in np.meshgrid(x + size * np.arange(columns), y + size * np.arange(rows))
    )
    return np.column_stack([left, top, left + size, top + size]).astype(float)


def assert_same(blocks: Floats, height: int, width: int) -> None:
    """Pixels exactly: both compare the same numbers."""
    ours, theirs = (k.block_mask(blocks, height, width) for k in (_core, reference))
    assert_array_equal(ours, theirs, strict=True)


@given(st.integers(0, 40), st.integers(0, 70), st.integers(0, 2**32), st.integers(0, 9), st.booleans())
def test_twin_marks_the_same(height: int, width: int, seed: int, count: int, whole: bool) -> None:
    """Native and reference agree on any blocks, in the image, across its edge, outside, and turned round."""
    blocks = np.random.default_rng(seed).uniform(-9, 80, (count, 4))
    assert_same(blocks.round() if whole else blocks, height, width)


@pytest.mark.parametrize("size", [0.4, 1, 2.7, 6, 8, 24])
def test_twin_marks_grids_the_same(size: float) -> None:
    """They agree on grids of blocks that reach over the edge, and on corners beyond every int."""
    assert_same(grid(-3.3, 5.2, size, 9, 15), 60, 100)
    assert_same(np.array([[-1e300, 3.0, 1e300, 5.0], [4.0, -5e9, 6.0, 5e9]]), 60, 100)


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """cv2.rectangle fills the same pixels, of blocks of whole numbers, which overlap, at edges too."""
    low = np.random.default_rng(0).integers(-20, 110, (200, 2))
    blocks = np.column_stack([low, low + np.random.default_rng(1).integers(1, 9, (200, 2))])
    expected = np.zeros((60, 100), np.uint8)
    for x0, y0, x1, y1 in blocks.tolist():
        cv2.rectangle(expected, (x0, y0), (x1 - 1, y1 - 1), 1, cv2.FILLED)
    assert_array_equal(kernels.block_mask(blocks.astype(float), 60, 100), expected)
    assert 0.2 < expected.mean() < 0.8


def test_example_by_hand(kernels: Kernels) -> None:
    """A block marks the pixels whose centers it holds, its left and upper edge included, and none else."""
    blocks = np.array([[0.5, 0, 1.5, 1], [2.6, 0, 9, 0.6], [3, 1.5, 3.6, 9], [1, 1, 0, 3], [2, 2, 2.5, 3]])
    assert_array_equal(kernels.block_mask(blocks, 3, 5), [[1, 0, 0, 1, 1], [0, 0, 0, 1, 0], [0, 0, 0, 1, 0]])


def test_marks_what_is_counted(kernels: Kernels) -> None:
    """Of blocks side by side as many pixels are marked as block_counts counts, and in each all."""
    blocks = grid(-7.3, -2.6, 5.9, 12, 14)
    mask = kernels.block_mask(blocks, 60, 80)
    pixels, targets, *_ = kernels.block_counts(mask, np.zeros((60, 80), np.float32), blocks)
    assert pixels.sum() == np.count_nonzero(mask) > 0
    assert_array_equal(targets, pixels)


@given(st.integers(0, 2**32), st.integers(1, 20))
def test_marks_what_any_marks(seed: int, count: int) -> None:
    """What blocks mark together is what any of them marks alone, in whatever order, and blocks stay."""
    blocks = np.random.default_rng(seed).uniform(-5, 45, (count, 4))
    copy = blocks.copy()
    for k in (_core, reference):
        mask = k.block_mask(blocks, 30, 40)
        assert_array_equal(mask, np.max([k.block_mask(each[None], 30, 40) for each in blocks], axis=0))
        assert_array_equal(mask, k.block_mask(np.ascontiguousarray(blocks[::-1]), 30, 40))
    assert_array_equal(blocks, copy)


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0), (4, 5)])
def test_nothing_there(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Without blocks nothing is marked, and without pixels there is no mask to speak of."""
    for blocks in (np.empty((0, 4)), np.array([[7.0, 7, 9, 9]])):
        mask = kernels.block_mask(blocks, *shape)
        assert mask.shape == shape
        assert mask.dtype == np.uint8
        assert not mask.any()


ONE = np.array([[0.0, 0, 1, 1]])
BAD_VALUES: list[tuple[Floats, int, int, str]] = [
    (np.ones((2, 3)), 4, 5, r"blocks: expected shape \(2, 4\), got \(2, 3\)"),
    (np.array([[0, 0, 1, np.nan]]), 4, 5, "blocks: expected finite corners, got nan"),
    (np.array([[0, -np.inf, 1, 1]]), 4, 5, "blocks: expected finite corners, got -inf"),
    (np.array([[0, -np.inf, 1, 1]]), 0, 0, "blocks: expected finite corners, got -inf"),
    (ONE, -1, 5, "height: expected 0 to 16384, got -1"),
    (ONE, 4, -2, "width: expected 0 to 16384, got -2"),
    (ONE, 4, 1234567, "width: expected 0 to 16384, got 1234567"),
]


@pytest.mark.parametrize(("blocks", "height", "width", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, blocks: Floats, height: int, width: int, message: str) -> None:
    """What are no blocks, and no size, is named."""
    with pytest.raises(ValueError, match=message):
        kernels.block_mask(blocks, height, width)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones((2, 4), int), TypeError, r"blocks: expected float64 \(N, D\), got int"),
    (np.ones(4), ValueError, r"blocks: expected float64 \(N, D\), got float64 \(4,\)"),
    (np.ones((2, 8))[:, ::2], ValueError, "blocks: expected a C-contiguous"),
]


@pytest.mark.parametrize(("blocks", "error", "message"), BAD)
def test_native_refuses(blocks: Any, error: type[Exception], message: str) -> None:
    """Another type, rank or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.block_mask(blocks, 4, 5)
