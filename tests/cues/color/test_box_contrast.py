# SPDX-License-Identifier: MIT
"""How much more of a map lies in a box than round it."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]


def noise(rows: int, columns: int, seed: int = 0) -> Plane:
    """A map from 0 to 1, (2 rows, 2 columns)."""
    return np.random.default_rng(seed).random((2 * rows, 2 * columns)).astype(np.float32)


@pytest.mark.parametrize("seed", range(20))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same for maps of any size and memory layout, and boxes from parts of a pixel to far
    beyond the map: to float32's rounding of the result, float64's running sums losing less than 1e-12 of the
    map's sum over the box's area.
    """
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(1, 40, 2).tolist()
    wide = noise(rows, columns + 2, seed)
    plane = wide[:, 1:-3]
    width, height = (10 ** rng.uniform(-1, 2.2, 2)).tolist()
    arguments = width, height, float(1 + 10 ** rng.uniform(-1, 0.5)), float(rng.normal(0.5))
    native, twin = _core.box_contrast(plane, *arguments), reference.box_contrast(plane, *arguments)
    assert native.dtype == twin.dtype == np.float32
    assert native.shape == twin.shape == (rows, columns)
    assert_allclose(native, twin, rtol=2e-7, atol=1e-7 + 1e-12 * plane.size / (width * height))


@pytest.mark.parametrize(("width", "height"), [(4, 4), (6, 2), (10, 8)])
def test_is_opencvs_box_filter(kernels: Kernels, width: int, height: int) -> None:
    """Boxes of whole pixels are cv2's box filters, every second pixel of them."""
    plane = noise(14, 11).astype(np.float64)
    found = kernels.box_contrast(plane.astype(np.float32), width, height, 2.0, 0.5)

    def mean(across: int, down: int) -> NDArray[np.float64]:
        anchor = (across // 2, down // 2)
        sums = cv2.boxFilter(
            plane, -1, (across, down), anchor=anchor, normalize=False, borderType=cv2.BORDER_CONSTANT
        )
        first = [count - 2 * (count // 2) for count in (14, 11)]
        return np.asarray(sums[first[0] :: 2, first[1] :: 2][:14, :11])

    inner, whole = mean(width, height), mean(2 * width, 2 * height)
    area = width * height
    assert_allclose(found, inner / area - 0.5 * (whole - inner) / (3 * area), atol=1e-6)


def test_one_map_in_closed_form(kernels: Kernels) -> None:
    """Of a map of ones a box and a frame inside have the means 1; half of a box in the corner is outside
    along each axis.
    """
    ones = np.ones((40, 40), np.float32)
    assert_allclose(kernels.box_contrast(ones, 5.3, 7.1, 1.7, 1.0)[10, 10], 0, atol=1e-6)
    assert_allclose(kernels.box_contrast(ones, 5.3, 7.1, 1.7, 0.25)[10, 10], 0.75, atol=1e-6)
    assert_allclose(kernels.box_contrast(ones, 8.0, 8.0, 1.7, 0.0)[0, 0], 0.25, atol=1e-6)


def test_finds_the_box(kernels: Kernels) -> None:
    """A box of its size is nowhere better than where it is, and there it has all."""
    for rows, columns in ((16, 16), (15, 20)):
        plane = np.zeros((2 * rows, 2 * columns), np.float32)
        y, x = rows + 2 * 3, columns - 2 * 2
        plane[y - 4 : y + 4, x - 3 : x + 3] = 1
        found = kernels.box_contrast(plane, 6, 8, 1.5, 1.0)
        assert np.unravel_index(found.argmax(), found.shape) == (rows // 2 + 3, columns // 2 - 2)
        assert found.max() == pytest.approx(1)


def test_is_linear(kernels: Kernels) -> None:
    """Maps and the frame's weight are multiplied and added up."""
    plane, other = noise(9, 12), noise(9, 12, 1)
    arguments = 5.5, 3.3, 1.8
    parts = [kernels.box_contrast(each, *arguments, 0.7) for each in (plane, other)]
    assert_allclose(
        kernels.box_contrast(2 * plane - other, *arguments, 0.7), 2 * parts[0] - parts[1], atol=1e-6
    )
    inner = kernels.box_contrast(plane, *arguments, 0.0)
    assert_allclose(kernels.box_contrast(plane, *arguments, 1.4), 2 * parts[0] - inner, atol=1e-6)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"plane": np.zeros((5, 4), np.float32)}, r"plane: expected even sides of at least 2, got \(5, 4\)"),
    ({"plane": np.zeros((0, 4), np.float32)}, r"plane: expected even sides of at least 2, got \(0, 4\)"),
    ({"plane": np.full((4, 4), np.nan, np.float32)}, "plane: expected finite numbers, got nan"),
    ({"plane": np.array([[1, np.inf], [np.nan, 1]], np.float32)}, "plane: expected finite numbers, got inf"),
    ({"width": 0.0}, "width: expected a finite number above 0, got 0"),
    ({"height": float("inf")}, "height: expected a finite number above 0, got inf"),
    ({"surround_size": 1.0}, "surround_size: expected a finite number above 1, got 1"),
    ({"surround_weight": float("nan")}, "surround_weight: expected a finite number, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    good = {"plane": noise(4, 4), "width": 3.0, "height": 3.0, "surround_size": 2.0, "surround_weight": 1.0}
    with pytest.raises(ValueError, match=message):
        kernels.box_contrast(**good | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    with pytest.raises(TypeError, match="plane: expected a float32 map"):
        _core.box_contrast(np.zeros((4, 4)), 1, 1, 2, 1)
    with pytest.raises(ValueError, match="plane: expected packed pixels"):
        _core.box_contrast(noise(4, 4)[:, ::2], 1, 1, 2, 1)
