# SPDX-License-Identifier: MIT
"""Turned windows of an image on one grid of samples."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]


def noise(rows: int, columns: int, seed: int = 0) -> Image:
    """An image whose every pixel differs from its neighbors."""
    return np.random.default_rng(seed).integers(0, 256, (rows, columns, 3), np.uint8)


def turned(x: float, y: float, width: float, height: float, degrees: float) -> Floats:
    """(1, 6): one window around (x, y), turned clockwise."""
    cosine, sine = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[x, y, width * cosine, width * sine, -height * sine, height * cosine]])


@pytest.mark.parametrize("seed", range(20))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same bytes of any image, also of a part of one, of windows inside, across the edge and
    far away, turned, sheared and mirrored, on any grid: all sums are of integers.
    """
    rng = np.random.default_rng(seed)
    wide = noise(*rng.integers(1, 90, 2).tolist(), seed)
    image = wide[:, : int(rng.integers(1, wide.shape[1] + 1))]
    count, (rows, columns) = int(rng.integers(0, 6)), rng.integers(1, 40, 2).tolist()
    windows = np.column_stack(
        [rng.normal(20, 40, (count, 2)), rng.normal(size=(count, 4)) * 10 ** rng.uniform(-2, 3, (count, 1))]
    )
    native = _core.sample_turned_windows(image, windows, rows, columns)
    assert native.dtype == np.uint8
    assert native.shape == (count, rows, columns, 3)
    assert_array_equal(native, reference.sample_turned_windows(image, windows, rows, columns))


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (7, 1), (2, 2), (1, 2), (2, 1), (3, 4)])
def test_native_is_the_twin_of_small_images(shape: tuple[int, int]) -> None:
    """Also where a pixel has no neighbors, and where memory ends right after it."""
    image = noise(*shape)
    windows = np.concatenate([turned(shape[1] / 2, shape[0] / 2, 9, 9, degrees) for degrees in (0, 30, 200)])
    assert_array_equal(
        _core.sample_turned_windows(image, windows, 12, 13),
        reference.sample_turned_windows(image, windows, 12, 13),
    )


@pytest.mark.parametrize("size", [1e300, 5e-324, 1e18])
def test_native_is_the_twin_of_monstrous_windows(size: float) -> None:
    """No place or side is too large or too small."""
    image = noise(7, 9)
    windows = np.array(
        [[x, y, size, -size, 3.0, size] for x in (-1.7e308, -3.0, 1.7e308) for y in (-1e9, 2.5, 1e300)]
    )
    assert_array_equal(
        _core.sample_turned_windows(image, windows, 3, 5),
        reference.sample_turned_windows(image, windows, 3, 5),
    )


@pytest.mark.parametrize("quarters", [0, 1, 2, 3])
def test_quarter_turns_are_those_of_the_image(kernels: Kernels, quarters: int) -> None:
    """A window of whole pixels that is turned by a quarter clockwise has the pixels of the image turned back,
    with NumPy's rot90.
    """
    image = noise(24, 24)
    right, down = [((1, 0), (0, 1)), ((0, 1), (-1, 0)), ((-1, 0), (0, -1)), ((0, -1), (1, 0))][quarters]
    window = np.array([[12, 12, *right, *down]], float) * [1, 1, 16, 16, 16, 16]
    samples = kernels.sample_turned_windows(image, window, 16, 16)[0]
    assert_array_equal(samples, np.rot90(image[4:20, 4:20], quarters))


@pytest.mark.parametrize("degrees", [0.0, 7.0, 45.0, 123.0, 200.0])
def test_turns_as_opencv(kernels: Kernels, degrees: float) -> None:
    """Samples of about a pixel are cv2's warpAffine: places are rounded to 1/16 pixel here and 1/32 there,
    that is 3/64 of the greatest difference of neighbors along each axis, and levels twice.
    """
    image = cv2.GaussianBlur(noise(80, 90), (0, 0), 3)
    steepest = max(abs(np.diff(image.astype(int), axis=axis)).max() for axis in (0, 1))
    window = turned(43.3, 38.9, 40.0, 40.0, degrees)
    samples = kernels.sample_turned_windows(image, window, 40, 40)[0]
    axes = np.array([[window[0, 2], window[0, 4]], [window[0, 3], window[0, 5]]]) / 40
    corner = window[0, :2] - 0.5 - axes @ [19.5, 19.5]
    matrix = np.column_stack([axes, corner])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    expected = cv2.warpAffine(image, matrix, (40, 40), flags=flags, borderMode=cv2.BORDER_REPLICATE)
    assert abs(samples.astype(int) - expected).max() <= 2 * steepest * 3 / 64 + 1


