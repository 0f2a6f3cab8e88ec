# SPDX-License-Identifier: MIT
"""The system's OpenCV gives what its functions promise, by closed forms and by plain NumPy."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tricue import imgproc

RNG = np.random.default_rng(7)
NOISE = RNG.random((24, 36, 3), np.float32)
LONG = np.zeros((1, 32767), np.float32)
PLANE = np.add.outer(3.0 * np.arange(24), 2.0 * np.arange(36)).astype(np.float32)  # 2 column + 3 row
WARP_STEP = 1 / 64  # pixels: OpenCV before version 5 rounds positions to 1/32 pixel


def test_area_scaling_is_the_mean_of_each_cell() -> None:
    """Images scaled down by a whole number are means; float32 rounds sums of 12 numbers."""
    cells = NOISE.reshape(8, 3, 9, 4, 3).mean(axis=(1, 3))
    assert_allclose(imgproc.resize(NOISE, 8, 9, "area"), cells, rtol=0, atol=12 * 2.0**-24)


def test_linear_scaling_keeps_a_plane() -> None:
    """A plane scaled up is the plane between the centers of the outer pixels."""
    rows, columns = ((np.arange(2 * size) + 0.5) / 2 - 0.5 for size in PLANE.shape)
    plane = np.add.outer(3 * rows, 2 * columns)
    assert_allclose(imgproc.resize(PLANE, 48, 72, "linear")[1:-1, 1:-1], plane[1:-1, 1:-1], rtol=1e-6)


def test_cubic_scaling_is_keys_convolution() -> None:
    """Between pixels are the sums of four in a row, with Keys' weights, a = -0.75."""
    away = np.array([1.25, 0.25, 0.75, 1.75])
    weights = np.where(
        away < 1, 1.25 * away**3 - 2.25 * away**2 + 1, -0.75 * (away**3 - 5 * away**2 + 8 * away - 4)
    )
    wide = imgproc.resize(NOISE, 24, 72, "cubic")
    expected = sum(weight * NOISE[:, 5 + tap] for tap, weight in enumerate(weights))
    assert_allclose(wide[:, 13], expected, rtol=1e-5)  # at column 6.25


@pytest.mark.parametrize("border", ["reflect", "replicate"])
def test_gaussian_blur_is_a_product_of_gaussians(border: Any) -> None:
    """A blurred impulse far from the border is the Gaussian of the sigma, with sum 1."""
    image = np.zeros((41, 41))
    image[20, 20] = 1
    bell = np.exp(-0.5 * ((np.arange(41) - 20) / 1.5) ** 2)
    bell[np.abs(np.arange(41) - 20) > 6] = 0  # OpenCV ends it at 4 sigma
    bell /= bell.sum()
    assert_allclose(imgproc.gaussian_blur(image, 1.5, border), np.outer(bell, bell), atol=1e-15)


def test_borders_of_a_blur() -> None:
    """Beyond the border a row is mirrored about its last pixel, or repeats it."""
    image = np.zeros((5, 9))
    image[:, 1] = 1
    reflected, replicated = (imgproc.gaussian_blur(image, 0.5, border) for border in ("reflect", "replicate"))
    assert_allclose(reflected[2, 0], 2 * replicated[2, 0])


def test_windows() -> None:
    """Erosion, dilation and box blur are minimum, maximum and mean of each square."""
    windows = np.lib.stride_tricks.sliding_window_view(NOISE[..., 0], (3, 3))
    inner = np.ascontiguousarray(NOISE[..., 0])
    assert_array_equal(imgproc.erode(inner, 3)[1:-1, 1:-1], windows.min(axis=(2, 3)))
    assert_array_equal(imgproc.dilate(inner, 3)[1:-1, 1:-1], windows.max(axis=(2, 3)))
    assert_allclose(imgproc.box_blur(inner, 3)[1:-1, 1:-1], windows.mean(axis=(2, 3)), rtol=1e-6)


