# SPDX-License-Identifier: MIT
"""The rectangle round a frame's target pixels."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import trimboth
from tricue import _core, reference
from tricue.kernels import Kernels

Mask = NDArray[np.uint8]

masks = arrays(np.uint8, st.tuples(st.integers(0, 12), st.integers(0, 20)), elements=st.integers(0, 2))
neighbors = st.integers(0, 8)
shares = st.sampled_from([0.0, 0.2, 0.5, 1.0]) | st.floats(0, 1)
trims = st.sampled_from([0.0, 0.02, 0.25]) | st.floats(0, 0.5, exclude_max=True)


def draw(*rows: str) -> Mask:
    """# is set."""
    return np.array([[each == "#" for each in row] for row in rows], np.uint8)


def noise(shape: tuple[int, int], density: float, seed: int) -> Mask:
    """Independent pixels, 255 where set."""
    return 255 * (np.random.default_rng(seed).random(shape) < density).astype(np.uint8)


def assert_same(mask: Mask, *parameters: Any) -> None:
    """All is whole numbers, and one product: the same exactly."""
    ours, theirs = (k.temporal_window(mask, *parameters) for k in (_core, reference))
    assert ours[:2] == theirs[:2]
    assert_array_equal(ours[2], theirs[2], strict=True)


@given(masks, neighbors, shares, trims)
def test_twin_leaves_the_same(mask: Mask, neighbors: int, share: float, trim: float) -> None:
    """Native and reference agree exactly, for any mask and parameters."""
    assert_same(mask, neighbors, share, trim)


@pytest.mark.parametrize("cols", [1, 7, 8, 9, 15, 16, 17, 41, 63, 64, 65, 200])
@pytest.mark.parametrize("density", [0.1, 0.5, 0.9])
def test_twin_leaves_the_same_in_rows_of_any_length(cols: int, density: float) -> None:
    """They agree on rows shorter than a vector, as long, and longer, cut from a wider mask."""
    mask = noise((25, cols + 7), density, cols)[2:22, 3 : cols + 3]
    for neighbors in (0, 3, 8):
        assert_same(mask, neighbors, 0.3, 0.02)


@pytest.mark.parametrize("density", [0.3, 0.5, 0.7])
@pytest.mark.parametrize("neighbors", [0, 2, 4, 6])
def test_agrees_with_opencv(kernels: Kernels, density: float, neighbors: int) -> None:
    """OpenCV counts the same neighbors and finds the same regions; SciPy trims to the same box."""
    mask = noise((90, 110), density, neighbors)
    set_ = (mask > 0).astype(np.uint8)
    around = np.ones((3, 3))
    around[1, 1] = 0
    counts = cv2.filter2D(set_, cv2.CV_8U, around, borderType=cv2.BORDER_CONSTANT)
    enough = set_ * (counts >= neighbors).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(enough)
    large = np.flatnonzero(stats[:, 4] >= 0.25 * stats[1:, 4].max())
    expected = np.isin(labels, large[large > 0])
    (x0, y0, x1, y1), count, left = kernels.temporal_window(mask, neighbors, 0.25, 0.1)
    assert_array_equal(left, expected)
    assert count == expected.sum() > 10
    rows, columns = (trimboth(np.sort(each), 0.1) for each in np.nonzero(expected))
    assert (x0, x1 - 1, y0, y1 - 1) == (columns.min(), columns.max(), rows.min(), rows.max())


def test_finds_a_rectangle_in_noise(kernels: Kernels) -> None:
    """A target of 80 % of its pixels is boxed to two pixels among 15 % wrong ones, by all three steps."""
    for seed in range(20):
        mask = noise((120, 160), 0.15, seed)
        mask[30:90, 50:80] = noise((60, 30), 0.8, seed + 100)
        (x0, y0, x1, y1), _, _ = kernels.temporal_window(mask, 4, 0.3)
        assert_allclose((x0, y0, x1, y1), (50, 30, 80, 90), atol=2)


def test_example_by_hand(kernels: Kernels) -> None:
    """A lone pixel goes by its neighbors, a small region by its size; corners connect."""
    mask = draw(
        "#....##.",
        ".....#..",
        "..##....",
        "..###...",
        ".....#..",
        "......##",
    )  # fmt: skip
    box, count, left = kernels.temporal_window(mask, 1, 0.5, 0.0)
    assert (box, count) == ((2, 2, 8, 6), 8)
    assert_array_equal(left, draw("........", "........", "..##....", "..###...", ".....#..", "......##"))
    box, count, _ = kernels.temporal_window(mask, 1, 0.3, 0.0)
    assert (box, count) == ((2, 0, 8, 6), 11)
    box, count, _ = kernels.temporal_window(mask, 0, 0.0, 0.0)
    assert (box, count) == ((0, 0, 8, 6), 12)
    # Of 12 columns 0 2 2 3 3 4 5 5 5 6 6 7 and rows 0 0 0 1 2 2 3 3 3 4 5 5 two go at either end.
    box, _, _ = kernels.temporal_window(mask, 0, 0.0, 2.5 / 12)
    assert box == (2, 0, 7, 5)