@pytest.mark.parametrize("step", [1, 2, 3, 4])
def test_samples_are_means_of_blocks(kernels: Kernels, step: int) -> None:
    """Upright ones of whole pixels are the means of these, rounded half up."""
    image = noise(8 * step, 9 * step)
    window = turned(4.5 * step, 4 * step, 9 * step, 8 * step, 0)
    samples = kernels.sample_turned_windows(image, window, 8, 9)[0]
    sums = image.astype(int).reshape(8, step, 9, step, 3).sum(axis=(1, 3))
    assert_array_equal(samples, (2 * sums + step**2) // (2 * step**2))


@pytest.mark.parametrize("step", [2, 3, 4, 9])
def test_samples_are_means_of_squares(kernels: Kernels, step: int) -> None:
    """Turned ones are those of cv2's mean over squares of 2, 3 or 4 pixels, read between them: places are
    rounded to 1/16 pixel here and 1/32 there, that is 3/64 of the greatest difference of neighbors along each
    axis, and levels twice each.
    """
    image = cv2.GaussianBlur(noise(150, 150), (0, 0), 2)
    side = min(step, 4)
    means = cv2.blur(image, (side, side), anchor=(0, 0))
    steepest = max(abs(np.diff(means.astype(int), axis=axis)).max() for axis in (0, 1))
    window = turned(73.3, 75.9, 10 * step, 10 * step, 33)
    samples = kernels.sample_turned_windows(image, window, 10, 10)[0]
    axes = np.array([[window[0, 2], window[0, 4]], [window[0, 3], window[0, 5]]]) / 10
    matrix = np.column_stack([axes, window[0, :2] - side / 2 - axes @ [4.5, 4.5]])
    expected = cv2.warpAffine(means, matrix, (10, 10), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP)
    assert abs(samples.astype(int) - expected).max() <= 2 * steepest * 3 / 64 + 2


@pytest.mark.parametrize("degrees", [0.0, 33.0, -120.0])
@pytest.mark.parametrize("length", [3.7, 24.0, 60.3, 101.1])
def test_reads_a_ramp_where_samples_are(kernels: Kernels, degrees: float, length: float) -> None:
    """On a ramp of 2 levels a pixel each sample is the level at its middle, to half a level of rounding and
    1/32 pixel.
    """
    ramp = np.repeat(np.broadcast_to(2 * np.arange(120, dtype=np.uint8), (110, 120))[..., None], 3, 2)
    window = turned(60.2, 55.7, length, 30.0, degrees)
    samples = kernels.sample_turned_windows(ramp.copy(), window, 10, 24)[0]
    across, down = (np.arange(24) + 0.5) / 24 - 0.5, (np.arange(10) + 0.5) / 10 - 0.5
    middles = 60.2 - 0.5 + across * window[0, 2] + down[:, None] * window[0, 4]
    assert abs(samples - 2 * middles[..., None]).max() <= 0.5 + 2 / 32


def test_repeats_the_edge(kernels: Kernels) -> None:
    """Where a sample is a pixel, beyond the image lies its edge, as in an image that is wider by it."""
    image = noise(20, 30)
    wide = np.pad(image, ((50, 50), (50, 50), (0, 0)), mode="edge")
    windows = np.concatenate([turned(-5.25, 3.5, 17, 13, 20), turned(28, 17.5, 20, 10, 250)])
    shifted = windows + [50, 50, 0, 0, 0, 0]
    assert_array_equal(
        kernels.sample_turned_windows(image, windows, 13, 17),
        kernels.sample_turned_windows(wide, shifted, 13, 17),
    )


@pytest.mark.parametrize("side", [2, 3, 4])
def test_squares_stay_in_the_image(kernels: Kernels, side: int) -> None:
    """A sample far beyond a corner is the mean of the square in that corner."""
    image = noise(20, 30)
    window = turned(0, 0, 500 * side, 500 * side, 0)
    samples = kernels.sample_turned_windows(image, window, 500, 500)[0]
    corner = image[-side:, -side:].astype(int).sum(axis=(0, 1))
    assert_array_equal(samples[-1, -1], (2 * corner + side**2) // (2 * side**2))


@pytest.mark.parametrize("level", [0, 1, 254, 255])
def test_one_color_stays(kernels: Kernels, level: int) -> None:
    """Weights have a sum of one, exactly."""
    image = np.full((33, 44, 3), level, np.uint8)
    windows = np.concatenate([turned(20, 15, length, length / 3, length) for length in (5, 31.3, 100, 700)])
    assert (kernels.sample_turned_windows(image, windows, 15, 11) == level).all()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"image": np.zeros((0, 4, 3), np.uint8)}, "image: expected at least one pixel, got none"),
    ({"image": np.zeros((4, 0, 3), np.uint8)}, "image: expected at least one pixel, got none"),
    ({"windows": np.ones((2, 4))}, r"windows: expected shape \(2, 6\), got \(2, 4\)"),
    ({"windows": np.full((2, 6), np.nan)}, "windows: expected finite numbers, got nan"),
    ({"windows": np.array([[0, 0, 0.0, 0, 1, 2]])}, "windows: expected sides that aren't 0, got 0"),
    ({"windows": np.array([[0, 0, 1.0, 2, 0, 0]])}, "windows: expected sides that aren't 0, got 0"),
    ({"rows": 0}, "rows: expected 1 to 16384, got 0"),
    ({"columns": -1}, "columns: expected 1 to 16384, got -1"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    good = {"image": np.zeros((4, 4, 3), np.uint8), "windows": np.ones((1, 6)), "rows": 2, "columns": 2}
    with pytest.raises(ValueError, match=message):
        kernels.sample_turned_windows(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Images of four channels and other numbers are named, never converted."""
    with pytest.raises(ValueError, match="image: expected a uint8 BGR image"):
        _core.sample_turned_windows(np.zeros((4, 4, 4), np.uint8), np.ones((1, 6)), 2, 2)
    with pytest.raises(TypeError, match="windows: expected float64"):
        _core.sample_turned_windows(np.zeros((4, 4, 3), np.uint8), np.ones((1, 6), np.float32), 2, 2)