def test_even_squares_have_an_anchor() -> None:
    """The anchor says which pixel of an even square gets the maximum."""
    image = np.zeros((7, 7))
    image[3, 3] = 1
    found = [np.argwhere(imgproc.dilate(image, 2, anchor)).min(axis=0).tolist() for anchor in (0, 1)]
    assert found == [[2, 2], [3, 3]]


def test_shift_moves_a_plane() -> None:
    """A plane moved by a part of a pixel is the plane less its slope times the part, and constant around."""
    moved = imgproc.shift(PLANE, 2.25, -1.5, 24, 36, value=-7)
    assert_allclose(moved[:22, 4:], (PLANE - 2 * 2.25 + 3 * 1.5)[:22, 4:], rtol=1e-6)
    assert_array_equal(moved[:, :2], np.full((24, 2), -7))
    assert_array_equal(imgproc.shift(PLANE, 4, 0, 10, 20, "nearest", value=math.nan)[:, 4:], PLANE[:10, :16])
    assert_array_equal(imgproc.shift(PLANE, 3, 2, 26, 39, border="replicate")[2:, 3:], PLANE)
    assert_array_equal(imgproc.shift(PLANE, 3, 2, 26, 39, border="replicate")[:2, 3:], PLANE[[0, 0]])


def test_homography_maps_a_plane() -> None:
    """A homography from the image's pixels to the result's, to the step at which OpenCV interpolates."""
    homography = np.array([[1.1, 0.1, 3], [-0.05, 0.95, 2], [1e-3, 5e-4, 1]])
    rows, columns = np.indices((20, 30))
    x, y, w = np.linalg.inv(homography) @ np.stack([columns.ravel(), rows.ravel(), np.ones(600)])
    x, y = (axis.reshape(20, 30) for axis in (x / w, y / w))
    inside = (x > 0) & (x < 35) & (y > 0) & (y < 23)
    warped = imgproc.warp_perspective(PLANE, homography, 20, 30)
    assert inside.sum() > 300
    assert_allclose(warped[inside], (2 * x + 3 * y)[inside], rtol=0, atol=5 * WARP_STEP * 1.01)


def test_remap_reads_between_pixels() -> None:
    """Positions on OpenCV's grid of 1/32 pixel are exact; beyond the border it repeats, or there is 0."""
    columns = RNG.integers(0, 35 * 32, (6, 5)).astype(np.float32) / 32
    rows = RNG.integers(0, 23 * 32, (6, 5)).astype(np.float32) / 32
    assert_allclose(imgproc.remap(PLANE, columns, rows), 2 * columns + 3 * rows, rtol=1e-5)
    around = imgproc.remap(PLANE, columns + 36, rows, "wrap")
    assert_allclose(around, imgproc.remap(PLANE, columns, rows, "wrap"), rtol=1e-6)
    assert_array_equal(imgproc.remap(PLANE, columns + 40, rows), np.zeros((6, 5)))


def test_copy_where_copies_in_place() -> None:
    """Pixels where the mask is true come from the source, also into a part of an image; others stay."""
    target = np.zeros((30, 40, 3), np.float32)
    mask = NOISE[..., 0] > 0.5
    imgproc.copy_where(NOISE, mask, target[3:27, 2:38])
    assert_array_equal(target[3:27, 2:38], NOISE * mask[..., None])
    assert target.sum() == target[3:27, 2:38].sum()


def test_fill_polygon() -> None:
    """A rectangle is filled with its outline, which is part of it."""
    filled = imgproc.fill_polygon(np.array([[3, 2], [10, 2], [10, 6], [3, 6]], np.int32), 9, 12)
    expected = np.zeros((9, 12), np.float32)
    expected[2:7, 3:11] = 1
    assert_array_equal(filled, expected)


def test_lab_of_known_colors() -> None:
    """White, black and sRGB's red as the standard has them; the way back leads to the colors."""
    colors = np.array([[[1, 1, 1], [0, 0, 0], [0, 0, 1]]], np.float32)
    lab = imgproc.bgr_to_lab(colors)
    assert_allclose(lab[0], [[100, 0, 0], [0, 0, 0], [53.24, 80.09, 67.20]], atol=0.05)
    assert_allclose(imgproc.lab_to_bgr(lab), colors, atol=2e-3)


