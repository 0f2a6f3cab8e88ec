# SPDX-License-Identifier: MIT
"""What is seen in the blocks of the target window."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Mask = NDArray[np.uint8]
Plane = NDArray[np.float32]
Floats = NDArray[np.float64]
EPS = float(np.finfo(np.float64).eps)


def seen(shape: tuple[int, int], seed: int = 0) -> tuple[Mask, Plane]:
    """Target pixels, and disparities of either sign of which a fifth is missing."""
    rng = np.random.default_rng(seed)
    disparity = rng.normal(4, 3, shape).astype(np.float32)
    missing = rng.random(shape) < 0.2
    disparity[missing] = rng.choice(np.array([np.nan, np.inf, -np.inf], np.float32), shape)[missing]
    return rng.choice(np.array([0, 0, 1, 255], np.uint8), shape), disparity


def grid(x: float, y: float, size: float, rows: int, columns: int) -> Floats:
    """(rows * columns, 4) blocks side by side."""
    left, top = (
        each.ravel() for each in np.meshgrid(x + size * np.arange(columns), y + size * np.arange(rows))
    )
    return np.column_stack([left, top, left + size, top + size]).astype(float)


def assert_same(mask: Mask, disparity: Plane, blocks: Floats) -> None:
    """Counts exactly; a mean of n numbers below 30, summed in any order, to n roundings of such."""
    ours, theirs = (k.block_counts(mask, disparity, blocks, 4.1, 1.7) for k in (_core, reference))
    for one, other in zip((*ours[:3], ours[4]), (*theirs[:3], theirs[4]), strict=True):
        assert_array_equal(one, other, strict=True)
    assert (ours[3].shape, ours[3].dtype) == (theirs[3].shape, theirs[3].dtype)
    assert_allclose(ours[3], theirs[3], rtol=0, atol=30 * max(mask.size, 1) * EPS)


@given(
    st.tuples(st.integers(0, 12), st.integers(0, 70)),
    st.integers(0, 2**32),
    st.integers(0, 9),
    st.booleans(),
)
def test_twin_counts_the_same(shape: tuple[int, int], seed: int, count: int, whole: bool) -> None:
    """Native and reference agree on any blocks, in the image, across its edge, outside, and turned round."""
    rng = np.random.default_rng(seed)
    blocks = rng.uniform(-9, 80, (count, 4))
    assert_same(*seen(shape, seed), blocks.round() if whole else blocks)


@pytest.mark.parametrize("size", [1, 2.7, 6, 8, 24])
def test_twin_counts_grids_the_same(size: float) -> None:
    """They agree on grids of blocks, on parts of larger images whose rows are padded, each otherwise."""
    mask, disparity = seen((120, 180))
    blocks = grid(-3.3, 5.2, size, 9, 15)
    assert_same(mask, disparity, blocks)
    assert_same(mask[4:110, 5:150], disparity[10:116, 9:154], blocks)


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """cv2.mean and cv2.countNonZero of each block's pixels say the same."""
    mask, disparity = seen((60, 80))
    read = np.isfinite(disparity).astype(np.uint8)
    blocks = grid(2, 3, 7, 8, 11)
    pixels, targets, measured, mean, _ = kernels.block_counts(mask, disparity, blocks)
    for i, (x0, y0, x1, y1) in enumerate(blocks.astype(int)):
        part = np.s_[y0 : min(y1, 60), x0 : min(x1, 80)]
        assert pixels[i] == mask[part].size
        assert targets[i] == cv2.countNonZero(mask[part])
        assert measured[i] == cv2.countNonZero(read[part])
        assert_allclose(mean[i], cv2.mean(disparity[part], read[part])[0], rtol=1e-12)


