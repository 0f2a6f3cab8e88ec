# SPDX-License-Identifier: MIT
"""Division masks by range dividers."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]
Floats = NDArray[np.float64]
RANGE = np.array([1.0, 2.0, 4.0])
ONE, SEEN = np.ones((1, 1), np.float32), np.ones((1, 1), np.uint8)

shapes = st.tuples(st.integers(0, 3), st.integers(0, 70))
ascending = st.lists(st.floats(-1, 8), min_size=2, max_size=256).map(sorted).map(np.array)


def everything(depth: Depth) -> Mask:
    """A mask that leaves nothing out."""
    return np.full(depth.shape, 255, np.uint8)


@given(shapes.flatmap(lambda s: st.tuples(arrays(np.float32, s), arrays(np.uint8, s))), ascending)
def test_twin_divides_the_same(images: tuple[Depth, Mask], dividers: Floats) -> None:
    """Native and reference give the same labels for any depth, mask and dividers."""
    native = _core.divide_depth(*images, dividers)
    assert_array_equal(native, reference.divide_depth(*images, dividers), strict=True)


def test_twin_divides_pictures_the_same(picture: Depth) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    native = _core.divide_depth(picture, everything(picture), RANGE)
    assert_array_equal(native, reference.divide_depth(picture, everything(picture), RANGE), strict=True)


@pytest.mark.parametrize("divisions", [1, 2, 9, 255])
def test_agrees_with_numpy(kernels: Kernels, noisy_room: Depth, divisions: int) -> None:
    """numpy.digitize finds the same divisions."""
    dividers = np.linspace(1, 4.5, divisions + 1)
    expected = np.digitize(noisy_room, dividers)
    expected[expected == divisions + 1] = 0  # beyond the last, NaN too
    assert_array_equal(kernels.divide_depth(noisy_room, everything(noisy_room), dividers), expected)
    assert len(np.unique(expected)) > divisions / 2


def test_room_is_divided(kernels: Kernels, room: Depth, surfaces: Floats) -> None:
    """A divider between person and wall tells them apart."""
    labels = kernels.divide_depth(room, everything(room), np.array([0.0, 3.5, 6.0]))
    nearest = surfaces.argmin(axis=0)
    assert (labels[nearest == 1] == 2).all()
    assert (labels[nearest == 2] == 1).all()


def test_limits(kernels: Kernels) -> None:
    """A divider belongs to the division that it begins; the last one to none; the least float decides."""
    below, above = (np.nextafter(np.float32(2), np.float32(limit)) for limit in (0, 9))
    depth = np.array([[0.5, 1, below, 2, above, 3.9, 4, 5]], np.float32)
    labels = kernels.divide_depth(depth, everything(depth), RANGE)
    assert_array_equal(labels, [[0, 1, 1, 2, 2, 2, 0, 0]])


def test_dividers_are_not_rounded(kernels: Kernels) -> None:
    """A divider between two floats parts them, to whichever of the two it lies nearer."""
    low = np.float32(2.1)
    high = np.nextafter(low, np.float32(9))
    depth = np.array([[low, high]])
    for share in (1e-6, 0.3, 0.7, 1 - 1e-6):
        between = low + share * (np.float64(high) - low)
        labels = kernels.divide_depth(depth, everything(depth), np.array([0, between, 9]))
        assert_array_equal(labels, [[1, 2]])


def test_equal_dividers_have_an_empty_division(kernels: Kernels) -> None:
    """Where S(l) = S(l + 1) no pixel has the label l."""
    depth = np.array([[1.5, 2, 2.5]], np.float32)
    labels = kernels.divide_depth(depth, everything(depth), np.array([1.0, 2.0, 2.0, 3.0]))
    assert_array_equal(labels, [[1, 3, 3]])


def test_mask_and_holes(kernels: Kernels, noisy_room: Depth) -> None:
    """Nothing outside the mask has a label, all else keeps its own; a hole has none, whatever the range."""
    mask = np.random.default_rng(0).choice(np.array([0, 1, 255], np.uint8), noisy_room.shape)
    whole = kernels.divide_depth(noisy_room, everything(noisy_room), RANGE)
    assert_array_equal(kernels.divide_depth(noisy_room, mask, RANGE), np.where(mask > 0, whole, 0))
    holes = np.array([[np.nan, 0, -0.0, -1, np.inf, -np.inf]], np.float32)
    assert not kernels.divide_depth(holes, everything(holes), np.array([-1e300, 1e300])).any()


@pytest.mark.parametrize(
    ("mask", "dividers", "message"),
    [
        (np.ones((2, 3), np.uint8), RANGE, r"mask: expected shape \(1, 1\), got \(2, 3\)"),
        (SEEN, np.ones(1), "dividers: expected 2 to 256 numbers, got 1"),
        (SEEN, np.arange(257.0), "dividers: expected 2 to 256 numbers, got 257"),
        (SEEN, np.array([0, np.nan]), "dividers: expected finite numbers, got nan"),
        (SEEN, np.array([1, 3, 2.5, 4]), "dividers: expected ascending numbers, got 2.5"),
    ],
)
def test_refuses_other_masks_and_dividers(
    kernels: Kernels, mask: Mask, dividers: Floats, message: str
) -> None:
    """A mask of another shape and dividers that are none are named."""
    with pytest.raises(ValueError, match=message):
        kernels.divide_depth(ONE, mask, dividers)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones((1, 1), np.bool_), TypeError, r"mask: expected a uint8 mask \(H, W\), got bool"),
    (
        np.ones((1, 1, 1), np.uint8),
        ValueError,
        r"mask: expected a uint8 mask \(H, W\), got uint8 \(1, 1, 1\)",
    ),
    (np.ones((2, 8), np.uint8)[:, ::2], ValueError, "mask: expected a C-contiguous, aligned array"),
]


@pytest.mark.parametrize(("mask", "error", "message"), BAD)
def test_native_refuses_other_masks(mask: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.divide_depth(ONE, mask, RANGE)