def test_gray_is_the_weighted_sum() -> None:
    """Gray is 0.114 blue + 0.587 green + 0.299 red, rounded, in OpenCV's fixed point."""
    colors = RNG.integers(0, 256, (20, 30, 3), np.uint8)
    assert_allclose(imgproc.bgr_to_gray(colors), colors @ [0.114, 0.587, 0.299], atol=0.51)


def test_rows_may_be_padded() -> None:
    """A part of an image works as the image does."""
    part = NOISE[2:20, 5:30]
    assert_array_equal(imgproc.gaussian_blur(part, 1.0), imgproc.gaussian_blur(part.copy(), 1.0))
    assert_array_equal(imgproc.resize(part[..., :3], 9, 5, "area"), imgproc.resize(part.copy(), 9, 5, "area"))


REFUSED: dict[str, tuple[Callable[[], Any], type[Exception], str]] = {
    "type": (lambda: imgproc.erode(PLANE.astype(np.int16), 3), TypeError, "image: expected a uint8"),
    "shape": (lambda: imgproc.erode(PLANE[0], 3), ValueError, "image: expected"),
    "channels": (lambda: imgproc.erode(np.zeros((4, 4, 5)), 3), ValueError, "image: expected"),
    "nothing": (lambda: imgproc.erode(np.zeros((0, 4)), 3), ValueError, "image: expected"),
    "mirrored": (lambda: imgproc.erode(PLANE[:, ::-1], 3), ValueError, "packed pixels"),
    "upside down": (lambda: imgproc.erode(PLANE[::-1], 3), ValueError, "packed pixels"),
    "side": (lambda: imgproc.dilate(PLANE, 0), ValueError, "side: expected 1 or more"),
    "huge side": (lambda: imgproc.box_blur(PLANE, 2**31 - 1), ValueError, "side: expected at most"),
    "huge window": (lambda: imgproc.erode(PLANE, 2**31 - 1), ValueError, "side: expected at most"),
    "anchor": (lambda: imgproc.dilate(PLANE, 2, 2), ValueError, "anchor: expected"),
    "size": (lambda: imgproc.resize(PLANE, 0, 5, "area"), ValueError, "height, width: expected"),
    "sigma": (lambda: imgproc.gaussian_blur(PLANE, 0.0), ValueError, "sigma: expected"),
    "huge sigma": (lambda: imgproc.gaussian_blur(PLANE, 1e5), ValueError, "sigma: expected"),
    "endless sigma": (lambda: imgproc.gaussian_blur(PLANE, np.inf), ValueError, "sigma: expected"),
    "method": (lambda: imgproc.resize(PLANE, 2, 2, "best"), ValueError, "method: expected one of"),  # type: ignore[arg-type]
    "matrix": (lambda: imgproc.warp_perspective(PLANE, np.eye(2), 2, 2), ValueError, "matrix: expected"),
    "maps": (lambda: imgproc.remap(PLANE, PLANE, PLANE[:5]), ValueError, "rows: expected the shape"),
    "long": (lambda: imgproc.shift(LONG, 0, 0, 1, 5), ValueError, "image: expected at most 32766"),
    "long warp": (
        lambda: imgproc.warp_perspective(LONG, np.eye(3), 1, 5),
        ValueError,
        "image: expected at most",
    ),
    "long maps": (lambda: imgproc.remap(PLANE, LONG, LONG), ValueError, "columns: expected at most 32766"),
    "target": (lambda: imgproc.copy_where(PLANE, PLANE > 0, NOISE), ValueError, "target: expected"),
    "points": (
        lambda: imgproc.fill_polygon(np.zeros((3, 3), np.int32), 4, 4),
        ValueError,
        "points: expected",
    ),
    "lab": (lambda: imgproc.bgr_to_lab(PLANE), ValueError, "image: expected float32"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_bad_input_is_refused(case: str) -> None:
    """Each error names the argument and what was expected."""
    call, error, text = REFUSED[case]
    with pytest.raises(error, match=text):
        call()
