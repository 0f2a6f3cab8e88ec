# SPDX-License-Identifier: MIT
"""The mean color of an image's samples."""

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
images = arrays(np.uint8, st.tuples(st.integers(0, 80), st.integers(0, 80), st.just(3)))


@given(images, st.integers(1, 60))
def test_twin_gives_the_same(image: Image, step: int) -> None:
    """Native and reference agree on any image and step: whole numbers, and one product."""
    ours, theirs = _core.image_mean(image, step), reference.image_mean(image, step)
    assert_array_equal(ours, theirs)
    assert ours.dtype == theirs.dtype


@pytest.mark.parametrize("step", [1, 2, 4, 5, 9])
def test_agrees_with_opencv(kernels: Kernels, step: int) -> None:
    """It is cv2.mean's of the samples."""
    image = np.random.default_rng(0).integers(0, 256, (261, 292, 3), np.uint8)
    samples = np.ascontiguousarray(image[step // 2 :: step, step // 2 :: step])
    assert_allclose(kernels.image_mean(image, step), cv2.mean(samples)[:3], rtol=1e-15)


@pytest.mark.parametrize("step", [1, 3, 8])
def test_bright_images_overflow_nothing(kernels: Kernels, step: int) -> None:
    """The largest level everywhere is the mean, however many pixels there are."""
    assert_allclose(kernels.image_mean(np.full((999, 1001, 3), 255, np.uint8), step), 255, rtol=1e-15)


def test_gains_of_the_light_multiply_the_mean(kernels: Kernels) -> None:
    """Twice the light is twice the mean."""
    image = np.random.default_rng(0).integers(0, 128, (30, 40, 3), np.uint8)
    assert_allclose(kernels.image_mean(2 * image, 3), 2 * kernels.image_mean(image, 3), rtol=1e-15)


def test_parts_work_as_their_copies(kernels: Kernels) -> None:
    """Rows may be padded."""
    image = np.random.default_rng(0).integers(0, 256, (20, 60, 3), np.uint8)
    part = image[3:15, 4:58]
    assert_array_equal(kernels.image_mean(part, 2), kernels.image_mean(part.copy(), 2))


@pytest.mark.parametrize("step", [0, -1, 1025])
def test_bad_step_is_refused(kernels: Kernels, step: int) -> None:
    """Steps are 1 to 1024 pixels."""
    with pytest.raises(ValueError, match="step: expected 1 to 1024, got"):
        kernels.image_mean(np.zeros((5, 9, 3), np.uint8), step)
