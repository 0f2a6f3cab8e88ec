# SPDX-License-Identifier: MIT
"""Connected regions of skin."""

from typing import Any

import cv2
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
SKIN = np.array([60, 90, 160], np.uint8)
BINARY = 0.5  # between the 160/255 of SKIN and the -160/255 of black
ROUNDING = 4 * np.finfo(float).eps  # centroids: a sum of whole numbers, one division, one addition

masks = arrays(np.bool_, st.tuples(st.integers(0, 12), st.integers(0, 12)))


def paint(mask: NDArray[np.bool_]) -> Image:
    """Skin where the mask is true, black elsewhere."""
    return mask[:, :, None] * SKIN


def draw(*rows: str) -> Image:
    """Skin where a character is #."""
    return paint(np.array([[character == "#" for character in row] for row in rows]))


def labeled(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """What OpenCV says of all regions, in no particular order."""
    _, _, stats, centroids = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    return np.hstack([stats, centroids + 0.5])[1:]


def in_order(blobs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows sorted by all that is in them, for results whose order differs; centroids rounded."""
    return blobs[np.lexsort(blobs.round(9).T)]


@given(masks, st.integers(1, 5))
def test_twin_finds_the_same(mask: NDArray[np.bool_], min_area: int) -> None:
    """Native and reference find the same regions in the same order, in noise of every shape."""
    native = _core.skin_blobs(paint(mask), SKIN, BINARY, min_area)
    twin = reference.skin_blobs(paint(mask), SKIN, BINARY, min_area)
    assert native.shape == twin.shape
    assert_allclose(native, twin, rtol=ROUNDING)


def test_twin_finds_the_same_in_pictures(picture: Image, color: Image) -> None:
    """They also agree on pictures of awkward sizes, where skin is found by color."""
    native = _core.skin_blobs(picture, color, 0.1, 2)
    assert_allclose(native, reference.skin_blobs(picture, color, 0.1, 2), rtol=ROUNDING)


@pytest.mark.parametrize("density", [0.05, 0.4, 0.6, 0.95])
def test_agrees_with_opencv(kernels: Kernels, density: float) -> None:
    """OpenCV finds the same boxes, areas and centroids in noise below, at and above percolation."""
    mask = np.random.default_rng(1).random((70, 90)) < density
    assert_allclose(
        in_order(kernels.skin_blobs(paint(mask), SKIN, BINARY, 1)), in_order(labeled(mask)), rtol=1e-12
    )


def test_example_by_hand(kernels: Kernels) -> None:
    """Diagonal neighbors and arms that meet below are one region; the smallest is left out."""
    image = draw(
        "#.#...#",
        "#.#....",
        "#.#..##",
        ".#...##",
        "......."
    )  # fmt: skip
    expected = np.array([[0, 0, 3, 4, 7, 1.5, 12.5 / 7], [5, 2, 2, 2, 4, 6, 3]])
    assert_allclose(kernels.skin_blobs(image, SKIN, BINARY, 2), expected, rtol=1e-14)


def test_spiral(kernels: Kernels) -> None:
    """A spiral, whose runs are joined late and again and again, is one region."""
    image = draw(
        "#########",
        "........#",
        "#######.#",
        "#.....#.#",
        "#.###.#.#",
        "#.#...#.#",
        "#.#####.#",
        "#.......#",
        "#########"
    )  # fmt: skip
    blobs = kernels.skin_blobs(image, SKIN, BINARY, 1)
    assert_array_equal(blobs[:, :5], [[0, 0, 9, 9, np.count_nonzero(image[:, :, 0])]])


def test_order(kernels: Kernels) -> None:
    """Larger first; of equals the higher, then the one further left."""
    image = draw("..#..##", ".......", "#..#.#.")
    boxes = kernels.skin_blobs(image, SKIN, BINARY, 1)[:, :2]
    assert_array_equal(boxes, [[5, 0], [2, 0], [0, 2], [3, 2], [5, 2]])


@given(masks)
def test_every_pixel_in_one_blob(mask: NDArray[np.bool_]) -> None:
    """Areas add up to the skin pixels, and the centroids, weighed by them, to the mean of skin_moments."""
    blobs = _core.skin_blobs(paint(mask), SKIN, BINARY, 1)
    moments = _core.skin_moments(paint(mask), SKIN, BINARY, (0, 0, *mask.shape[::-1]), 1)
    assert blobs[:, 4].sum() == moments[0]
    assert_allclose(blobs[:, 4] @ blobs[:, 5:], moments[0] * moments[1:3], rtol=1e-12)


@given(masks)
def test_mirror(mask: NDArray[np.bool_]) -> None:
    """Mirrored pictures have mirrored regions."""
    blobs = _core.skin_blobs(paint(mask), SKIN, BINARY, 1)
    mirrored = _core.skin_blobs(paint(mask[:, ::-1]), SKIN, BINARY, 1)
    blobs[:, 0] = mask.shape[1] - blobs[:, 0] - blobs[:, 2]
    blobs[:, 5] = mask.shape[1] - blobs[:, 5]
    assert_allclose(in_order(blobs), in_order(mirrored), rtol=0, atol=1e-12)


def test_more_regions_than_16_bits_count(kernels: Kernels) -> None:
    """A frame of 640x480 of single pixels has 76800 regions, which 16-bit labels could not tell apart."""
    mask = np.zeros((480, 640), np.bool_)
    mask[::2, ::2] = True
    assert kernels.skin_blobs(paint(mask), SKIN, BINARY, 1).shape == (76800, 7)


@pytest.mark.parametrize("min_area", [0, -3])
def test_refuses_other_areas(kernels: Kernels, min_area: int) -> None:
    """A smallest area below one pixel is an error that says so."""
    with pytest.raises(ValueError, match=f"min_area: expected at least 1, got {min_area}"):
        kernels.skin_blobs(draw("#"), SKIN, BINARY, min_area)


def test_refuses_other_thresholds(kernels: Kernels) -> None:
    """A threshold outside [-1, 1] is an error that says so."""
    with pytest.raises(ValueError, match=r"threshold: expected a number in \[-1, 1\], got 1.5"):
        kernels.skin_blobs(draw("#"), SKIN, 1.5, 1)


WRONG_TYPE: Any = np.zeros((3, 3, 3))


def test_native_refuses() -> None:
    """What isn't a BGR image is named."""
    with pytest.raises(TypeError, match="image: expected a uint8 BGR image"):
        _core.skin_blobs(WRONG_TYPE, SKIN, BINARY, 1)
