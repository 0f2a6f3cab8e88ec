# SPDX-License-Identifier: MIT
"""The colors of cells and their mean."""

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
images = arrays(np.uint8, st.tuples(st.integers(0, 40), st.integers(0, 40), st.just(3)))


@given(images, st.integers(1, 60))
def test_twin_gives_the_same(image: Image, step: int) -> None:
    """Native and reference agree on any image and step: whole numbers, and one product."""
    for ours, theirs in zip(_core.cell_colors(image, step), reference.cell_colors(image, step), strict=True):
        assert_array_equal(ours, theirs)
        assert ours.dtype == theirs.dtype


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """The mean is cv2.mean's of the middle pixels."""
    image = np.random.default_rng(0).integers(0, 256, (61, 92, 3), np.uint8)
    colors, mean = kernels.cell_colors(image, 4)
    assert_array_equal(colors, image[2::4, 2::4])
    assert_allclose(mean, cv2.mean(colors)[:3], rtol=1e-15)


def test_gains_of_the_light_multiply_the_mean(kernels: Kernels) -> None:
    """Twice the light is twice the mean."""
    image = np.random.default_rng(0).integers(0, 128, (30, 40, 3), np.uint8)
    assert_allclose(kernels.cell_colors(2 * image, 3)[1], 2 * kernels.cell_colors(image, 3)[1], rtol=1e-15)


def test_parts_work_as_their_copies(kernels: Kernels) -> None:
    """Rows may be padded."""
    image = np.random.default_rng(0).integers(0, 256, (20, 30, 3), np.uint8)
    part = image[3:15, 4:28]
    assert_array_equal(kernels.cell_colors(part, 2)[0], kernels.cell_colors(part.copy(), 2)[0])


@pytest.mark.parametrize("step", [0, -1, 1025])
def test_bad_step_is_refused(kernels: Kernels, step: int) -> None:
    """Steps are 1 to 1024 pixels."""
    with pytest.raises(ValueError, match="step: expected 1 to 1024, got"):
        kernels.cell_colors(np.zeros((5, 9, 3), np.uint8), step)
