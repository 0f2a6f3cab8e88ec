# SPDX-License-Identifier: MIT
"""Gray levels in cells."""

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
sides = st.integers(1, 40)
images = st.tuples(sides, sides, st.sampled_from([(), (3,)])).flatmap(
    lambda shape: arrays(np.uint8, (*shape[:2], *shape[2]))
)


@given(images, st.data())
def test_twin_gives_the_same(image: Image, data: st.DataObject) -> None:
    """Native and reference agree on any image and step: both round the same whole numbers."""
    step = data.draw(st.integers(1, min(image.shape[:2])))
    assert_array_equal(_core.reduce_gray(image, step), reference.reduce_gray(image, step))


@pytest.mark.parametrize("step", [1, 2, 3, 4, 7])
def test_agrees_with_cv2(kernels: Kernels, step: int) -> None:
    """cv2's conversion and area scaling, which are another build of OpenCV, give the same levels."""
    image = np.random.default_rng(step).integers(0, 256, (84, 168, 3), np.uint8)
    gray = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    cells = cv2.resize(gray, (168 // step, 84 // step), interpolation=cv2.INTER_AREA)
    assert_array_equal(kernels.reduce_gray(image, step), cells)
    assert_array_equal(kernels.reduce_gray(gray, step), cells)


def test_every_gray_keeps_its_level(kernels: Kernels) -> None:
    """The weights sum to 1: equal channels give their own level, and so do cells of one level."""
    levels = np.repeat(np.arange(256, dtype=np.uint8), 3).reshape(16, 16, 3)
    assert_array_equal(kernels.reduce_gray(levels, 1), levels[..., 0])
    assert_array_equal(
        kernels.reduce_gray(np.kron(levels[..., 0], np.ones((3, 3), np.uint8)), 3), levels[..., 0]
    )


def test_what_fills_no_cell_is_left_out(kernels: Kernels) -> None:
    """Rows and columns beyond the last whole cell change nothing."""
    image = np.random.default_rng(0).integers(0, 256, (13, 17, 3), np.uint8)
    assert_array_equal(kernels.reduce_gray(image, 4), kernels.reduce_gray(image[:12, :16].copy(), 4))


def test_parts_and_copies(kernels: Kernels) -> None:
    """A part of an image works as its copy does, and the result is never the image's memory."""
    image = np.random.default_rng(0).integers(0, 256, (20, 30, 3), np.uint8)
    part = image[3:15, 4:28]
    assert_array_equal(kernels.reduce_gray(part, 2), kernels.reduce_gray(part.copy(), 2))
    gray = image[..., 0].copy()
    assert not np.shares_memory(kernels.reduce_gray(gray, 1), gray)


@given(images, st.data())
def test_part(image: Image, data: st.DataObject) -> None:
    """In a region the levels are those of the whole image, elsewhere 0, by both sets of kernels."""
    step = data.draw(st.integers(1, min(image.shape[:2])))
    whole = _core.reduce_gray(image, step)
    (y0, y1), (x0, x1) = (sorted(data.draw(st.tuples(*2 * [st.integers(0, n)]))) for n in whole.shape)
    expected = np.zeros_like(whole)
    expected[y0:y1, x0:x1] = whole[y0:y1, x0:x1]
    for kernels in (_core, reference):
        assert_array_equal(kernels.reduce_gray(image, step, (x0, y0, x1, y1)), expected)


@pytest.mark.parametrize("region", [(-1, 0, 3, 3), (2, 0, 1, 3), (0, 0, 5, 3), (0, 2, 4, 1), (0, 0, 4, 3)])
def test_bad_region_is_refused(kernels: Kernels, region: tuple[int, int, int, int]) -> None:
    """A region is inside the 4 x 2 cells that there are."""
    with pytest.raises(ValueError, match="region: expected x0, y0, x1, y1 in order, within 4 x 2, got"):
        kernels.reduce_gray(np.zeros((5, 9, 3), np.uint8), 2, region)


@pytest.mark.parametrize("step", [0, -1, 6])
def test_bad_step_is_refused(kernels: Kernels, step: int) -> None:
    """A cell has a side of 1 to the image's smaller side."""
    with pytest.raises(ValueError, match="step: expected 1 to the image's smaller side, got"):
        kernels.reduce_gray(np.zeros((5, 9, 3), np.uint8), step)


def test_bad_images_are_refused() -> None:
    """Other types and shapes are no images."""
    with pytest.raises(TypeError, match="image: expected"):
        _core.reduce_gray(np.zeros((5, 9), np.float32), 1)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="image: expected"):
        _core.reduce_gray(np.zeros((5, 9, 4), np.uint8), 1)