def test_agrees_with_integral_images(kernels: Kernels) -> None:
    """So do differences of OpenCV's integral images, for every block of 6 x 6 there is."""
    mask, disparity = seen((20, 30), 3)
    blocks = np.array([(x, y, x + 6, y + 6) for y in range(15) for x in range(25)], float)
    filled = np.nan_to_num(disparity, nan=0, posinf=0, neginf=0)
    sums = []
    for image in (mask > 0, np.isfinite(disparity), filled):
        total = cv2.integral(image.astype(np.float64))
        sums.append((total[6:, 6:] - total[6:, :-6] - total[:-6, 6:] + total[:-6, :-6]).ravel())
    pixels, targets, measured, mean, _ = kernels.block_counts(mask, disparity, blocks)
    assert_array_equal(pixels, 36)
    assert_array_equal(targets, sums[0])
    assert_array_equal(measured, sums[1])
    assert_allclose(mean, sums[2] / sums[1], atol=1e-10)


def test_example_by_hand(kernels: Kernels) -> None:
    """A block counts the pixels whose centers it holds, and none outside the image."""
    mask = np.array([[1, 0, 255], [0, 0, 1]], np.uint8)
    disparity = np.array([[1, 2, np.nan], [-4, np.inf, 8]], np.float32)
    blocks = np.array(
        [[0, 0, 3, 2], [0.5, 0, 1.5, 9], [0.6, 0, 1.6, 2], [1, 0, 9, 1], [-5, -5, 0, 0], [2, 1, 0, 0]]
    )
    pixels, targets, measured, mean, _ = kernels.block_counts(mask, disparity, blocks)
    assert_array_equal(pixels, [6, 2, 2, 2, 0, 0])
    assert_array_equal(targets, [3, 1, 0, 1, 0, 0])
    assert_array_equal(measured, [4, 2, 1, 1, 0, 0])
    assert_array_equal(mean, [1.75, -1.5, 2, 2, np.nan, np.nan])


def test_similar_disparities_are_within_the_tolerance(kernels: Kernels) -> None:
    """What is counted as similar is what a mask of |d - expected| <= tolerance marks, at its edges, too."""
    mask, disparity = seen((60, 80))
    blocks = grid(-2, 3, 7, 8, 11)
    near = np.abs(disparity - np.float32(3.3)) <= np.float32(1.25)
    _, targets, *_ = kernels.block_counts(near.astype(np.uint8), disparity, blocks)
    *_, similar = kernels.block_counts(mask, disparity, blocks, 3.3, 1.25)
    assert similar.sum() > 100
    assert_array_equal(similar, targets)
    assert not kernels.block_counts(mask, disparity, blocks)[4].any()
    edges = np.float32([[1.75, 2, 4, 6, 6.25]])
    for x in range(3):  # the kernel reads eight columns at a time, but one by one of a narrow image
        padded = np.pad(edges, ((0, 0), (0, 8 * x)), constant_values=np.nan)
        *_, similar = kernels.block_counts(
            np.zeros_like(padded, np.uint8), padded, np.array([[0.0, 0, 5, 1]]), 4, 2
        )
        assert_array_equal(similar, [3])


@given(st.integers(0, 2**32), st.floats(1, 9), st.floats(-1, 1), st.floats(-1, 1))
def test_grid_counts_each_pixel_once(seed: int, size: float, x: float, y: float) -> None:
    """Blocks side by side count every pixel once, wherever they are cut."""
    mask, disparity = seen((24, 36), seed)
    rows, columns = (int(np.ceil(each / size)) + 2 for each in (24, 36))
    edges_x, edges_y = x - 1 + size * np.arange(columns + 1), y - 1 + size * np.arange(rows + 1)
    blocks = np.array(
        [
            (*low, *high)
            for low, high in (
                ((edges_x[i], edges_y[j]), (edges_x[i + 1], edges_y[j + 1]))
                for i in range(columns)
                for j in range(rows)
            )
        ]
    )
    pixels, targets, measured, mean, _ = _core.block_counts(mask, disparity, blocks)
    read = np.isfinite(disparity)
    assert pixels.sum() == mask.size
    assert targets.sum() == np.count_nonzero(mask)
    assert measured.sum() == np.count_nonzero(read)
    total = (mean * measured)[measured > 0].sum()
    assert_allclose(total, disparity[read].sum(dtype=float), rtol=0, atol=1e-9)


