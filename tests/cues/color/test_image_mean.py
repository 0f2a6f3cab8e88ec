# SPDX-License-Identifier: MIT
"""The mean color of an image."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
images = arrays(np.uint8, st.tuples(st.integers(0, 80), st.integers(0, 80), st.just(3)))


@given(images)
def test_twin_gives_the_same(image: Image) -> None:
    """Native and reference agree on any image: whole numbers, and one product."""
    ours, theirs = _core.image_mean(image), reference.image_mean(image)
    assert_array_equal(ours, theirs)
    assert ours.dtype == theirs.dtype


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """It is cv2.mean's."""
    image = np.random.default_rng(0).integers(0, 256, (261, 292, 3), np.uint8)
    assert_allclose(kernels.image_mean(image), cv2.mean(image)[:3], rtol=1e-15)


def test_bright_images_overflow_nothing(kernels: Kernels) -> None:
    """The largest level everywhere is the mean, however many pixels a row has."""
    assert_allclose(kernels.image_mean(np.full((3, 20_001, 3), 255, np.uint8)), 255, rtol=1e-15)


def test_gains_of_the_light_multiply_the_mean(kernels: Kernels) -> None:
    """Twice the light is twice the mean."""
    image = np.random.default_rng(0).integers(0, 128, (30, 40, 3), np.uint8)
    assert_allclose(kernels.image_mean(2 * image), 2 * kernels.image_mean(image), rtol=1e-15)


def test_parts_work_as_their_copies(kernels: Kernels) -> None:
    """Rows may be padded, and some of them left out."""
    image = np.random.default_rng(0).integers(0, 256, (20, 60, 3), np.uint8)
    part = image[3:15:4, 4:58]
    assert_array_equal(kernels.image_mean(part), kernels.image_mean(part.copy()))
