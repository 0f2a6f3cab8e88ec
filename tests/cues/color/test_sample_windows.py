# SPDX-License-Identifier: MIT
"""Windows of an image on one grid of samples."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]


def noise(rows: int, columns: int, seed: int = 0) -> Image:
    """An image whose every pixel differs from its neighbors."""
    return np.random.default_rng(seed).integers(0, 256, (rows, columns, 3), np.uint8)


@pytest.mark.parametrize("seed", range(20))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same bytes of any image, of windows inside, across the edge and far away, small and
    large, on any grid: all sums are of integers.
    """
    rng = np.random.default_rng(seed)
    wide = noise(*rng.integers(1, 90, 2).tolist(), seed)
    image = wide[:, : int(rng.integers(1, wide.shape[1] + 1))]
    count, (rows, columns) = int(rng.integers(0, 6)), rng.integers(1, 40, 2).tolist()
    windows = np.column_stack([rng.normal(20, 40, (count, 2)), 10 ** rng.uniform(-2, 3, (count, 2))])
    native = _core.sample_windows(image, windows, rows, columns)
    assert native.dtype == np.uint8
    assert native.shape == (count, rows, columns, 3)
    assert_array_equal(native, reference.sample_windows(image, windows, rows, columns))


@pytest.mark.parametrize("seed", range(10))
def test_gray_is_one_channel(kernels: Kernels, seed: int) -> None:
    """Of a gray image, also of a part of one, samples are those of a channel of BGR with that image in it."""
    rng = np.random.default_rng(seed)
    image = noise(*rng.integers(1, 90, 2).tolist(), seed)
    part = np.ascontiguousarray(image[:, :, 1])[:, : int(rng.integers(1, image.shape[1] + 1))]
    rows, columns = rng.integers(1, 40, 2).tolist()
    windows = np.column_stack([rng.normal(20, 40, (3, 2)), 10 ** rng.uniform(-2, 3, (3, 2))])
    found = kernels.sample_windows(part, windows, rows, columns)
    expected = kernels.sample_windows(np.dstack([part] * 3), windows, rows, columns)
    assert_array_equal(found, expected[..., 0], strict=True)


@pytest.mark.parametrize("sizes", [(1e300, 1e300), (5e-324, 5e-324), (1e18, 1.0)])
def test_native_is_the_twin_of_monstrous_windows(sizes: tuple[float, float]) -> None:
    """No place, step or size is too large or too small."""
    image = noise(7, 9)
    windows = np.array([[x, y, *sizes] for x in (-1.7e308, -3.0, 1.7e308) for y in (-1e9, 2.5, 1e300)])
    assert_array_equal(
        _core.sample_windows(image, windows, 3, 5), reference.sample_windows(image, windows, 3, 5)
    )


