# SPDX-License-Identifier: MIT
"""Pixels read under ellipses."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.fuzz.guarded import guarded

Image = NDArray[np.uint8]
ONE = np.array([[4.0, 3.0, 2.0, 2.0]])
CENTER = np.zeros((1, 2))


def case(seed: int, ellipses: int, n: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Ellipses in, across and far outside the image; places in and round them."""
    rng = np.random.default_rng(seed)
    each = np.column_stack([rng.normal(40, 60, (ellipses, 2)), rng.uniform(0, 40, (ellipses, 2))])
    return each, rng.uniform(-2, 2, (n, 2))


@given(st.integers(0, 2**32), st.integers(0, 9), st.integers(0, 40))
def test_twin_reads_the_same(seed: int, ellipses: int, n: int) -> None:
    """Native and reference agree to the last bit: both compute places in float32, in the same order."""
    image = np.random.default_rng(seed).integers(0, 256, (57, 83, 3), np.uint8)
    each, pattern = case(seed, ellipses, n)
    assert_array_equal(
        _core.sample_ellipses(image, each, pattern), reference.sample_ellipses(image, each, pattern)
    )


def test_agrees_with_opencv(kernels: Kernels, picture: Image) -> None:
    """OpenCV's remap with nearest neighbors and a replicated border reads the same pixels; crops with padded
    rows too.
    """
    if picture.size == 0:
        pytest.skip("remap takes no empty picture")
    height, width = picture.shape[:2]
    v, u = np.mgrid[-5 : height + 5, -5 : width + 5][:, :64, :64].reshape(2, -1)
    pattern = np.stack([u, v], axis=1) + 0.5  # the middle of each pixel, where remap's grid has whole numbers
    samples = kernels.sample_ellipses(picture, np.array([[0.0, 0.0, 1.0, 1.0]]), pattern)
    columns, rows = u.astype(np.float32)[None], v.astype(np.float32)[None]
    expected = cv2.remap(
        np.ascontiguousarray(picture), columns, rows, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE
    )
    assert_array_equal(samples[0].T, expected[0])


def test_example_by_hand(kernels: Kernels) -> None:
    """The place (0.5, -1) of the ellipse (4, 3, 2, 2) is (5, 1); planes come as blue, green, red."""
    image = np.arange(6 * 8 * 3, dtype=np.uint8).reshape(6, 8, 3)
    samples = kernels.sample_ellipses(image, ONE, np.array([[0.0, 0.0], [0.5, -1.0]]))
    assert samples.shape == (1, 3, 2)
    assert samples.dtype == np.uint8
    assert_array_equal(samples[0].T, [image[3, 4], image[1, 5]])


def test_a_repeated_pixel_is_read_to_its_end(kernels: Kernels) -> None:
    """Nothing is read beyond the three bytes of a single pixel, of which all rows are views."""
    image = np.broadcast_to(guarded(np.array([[[1, 2, 3]]], np.uint8)), (5, 1, 3))
    assert_array_equal(kernels.sample_ellipses(image, ONE, CENTER), [[[1], [2], [3]]])


def test_moves_with_the_image(kernels: Kernels) -> None:
    """An ellipse moved by whole pixels over a moved image reads the same."""
    image = np.random.default_rng(0).integers(0, 256, (60, 80, 3), np.uint8)
    ellipses = np.array([[30.25, 28.5, 7.0, 9.0]])
    _, pattern = case(1, 1, 50)
    pattern = pattern / 4
    moved = np.roll(image, (4, -6), axis=(0, 1))
    there = ellipses + [-6, 4, 0, 0]
    assert_array_equal(
        kernels.sample_ellipses(image, ellipses, pattern), kernels.sample_ellipses(moved, there, pattern)
    )


@pytest.mark.parametrize(
    ("ellipses", "pattern", "message"),
    [
        (np.zeros((1, 3)), CENTER, r"ellipses: expected shape \(1, 4\), got \(1, 3\)"),
        (ONE, np.zeros((5, 3)), r"pattern: expected shape \(5, 2\), got \(5, 3\)"),
        (ONE * np.nan, CENTER, "ellipses: expected finite numbers, got nan"),
        (ONE * np.inf, CENTER, "ellipses: expected finite numbers, got inf"),
        (ONE, CENTER + np.nan, "pattern: expected finite numbers, got nan"),
    ],
)
def test_refuses_what_is_no_ellipse(kernels: Kernels, ellipses: Any, pattern: Any, message: str) -> None:
    """Wrong shapes and numbers that aren't finite are named."""
    with pytest.raises(ValueError, match=message):
        kernels.sample_ellipses(np.zeros((6, 8, 3), np.uint8), ellipses, pattern)


def test_refuses_an_empty_image(kernels: Kernels) -> None:
    """An image without pixels has none to read."""
    with pytest.raises(ValueError, match="image: expected at least one pixel, got none"):
        kernels.sample_ellipses(np.zeros((0, 8, 3), np.uint8), ONE, CENTER)


def test_native_refuses_other_images() -> None:
    """Another type, shape or layout is named, not converted."""
    gray = np.zeros((6, 8), np.uint8)
    with pytest.raises(
        ValueError, match=r"image: expected a uint8 BGR image \(H, W, 3\), got uint8 \(6, 8\)"
    ):
        _core.sample_ellipses(gray, ONE, CENTER)
    with pytest.raises(TypeError, match="image: expected a uint8 BGR image"):
        _core.sample_ellipses(np.zeros((6, 8, 3), np.float32), ONE, CENTER)
    with pytest.raises(ValueError, match="image: expected packed pixels"):
        _core.sample_ellipses(np.zeros((6, 8, 3), np.uint8)[:, ::-1], ONE, CENTER)
    with pytest.raises(TypeError, match=r"ellipses: expected float64 \(N, D\), got float32"):
        _core.sample_ellipses(np.zeros((6, 8, 3), np.uint8), ONE.astype(np.float32), CENTER)


@pytest.mark.parametrize("ellipse", [(80, 60, 1e39, 10), (1e300, -1e39, 5, 5), (-1e39, 60, 1e39, 1e308)])
def test_ellipses_beyond_float32_read_the_border(ellipse: tuple[float, ...]) -> None:
    """Numbers that are finite as float64 and infinite as float32 stay inside the image; NaN reads pixel 0."""
    image = np.random.default_rng(3).integers(0, 256, (120, 160, 3), np.uint8)
    pattern = np.tile([[0.0, 0.0], [0.5, 0.5], [1.0, -1.0], [1e300, -1e39]], (3, 1))
    found = _core.sample_ellipses(image, np.array([ellipse]), pattern)
    assert_array_equal(found, reference.sample_ellipses(image, np.array([ellipse]), pattern))


def test_images_of_many_bytes_are_refused() -> None:
    """Places are offsets of 32 bits: rows that are farther apart in memory would be read elsewhere."""
    rows = np.lib.stride_tricks.as_strided(np.zeros(6, np.uint8), (400, 2, 3), (6_000_000, 3, 1))
    with pytest.raises(ValueError, match=r"^image: expected at most 2 GB from its first to its last pixel"):
        _core.sample_ellipses(rows, ONE, CENTER)


def test_images_of_many_rows_are_refused() -> None:
    """So many rows aren't an image, and float32 can't tell them apart."""
    rows = np.broadcast_to(np.zeros((1, 2, 3), np.uint8), (2**24 + 1, 2, 3))
    with pytest.raises(ValueError, match=r"^image: expected at most 16777216 rows and columns, got"):
        _core.sample_ellipses(rows, ONE, CENTER)