def test_neighbors_beyond_the_edge(kernels: Kernels) -> None:
    """Beyond the edge nothing is set: of a full mask corners have 3 neighbors, edges 5, the rest 8."""
    full = np.ones((4, 6), np.uint8)
    for neighbors, expected in ((3, (0, 0, 6, 4)), (5, (0, 0, 6, 4)), (6, (1, 1, 5, 3)), (8, (1, 1, 5, 3))):
        box, count, left = kernels.temporal_window(full, neighbors, 0.0, 0.0)
        assert box == expected
        assert count == left.sum() == {3: 24, 5: 20, 6: 8, 8: 8}[neighbors]


@given(masks, neighbors, shares, trims)
def test_mirror_and_turn(mask: Mask, neighbors: int, share: float, trim: float) -> None:
    """A mirrored mask has the mirrored window, a transposed one the transposed."""
    width = mask.shape[1]
    (x0, y0, x1, y1), count, left = _core.temporal_window(mask, neighbors, share, trim)
    mirrored = _core.temporal_window(np.ascontiguousarray(mask[:, ::-1]), neighbors, share, trim)
    turned = _core.temporal_window(np.ascontiguousarray(mask.T), neighbors, share, trim)
    if count:
        assert mirrored[:2] == ((width - x1, y0, width - x0, y1), count)
        assert turned[:2] == ((y0, x0, y1, x1), count)
    assert_array_equal(mirrored[2][:, ::-1], left)
    assert_array_equal(turned[2].T, left)


@given(masks, neighbors, shares, trims)
def test_box_holds_what_is_left(mask: Mask, neighbors: int, share: float, trim: float) -> None:
    """Nothing is added; with nothing trimmed the box fits exactly, with more it only shrinks."""
    box, count, left = _core.temporal_window(mask, neighbors, share, 0.0)
    assert not left[mask == 0].any()
    assert count == left.sum()
    if count == 0:
        assert box == (0, 0, 0, 0)
        return
    assert box == (*(int(each.min()) for each in np.nonzero(left)[::-1]), box[2], box[3])
    assert left[box[1] : box[3], box[0] : box[2]].sum() == count
    x0, y0, x1, y1 = _core.temporal_window(mask, neighbors, share, trim)[0]
    assert box[0] <= x0 < x1 <= box[2]
    assert box[1] <= y0 < y1 <= box[3]


@given(masks)
def test_nothing_asked_for(mask: Mask) -> None:
    """Without conditions every set pixel is left, whatever its number."""
    assert_array_equal(_core.temporal_window(mask, 0, 0.0, 0.0)[2], mask > 0)


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0), (4, 5)])
def test_nothing_there(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Without set pixels, or any pixels, the box is empty and the count 0; the mask keeps its shape."""
    box, count, left = kernels.temporal_window(np.zeros(shape, np.uint8), 3, 0.2)
    assert (box, count) == ((0, 0, 0, 0), 0)
    assert_array_equal(left, np.zeros(shape, np.uint8), strict=True)


def test_nothing_left(kernels: Kernels) -> None:
    """So it is where no pixel has enough neighbors."""
    box, count, left = kernels.temporal_window(draw("#.#.#", ".....", "#.#.#"), 1, 0.0)
    assert (box, count, left.any()) == ((0, 0, 0, 0), 0, False)


@pytest.mark.parametrize(
    ("neighbors", "share", "trim", "message"),
    [
        (-1, 0.2, 0.02, "neighbors: expected 0 to 8, got -1"),
        (9, 0.2, 0.02, "neighbors: expected 0 to 8, got 9"),
        (3, -0.1, 0.02, r"share: expected a number in \[0, 1\], got -0.1"),
        (3, np.nan, 0.02, r"share: expected a number in \[0, 1\], got nan"),
        (3, 1.5, 0.02, r"share: expected a number in \[0, 1\], got 1.5"),
        (3, 0.2, -0.1, r"trim: expected a number in \[0, 0.5\), got -0.1"),
        (3, 0.2, 0.5, r"trim: expected a number in \[0, 0.5\), got 0.5"),
        (3, 0.2, np.nan, r"trim: expected a number in \[0, 0.5\), got nan"),
    ],
)
def test_refuses(kernels: Kernels, neighbors: int, share: float, trim: float, message: str) -> None:
    """Parameters out of their range are named."""
    with pytest.raises(ValueError, match=message):
        kernels.temporal_window(np.ones((2, 3), np.uint8), neighbors, share, trim)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones((2, 3), np.bool_), TypeError, r"mask: expected a uint8 mask \(H, W\), got bool"),
    (np.ones(3, np.uint8), ValueError, r"mask: expected a uint8 mask \(H, W\), got uint8 \(3,\)"),
    (np.ones((2, 6), np.uint8)[:, ::2], ValueError, "mask: expected packed pixels"),
    (None, TypeError, "mask: expected a NumPy array"),
]


@pytest.mark.parametrize(("mask", "error", "message"), BAD)
def test_native_refuses(mask: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.temporal_window(mask, 3, 0.2)