@pytest.mark.parametrize(("down", "across"), [(1, 1), (2, 3), (4, 1), (3, 4)])
def test_whole_steps_are_means_of_blocks(kernels: Kernels, down: int, across: int) -> None:
    """Where samples cover whole pixels they are their means, rounded half up; so says cv2's INTER_AREA, too,
    but for how it rounds.
    """
    image = noise(60, 70)
    rows, columns = 12, 14
    x, y = 5, 8
    part = image[y : y + rows * down, x : x + columns * across]
    window = np.array([[x, y, columns * across, rows * down]], float)
    samples = kernels.sample_windows(image, window, rows, columns)[0]
    sums = part.astype(int).reshape(rows, down, columns, across, 3).sum(axis=(1, 3))
    assert_array_equal(samples, (2 * sums + down * across) // (2 * down * across))
    area = cv2.resize(part, (columns, rows), interpolation=cv2.INTER_AREA)
    assert abs(samples.astype(int) - area).max() <= 1


@pytest.mark.parametrize("factor", [2, 4])
def test_enlarges_as_opencv(kernels: Kernels, factor: int) -> None:
    """Smaller steps than a pixel are cv2's INTER_LINEAR to one level; at these factors places are whole
    sixty-fourths.
    """
    image = noise(11, 17)
    rows, columns = 11 * factor, 17 * factor
    samples = kernels.sample_windows(image, np.array([[0, 0, 17, 11]], float), rows, columns)[0]
    linear = cv2.resize(image, (columns, rows), interpolation=cv2.INTER_LINEAR)
    assert abs(samples.astype(int) - linear).max() <= 1


@pytest.mark.parametrize("length", [3.7, 24.0, 60.3, 77.7, 101.1])
def test_reads_a_ramp_where_samples_are(kernels: Kernels, length: float) -> None:
    """On a ramp of 2 levels a pixel each sample is the level at its middle, to half a level of rounding and
    1/128 pixel.
    """
    ramp = np.repeat(np.broadcast_to(2 * np.arange(120, dtype=np.uint8), (40, 120))[..., None], 3, 2)
    samples = kernels.sample_windows(ramp.copy(), np.array([[9.3, 4.1, length, 31.0]]), 10, 24)[0]
    middles = 9.3 + (np.arange(24) + 0.5) * length / 24 - 0.5
    assert abs(samples - 2 * middles[None, :, None]).max() <= 0.5 + 2 / 128


def test_repeats_the_edge(kernels: Kernels) -> None:
    """Beyond the image lies its edge, as in an image that is wider by it."""
    image = noise(20, 30)
    wide = np.pad(image, ((50, 50), (50, 50), (0, 0)), mode="edge")
    windows = np.array([[-20.25, -9.5, 55.5, 33.0], [25.0, 17.5, 20.0, 8.0], [-40.0, 3.0, 12.0, 9.0]])
    shifted = windows + [50, 50, 0, 0]
    assert_array_equal(
        kernels.sample_windows(image, windows, 13, 17), kernels.sample_windows(wide, shifted, 13, 17)
    )


def test_rows_are_as_columns(kernels: Kernels) -> None:
    """The transposed image has transposed windows, and each window is as if it were alone."""
    image = noise(50, 40)
    windows = np.array([[3.3, 8.9, 20.1, 33.3], [-4.0, 30.0, 30.0, 60.0], [0.0, 0.0, 200.0, 1.0]])
    samples = kernels.sample_windows(image, windows, 9, 12)
    turned = np.ascontiguousarray(image.transpose(1, 0, 2))
    others = kernels.sample_windows(turned, np.ascontiguousarray(windows[:, [1, 0, 3, 2]]), 12, 9)
    assert_array_equal(samples, others.transpose(0, 2, 1, 3))
    for i in range(3):
        assert_array_equal(samples[i], kernels.sample_windows(image, windows[i : i + 1], 9, 12)[0])


@pytest.mark.parametrize("level", [0, 1, 254, 255])
def test_one_color_stays(kernels: Kernels, level: int) -> None:
    """Weights have a sum of one, exactly."""
    image = np.full((33, 44, 3), level, np.uint8)
    windows = np.array([[2.7, 3.1, length, length / 3] for length in (5.0, 31.3, 100.0, 700.0)])
    assert (kernels.sample_windows(image, windows, 15, 11) == level).all()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"image": np.zeros((0, 4, 3), np.uint8)}, "image: expected at least one pixel, got none"),
    ({"image": np.zeros((4, 0, 3), np.uint8)}, "image: expected at least one pixel, got none"),
    ({"windows": np.ones((2, 3))}, r"windows: expected shape \(2, 4\), got \(2, 3\)"),
    ({"windows": np.full((2, 4), np.nan)}, "windows: expected finite numbers, got nan"),
    ({"windows": np.array([[0, 0, 1, -2.0]])}, "windows: expected widths and heights above 0, got -2"),
    ({"windows": np.array([[0, 0, 0.0, 2]])}, "windows: expected widths and heights above 0, got 0"),
    ({"rows": 0}, "rows: expected 1 to 16384, got 0"),
    ({"columns": -1}, "columns: expected 1 to 16384, got -1"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    good = {"image": np.zeros((4, 4, 3), np.uint8), "windows": np.ones((1, 4)), "rows": 2, "columns": 2}
    with pytest.raises(ValueError, match=message):
        kernels.sample_windows(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Images of four channels and other numbers are named, never converted."""
    with pytest.raises(ValueError, match="image: expected a uint8 BGR image"):
        _core.sample_windows(np.zeros((4, 4, 4), np.uint8), np.ones((1, 4)), 2, 2)
    with pytest.raises(TypeError, match="windows: expected float64"):
        _core.sample_windows(np.zeros((4, 4, 3), np.uint8), np.ones((1, 4), np.float32), 2, 2)
