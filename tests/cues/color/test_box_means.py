# SPDX-License-Identifier: MIT
"""Means of a map in boxes round a place."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels


def noise(rows: int, columns: int, seed: int = 0) -> NDArray[np.float32]:
    """A map from 0 to 1."""
    return np.random.default_rng(seed).random((rows, columns)).astype(np.float32)


@pytest.mark.parametrize("seed", range(20))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same for maps of any size and memory layout, any place and any count of boxes, from
    parts of a pixel to far beyond the map: float64's running sums lose less than 1e-12 of the map's sum.
    """
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(1, 80, 2).tolist()
    plane = noise(rows, columns + 3, seed)[:, 1:-2]
    place = rng.uniform(-20, 100, 2).tolist()
    widths, heights = 10 ** rng.uniform(-1, 2.5, (2, int(rng.integers(0, 14))))
    native, twin = (each.box_means(plane, *place, widths, heights) for each in (_core, reference))
    assert native.dtype == twin.dtype == np.float64
    assert native.shape == twin.shape == widths.shape
    assert (abs(native - twin) * widths * heights <= 1e-12 * plane.size).all()


def test_whole_boxes_are_means_of_slices(kernels: Kernels) -> None:
    """Boxes of whole pixels have NumPy's means of their part of the map."""
    plane = noise(20, 31)
    widths, heights = np.array([1.0, 3.0, 31.0, 7.0]), np.array([2.0, 6.0, 20.0, 20.0])
    slices = [
        plane[10 - h // 2 : 10 + h // 2, 15 - w // 2 : 16 + w // 2]
        for w, h in zip(widths.astype(int), heights.astype(int), strict=True)
    ]
    means = [part.mean(dtype=np.float64) for part in slices]
    assert_allclose(kernels.box_means(plane, 15.5, 10.0, widths, heights), means, rtol=1e-12)


def test_ramps_in_closed_form(kernels: Kernels) -> None:
    """The mean of a ramp round a pixel's middle or corner is the ramp's there, however pixels are cut; a map
    of ones has the part of the box that is in it.
    """
    ramp = np.add.outer(np.arange(15), 2 * np.arange(18)).astype(np.float32)
    widths, heights = np.array([0.3, 4.7, 11.1, 16.0]), np.array([3.3, 0.9, 13.0, 7.7])
    means = kernels.box_means(ramp, 9.5, 7.0, widths, heights)
    assert_allclose(means, 6.5 + 2 * 9, rtol=1e-12)
    ones = np.ones((10, 10), np.float32)
    sizes = np.array([5.0, 20.0]), np.array([40.0, 20.0])
    assert_allclose(kernels.box_means(ones, 5.0, 5.0, *sizes), 0.25, rtol=1e-12)
    assert_allclose(kernels.box_means(ones, 10.0, 10.0, *sizes), [0.5 * 0.25, 0.25], rtol=1e-12)
    assert_allclose(kernels.box_means(ones, -90.0, 5.0, *sizes), 0.0, atol=0)


def test_turns_with_the_map(kernels: Kernels) -> None:
    """The transposed map has the transposed boxes' means, the mirrored one the same, and twice the map
    twice the mean.
    """
    plane = noise(17, 12)
    widths, heights = np.array([0.5, 3.7, 9.0, 30.0]), np.array([2.5, 8.1, 4.0, 9.9])
    x, y = 5.2, 9.1
    means = kernels.box_means(plane, x, y, widths, heights)
    turned = np.ascontiguousarray(plane.T)
    assert_allclose(kernels.box_means(turned, y, x, heights, widths), means, rtol=1e-12)
    mirrored = np.ascontiguousarray(plane[::-1, ::-1])
    assert_allclose(kernels.box_means(mirrored, 12 - x, 17 - y, widths, heights), means, rtol=1e-12)
    assert_allclose(kernels.box_means(2 * plane, x, y, widths, heights), 2 * means, rtol=1e-12)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"plane": np.zeros((0, 4), np.float32)}, "plane: expected at least one pixel, got none"),
    ({"plane": np.full((4, 4), np.inf, np.float32)}, "plane: expected finite numbers, got inf"),
    ({"x": np.nan}, "x: expected a finite number, got nan"),
    ({"y": np.inf}, "y: expected a finite number, got inf"),
    ({"widths": np.array([1.0, 0.0])}, "widths: expected numbers above 0, got 0"),
    ({"widths": np.array([1.0, np.nan])}, "widths: expected finite numbers, got nan"),
    ({"heights": np.array([1.0, -2.0])}, "heights: expected numbers above 0, got -2"),
    ({"heights": np.ones(3)}, r"heights: expected shape \(2,\), got \(3,\)"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    good = {"plane": noise(4, 4), "x": 2.0, "y": 2.0, "widths": np.ones(2), "heights": np.ones(2)}
    with pytest.raises(ValueError, match=message):
        kernels.box_means(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    with pytest.raises(TypeError, match="plane: expected a float32 map"):
        _core.box_means(np.zeros((4, 4)), 2.0, 2.0, np.ones(2), np.ones(2))
    with pytest.raises(TypeError, match="widths: expected float64"):
        _core.box_means(noise(4, 4), 2.0, 2.0, np.ones(2, np.float32), np.ones(2))
