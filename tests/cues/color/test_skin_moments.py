# SPDX-License-Identifier: MIT
"""Count, mean and covariance of skin pixels."""

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

images = arrays(np.uint8, st.tuples(st.integers(0, 8), st.integers(0, 140), st.just(3)))
steps = st.integers(1, 5)
regions = st.tuples(*[st.integers(-10, 150)] * 4)


def tolerance(image: Image) -> float:
    """Bound of rounding: squares of coordinates, each rounded a few times on the way to a variance."""
    size = float(max(1, *image.shape[:2]))
    return 16 * float(np.finfo(float).eps) * size * size


def paint(height: int, width: int, rows: slice, columns: slice) -> Image:
    """A rectangle of skin on black."""
    image = np.zeros((height, width, 3), np.uint8)
    image[rows, columns] = SKIN
    return image


@given(images, arrays(np.uint8, 3), st.floats(-1, 1), regions, steps)
def test_twin_measures_the_same(
    image: Image, color: Image, threshold: float, region: tuple[int, int, int, int], step: int
) -> None:
    """Native and reference agree for any threshold, region and step, within rounding; the counts exactly."""
    native = _core.skin_moments(image, color, threshold, region, step)
    twin = reference.skin_moments(image, color, threshold, region, step)
    assert native[0] == twin[0]
    assert_allclose(native, twin, rtol=0, atol=tolerance(image))


def test_agrees_with_opencv(kernels: Kernels, picture: Image, color: Image) -> None:
    """OpenCV finds the same area, central moments and, but for the half pixel, centroid."""
    height, width = picture.shape[:2]
    moments = kernels.skin_moments(picture, color, 0.1, (0, 0, width, height), 1)
    if not picture.size:
        assert_array_equal(moments, np.zeros(6))
        return
    binary = (reference.skin_boundary(picture, color) > 25.5).astype(np.uint8)
    baseline = cv2.moments(binary, binaryImage=True)
    assert moments[0] == baseline["m00"]
    if baseline["m00"] > 0:
        center = [baseline["m10"] / baseline["m00"] + 0.5, baseline["m01"] / baseline["m00"] + 0.5]
        spread = [baseline[name] / baseline["m00"] for name in ("mu20", "mu02", "mu11")]
        assert_allclose(moments[1:], center + spread, rtol=1e-12, atol=tolerance(picture))


@pytest.mark.parametrize("corner", [(0, 0), (37, 5), (1500, 1030)])
def test_rectangle(kernels: Kernels, corner: tuple[int, int]) -> None:
    """A rectangle, over several tiles too, has variances (w^2 - 1)/12, (h^2 - 1)/12, covariance 0."""
    (x, y), width, height = corner, 700, 50
    image = paint(1100, 2300, slice(y, y + height), slice(x, x + width))
    expected = [width * height, x + width / 2, y + height / 2, (width**2 - 1) / 12, (height**2 - 1) / 12, 0]
    moments = kernels.skin_moments(image, SKIN, BINARY, (0, 0, 2300, 1100), 1)
    assert_allclose(moments, expected, rtol=0, atol=tolerance(image))


def test_diagonal(kernels: Kernels) -> None:
    """Skin along x = y has the covariance of its variances, (n^2 - 1)/12."""
    image = np.zeros((40, 40, 3), np.uint8)
    image[range(40), range(40)] = SKIN
    moments = kernels.skin_moments(image, SKIN, BINARY, (0, 0, 40, 40), 1)
    assert_allclose(moments[3:], [(40**2 - 1) / 12] * 3, rtol=1e-14)


def test_region_is_all_that_counts(kernels: Kernels, picture: Image, color: Image) -> None:
    """Moments of a region are those of the picture cut there, moved by its corner."""
    height, width = picture.shape[:2]
    x0, y0, x1, y1 = width // 4, height // 4, width - width // 5, height - height // 5
    inside = kernels.skin_moments(picture, color, 0.1, (x0, y0, x1, y1), 1)
    cut = kernels.skin_moments(picture[y0:y1, x0:x1], color, 0.1, (0, 0, x1 - x0, y1 - y0), 1)
    shift = np.array([0, x0, y0, 0, 0, 0]) if cut[0] else np.zeros(6)
    assert_allclose(inside, cut + shift, rtol=0, atol=tolerance(picture))