def test_each_by_itself(kernels: Kernels) -> None:
    """What is said of a block is the same in any company, and inputs stay as they are."""
    mask, disparity = seen((30, 40))
    blocks = grid(0, 0, 6, 5, 7)
    together = np.array(kernels.block_counts(mask, disparity, blocks))
    alone = [kernels.block_counts(mask, disparity, blocks[[i]]) for i in range(len(blocks))]
    assert_array_equal(together, np.array(alone)[:, :, 0].T)
    for ours, theirs in zip((mask, disparity), seen((30, 40)), strict=True):
        assert_array_equal(ours, theirs)


def test_constant_disparity(kernels: Kernels) -> None:
    """Of one disparity the mean is that one, however many pixels have it."""
    disparity = np.full((480, 640), 0.1, np.float32)
    _, _, measured, mean, _ = kernels.block_counts(
        np.zeros((480, 640), np.uint8), disparity, np.array([[0.0, 0, 640, 480]])
    )
    assert measured[0] == 480 * 640
    assert_allclose(mean, np.float64(np.float32(0.1)), rtol=1e-12)


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (4, 5)])
def test_nothing_there(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Without pixels all counts are 0 and means NaN; without blocks there are none."""
    mask, disparity = np.zeros(shape, np.uint8), np.full(shape, np.nan, np.float32)
    *counts, mean, similar = kernels.block_counts(mask, disparity, np.array([[0.0, 0, 9, 9]]))
    assert [each[0] for each in (*counts, similar)] == [mask.size, 0, 0, 0]
    assert np.isnan(mean[0])
    for each in kernels.block_counts(mask, disparity, np.empty((0, 4))):
        assert each.shape == (0,)


BAD_VALUES: list[tuple[str, Any, str]] = [
    ("mask", np.ones((3, 2), np.uint8), r"mask: expected shape \(2, 3\), got \(3, 2\)"),
    ("blocks", np.ones((2, 3)), r"blocks: expected shape \(2, 4\), got \(2, 3\)"),
    ("blocks", np.array([[0, 0, 1, np.nan]]), "blocks: expected finite corners, got nan"),
    ("blocks", np.array([[0, -np.inf, 1, 1]]), "blocks: expected finite corners, got -inf"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, name: str, value: Any, message: str) -> None:
    """A mask of another shape, and what are no blocks, is named."""
    mask, disparity = seen((2, 3))
    arguments = {"mask": mask, "disparity": disparity, "blocks": np.array([[0.0, 0, 1, 1]]), name: value}
    with pytest.raises(ValueError, match=message):
        kernels.block_counts(**arguments)


BAD: list[tuple[str, Any, type[Exception], str]] = [
    ("mask", np.ones((2, 3), np.bool_), TypeError, r"mask: expected a uint8 mask \(H, W\), got bool"),
    ("disparity", np.ones((2, 3)), TypeError, "disparity: expected a float32 plane"),
    ("disparity", np.ones((2, 6), np.float32)[:, ::2], ValueError, "disparity: expected packed pixels"),
    ("blocks", np.ones((2, 4), int), TypeError, r"blocks: expected float64 \(N, D\), got int"),
    ("blocks", np.ones((2, 8))[:, ::2], ValueError, "blocks: expected a C-contiguous"),
]


@pytest.mark.parametrize(("name", "value", "error", "message"), BAD)
def test_native_refuses(name: str, value: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    mask, disparity = seen((2, 3))
    arguments = {"mask": mask, "disparity": disparity, "blocks": np.array([[0.0, 0, 1, 1]]), name: value}
    with pytest.raises(error, match=message):
        _core.block_counts(**arguments)
