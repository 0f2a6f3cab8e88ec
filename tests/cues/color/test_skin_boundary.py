# SPDX-License-Identifier: MIT
"""The boundary value of the skin classifier."""

from typing import Any

import cv2
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
images = arrays(np.uint8, st.tuples(st.integers(0, 5), st.integers(0, 140), st.just(3)))
colors = arrays(np.uint8, 3)


@given(images, colors)
def test_twin_measures_the_same(image: Image, color: Image) -> None:
    """Native and reference agree on rows of every length: whole numbers, nothing to round."""
    assert_array_equal(_core.skin_boundary(image, color), reference.skin_boundary(image, color))


def test_agrees_with_opencv(kernels: Kernels, picture: Image, color: Image) -> None:
    """Absdiff and max of OpenCV, on whole planes, give the same; the result is int16 of the image's size."""
    boundary = kernels.skin_boundary(picture, color)
    assert boundary.dtype == np.int16
    assert boundary.shape == picture.shape[:2]
    if picture.size:
        b, g, r = cv2.split(cv2.absdiff(picture, np.broadcast_to(color, picture.shape).copy()))
        delta = cv2.max(cv2.max(b, g), r)
        b, g, r = cv2.split(picture)
        assert_array_equal(boundary, cv2.subtract(cv2.max(cv2.max(b, g), r), delta, dtype=cv2.CV_16S))


def test_example_by_hand(kernels: Kernels) -> None:
    """The reference itself has the value of its largest channel; others lose their largest difference."""
    image = np.array([[[60, 90, 160], [0, 0, 0], [255, 255, 255], [100, 80, 150]]], np.uint8)
    boundary = kernels.skin_boundary(image, np.array([60, 90, 160], np.uint8))
    assert_array_equal(boundary, [[160, -160, 255 - 195, 150 - 40]])


@given(images, colors, st.permutations([0, 1, 2]))
def test_channels_are_alike(image: Image, color: Image, order: list[int]) -> None:
    """No channel is favored: reordered in picture and reference alike, the value stays."""
    reordered = np.ascontiguousarray(image[:, :, order])
    assert_array_equal(_core.skin_boundary(reordered, color[order]), _core.skin_boundary(image, color))


IMAGE = np.zeros((2, 2, 3), np.uint8)
COLOR = np.zeros(3, np.uint8)
BAD: list[tuple[Any, Any, type[Exception], str]] = [
    (IMAGE.astype(np.float32), COLOR, TypeError, "image: expected a uint8 BGR image"),
    (IMAGE[..., :1], COLOR, ValueError, "image: expected a uint8 BGR image"),
    (IMAGE, (1, 2, 3), TypeError, "reference: expected a NumPy array"),
    (IMAGE, COLOR.astype(int), TypeError, r"reference: expected a uint8 color \(3,\)"),
    (IMAGE, np.zeros(4, np.uint8), ValueError, r"reference: expected a uint8 color \(3,\)"),
    (IMAGE, np.zeros(6, np.uint8)[::2], ValueError, "reference: expected a C-contiguous, aligned array"),
]


@pytest.mark.parametrize(("image", "color", "error", "message"), BAD)
def test_native_refuses(image: Any, color: Any, error: type[Exception], message: str) -> None:
    """Another type or shape is named, not converted."""
    with pytest.raises(error, match=message):
        _core.skin_boundary(image, color)