@pytest.mark.parametrize("step", [2, 3, 7])
def test_some_rows_tell_about_the_same(kernels: Kernels, step: int) -> None:
    """Every step-th row of a rectangle has its area, center and variances, but for the rows at its edges."""
    image = paint(300, 200, slice(40, 40 + 42 * 4), slice(20, 120))
    region = (10, 30, 190, 290)
    few, all_of_them = (kernels.skin_moments(image, SKIN, BINARY, region, each) for each in (step, 1))
    assert_allclose(few[0], all_of_them[0], rtol=step / 168)
    assert_allclose(few[[1, 3]], all_of_them[[1, 3]], rtol=1e-12)
    assert_allclose(few[2], all_of_them[2], atol=step / 2)
    assert_allclose(few[4], all_of_them[4], rtol=2 * step / 168)


def test_region_is_clipped(kernels: Kernels, picture: Image, color: Image) -> None:
    """A region that reaches far over every edge is the whole picture."""
    height, width = picture.shape[:2]
    whole = kernels.skin_moments(picture, color, 0.1, (0, 0, width, height), 1)
    beyond = kernels.skin_moments(picture, color, 0.1, (-(2**31), -7, 2**31 - 1, 10**6), 1)
    assert_array_equal(whole, beyond)


@pytest.mark.parametrize(
    "region",
    [
        (5, 5, 5, 9),
        (9, 0, 3, 9),
        (30, 0, 40, 9),
        (-9, -9, 0, 0),
        (20, 20, -5, -5),
        (0, 2**31 - 1, 9, 2**31 - 1),
    ],
)
def test_nothing_to_see(kernels: Kernels, region: tuple[int, int, int, int]) -> None:
    """An empty region, or one outside the picture, has no skin: zeros."""
    image = np.full((10, 20, 3), 255, np.uint8)
    for step in (1, 2**31 - 1):
        assert_array_equal(kernels.skin_moments(image, SKIN, -1.0, region, step), np.zeros(6))


def test_thresholds_at_their_ends(kernels: Kernels) -> None:
    """Above 1 there is no skin, not even white by white; above -1 all is, save black by white."""
    white, black = np.full((3, 4, 3), 255, np.uint8), np.zeros((3, 4, 3), np.uint8)
    reference_color, region = np.full(3, 255, np.uint8), (0, 0, 4, 3)
    assert kernels.skin_moments(white, reference_color, 1.0, region, 1)[0] == 0
    assert kernels.skin_moments(white, reference_color, np.nextafter(1, 0), region, 1)[0] == 12
    assert kernels.skin_moments(black, reference_color, -1.0, region, 1)[0] == 0
    assert kernels.skin_moments(black + np.uint8(1), reference_color, -1.0, region, 1)[0] == 12


@pytest.mark.parametrize("threshold", [np.nan, np.inf, -1.01, 2.0])
def test_refuses_other_thresholds(kernels: Kernels, threshold: float) -> None:
    """A threshold outside [-1, 1] is an error that says so."""
    with pytest.raises(ValueError, match=r"threshold: expected a number in \[-1, 1\], got"):
        kernels.skin_moments(paint(2, 2, slice(1), slice(1)), SKIN, threshold, (0, 0, 2, 2), 1)


@pytest.mark.parametrize("step", [0, -3])
def test_refuses_other_steps(kernels: Kernels, step: int) -> None:
    """Rows are at least one apart."""
    with pytest.raises(ValueError, match="step: expected at least 1, got"):
        kernels.skin_moments(paint(2, 2, slice(1), slice(1)), SKIN, 0.1, (0, 0, 2, 2), step)


BAD: list[tuple[Any, Any, Any, type[Exception], str]] = [
    (np.zeros((2, 2, 3)), SKIN, (0, 0, 1, 1), TypeError, "image: expected a uint8 BGR image"),
    (np.zeros((2, 2, 3), np.uint8), SKIN[:2], (0, 0, 1, 1), ValueError, "reference: expected a uint8 color"),
    (np.zeros((2, 2, 3), np.uint8), SKIN, (0, 0, 1), TypeError, "region: "),
    (np.zeros((2, 2, 3), np.uint8), SKIN, (0, 0, 1.5, 1), TypeError, "region: "),
]


@pytest.mark.parametrize(("image", "color", "region", "error", "message"), BAD)
def test_native_refuses(image: Any, color: Any, region: Any, error: type[Exception], message: str) -> None:
    """Another type or shape is named, not converted."""
    with pytest.raises(error, match=message):
        _core.skin_moments(image, color, 0.1, region, 1)
