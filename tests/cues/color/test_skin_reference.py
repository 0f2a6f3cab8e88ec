# SPDX-License-Identifier: MIT
"""The reference color of a skin patch."""

from collections import Counter
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

Image = NDArray[np.uint8]
# Few different levels, so that cells share pixels and are equally full now and then.
patches = arrays(
    np.uint8,
    st.tuples(st.integers(1, 6), st.integers(1, 6), st.just(3)),
    elements=st.sampled_from([0, 7, 8, 9, 100, 103, 255]),
)


@given(patches)
def test_twin_finds_the_same(patch: Image) -> None:
    """Native and reference give the same color: whole numbers, ties settled by the contract."""
    assert_array_equal(_core.skin_reference(patch), reference.skin_reference(patch))


def test_twin_finds_the_same_in_pictures(picture: Image) -> None:
    """They also agree on larger patches, and on views with padded rows."""
    if picture.size:
        assert_array_equal(_core.skin_reference(picture), reference.skin_reference(picture))


@given(patches)
def test_is_the_most_frequent(patch: Image) -> None:
    """No cell holds more pixels than the one that the result lies in, counted by a dictionary."""
    counts = Counter(tuple(pixel // 8) for pixel in patch.reshape(-1, 3))
    assert counts[tuple(_core.skin_reference(patch) // 8)] == max(counts.values())


def test_example_by_hand(kernels: Kernels) -> None:
    """Of three pixels in one cell and two in another, the mean of the three; 32/3 rounds to 11."""
    patch = np.array([[[8, 16, 24], [9, 17, 24], [15, 16, 24], [200, 0, 0], [200, 0, 0]]], np.uint8)
    assert_array_equal(kernels.skin_reference(patch), [11, 16, 24])


def test_halves_round_up_and_ties_go_to_the_first_cell(kernels: Kernels) -> None:
    """Two cells of two pixels: the one of less blue wins, and its mean 2.5 becomes 3."""
    patch = np.array([[[90, 0, 0], [90, 0, 0]], [[2, 250, 9], [3, 250, 9]]], np.uint8)
    assert_array_equal(kernels.skin_reference(patch), [3, 250, 9])


def test_order_does_not_matter(kernels: Kernels) -> None:
    """Shuffled pixels have the same reference color."""
    rng = np.random.default_rng(0)
    patch = rng.normal(120, 6, (20, 30, 3)).astype(np.uint8)
    shuffled = rng.permutation(patch.reshape(-1, 3)).reshape(patch.shape)
    assert_array_equal(kernels.skin_reference(patch), kernels.skin_reference(shuffled))


@pytest.mark.parametrize("shape", [(0, 0, 3), (0, 4, 3), (4, 0, 3)])
def test_refuses_an_empty_patch(kernels: Kernels, shape: tuple[int, ...]) -> None:
    """A patch without pixels has no color."""
    with pytest.raises(ValueError, match="patch: expected at least one pixel, got none"):
        kernels.skin_reference(np.empty(shape, np.uint8))


BAD: list[tuple[Any, type[Exception], str]] = [
    ([[1, 2, 3]], TypeError, "patch: expected a NumPy array"),
    (np.zeros((2, 2, 3)), TypeError, r"patch: expected a uint8 BGR image \(H, W, 3\), got float64"),
    (np.zeros((2, 2), np.uint8), ValueError, "patch: expected a uint8 BGR image"),
    (np.zeros((2, 2, 4), np.uint8), ValueError, "patch: expected a uint8 BGR image"),
    (np.zeros((4, 4, 3), np.uint8)[:, ::2], ValueError, "patch: expected packed pixels"),
    (np.zeros((4, 4, 3), np.uint8)[::-1], ValueError, "patch: expected packed pixels"),
]


@pytest.mark.parametrize(("patch", "error", "message"), BAD)
def test_native_refuses(patch: Any, error: type[Exception], message: str) -> None:
    """What isn't a packed BGR image is named, not converted."""
    with pytest.raises(error, match=message):
        _core.skin_reference(patch)
