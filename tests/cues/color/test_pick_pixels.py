# SPDX-License-Identifier: MIT
"""An image in other coordinates, by nearest pixels."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]


def picture(seed: int, height: int, width: int) -> Image:
    """An image of random colors."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


@given(
    st.integers(0, 2**32),
    st.integers(1, 40),
    st.integers(1, 40),
    st.integers(0, 20),
    st.integers(0, 20),
)
def test_twin_picks_the_same(seed: int, height: int, width: int, rows: int, columns: int) -> None:
    """Native and reference agree for images and maps of any size, the last pixel among them."""
    image = picture(seed, height, width)
    places = np.random.default_rng(seed).integers(0, height * width, (rows, columns))
    for each in (places, np.maximum(places, height * width - 2)):
        native = _core.pick_pixels(image, each)
        assert_array_equal(native, reference.pick_pixels(image, each), strict=True)


def test_all_places_in_order_are_the_image(kernels: Kernels) -> None:
    """The identity, and its reverse: the image upside down and mirrored."""
    image = picture(1, 13, 17)
    places = np.arange(13 * 17).reshape(13, 17)
    assert_array_equal(kernels.pick_pixels(image, places), image)
    assert_array_equal(kernels.pick_pixels(image, places[::-1, ::-1].copy()), image[::-1, ::-1])


def test_opencv_maps_to_the_same(kernels: Kernels) -> None:
    """cv2.remap with nearest pixels picks the same."""
    image, rng = picture(2, 30, 50), np.random.default_rng(3)
    x, y = rng.integers(0, 50, (20, 25)), rng.integers(0, 30, (20, 25))
    expected = cv2.remap(image, x.astype(np.float32), y.astype(np.float32), cv2.INTER_NEAREST)
    assert_array_equal(kernels.pick_pixels(image, 50 * y + x), expected)


@pytest.mark.parametrize(("place", "got"), [(-1, "-1"), (6, "6"), (2**40, str(2**40))])
def test_refuses_places_outside(kernels: Kernels, place: int, got: str) -> None:
    """A place that isn't in the image is named."""
    with pytest.raises(ValueError, match=f"places: expected 0 to 5, got {got}"):
        kernels.pick_pixels(picture(0, 2, 3), np.array([[0, place, 1]]))


def test_refuses_padded_rows(kernels: Kernels) -> None:
    """Places count pixels, so there may be nothing between rows."""
    with pytest.raises(ValueError, match="image: expected rows without padding, got 15 bytes a row"):
        kernels.pick_pixels(picture(0, 4, 5)[:, :3], np.zeros((1, 1), np.int64))


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="image: expected a uint8 BGR image"):
        _core.pick_pixels(np.zeros((2, 2, 3)), np.zeros((1, 1), np.int64))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="places: expected int64"):
        _core.pick_pixels(picture(0, 2, 2), np.zeros((1, 1)))  # type: ignore[arg-type]
