# SPDX-License-Identifier: MIT
"""The mean gradient along the outline of an ellipse."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Gray = NDArray[np.uint8]
Floats = NDArray[np.float64]


def outline(n: int) -> Floats:
    """Places (n, 2) on the unit circle."""
    angles = (np.arange(n) + 0.5) * 2 * np.pi / n
    return np.column_stack([np.cos(angles), np.sin(angles)])


def case(seed: int, **changes: Any) -> dict[str, Any]:
    """Arguments: an ellipse in, over the edge of or beside a picture of noise."""
    rng = np.random.default_rng(seed)
    place = np.append(rng.uniform(-15, 60, 2), rng.uniform(0.2, 20, 2))
    return {
        "gray": rng.integers(0, 256, (rng.integers(1, 40), rng.integers(1, 60)), np.uint8),
        "ellipse": np.ceil(place * 64) / 64,
        "grid": (int(rng.integers(1, 6)), int(rng.integers(1, 20)), int(rng.integers(1, 4))),
        "pattern": outline(int(rng.integers(1, 80))),
    } | changes


def tolerance(arguments: dict[str, Any]) -> float:
    """Sums of n numbers up to 255 in float32, each addition rounded, over n."""
    return float((len(arguments["pattern"]) + 4) * 255 * np.finfo(np.float32).eps)


@given(st.integers(0, 2**32))
@example(33751)  # whose outline meets the border of two pixels
def test_twin_measures_the_same(seed: int) -> None:
    """Native and reference agree within the rounding of sums in float32."""
    arguments = case(seed)
    native, twin = _core.ellipse_gradient(**arguments), reference.ellipse_gradient(**arguments)
    assert native.dtype == np.float64
    assert native.shape == twin.shape == arguments["grid"][:2]
    assert_allclose(native, twin, rtol=0, atol=tolerance(arguments))


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """OpenCV's Sobel of size 1, read at the same pixels, gives the same."""
    gray = np.random.default_rng(0).integers(0, 256, (50, 60), np.uint8)
    x, y, minor, major = ellipse = np.array([30.2, 25.7, 14, 17])
    pattern = outline(64)
    normals = pattern / ellipse[2:]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    pixels = (y + major * pattern[:, 1]).astype(int), (x + minor * pattern[:, 0]).astype(int)
    right, down = (cv2.Sobel(gray, cv2.CV_64F, *order, ksize=1) / 2 for order in ((1, 0), (0, 1)))
    expected = np.abs(normals[:, 0] * right[pixels] + normals[:, 1] * down[pixels]).mean()
    found = kernels.ellipse_gradient(gray, ellipse, (1, 1, 1), pattern)
    assert_allclose(found, [[expected]], rtol=0, atol=68 * 255 * np.finfo(np.float32).eps)


@pytest.mark.parametrize(("minor", "major"), [(20.0, 20.0), (12.0, 25.0)])
def test_ramp(kernels: Kernels, minor: float, major: float) -> None:
    """On a ramp of s levels a pixel it's s times the mean |x| of the unit normals, on a circle 2 / pi."""
    gray = np.tile(np.arange(80, dtype=np.uint8) * 3, (70, 1))
    pattern = outline(720)
    found = kernels.ellipse_gradient(gray, np.array([40.0, 35, minor, major]), (3, 5, 1), pattern)
    normals = pattern / [minor, major]
    across = np.mean(np.abs(normals[:, 0]) / np.linalg.norm(normals, axis=1))
    assert_allclose(found, np.full((3, 5), 3 * across), rtol=1e-4)
    if minor == major:
        assert_allclose(found, 3 * 2 / np.pi, rtol=1e-4)


def test_finds_a_disk(kernels: Kernels) -> None:
    """The outline of a blurred disk has its greatest mean gradient where the disk is."""
    y, x = np.mgrid[:70, :90] + 0.5
    distance = np.hypot((x - 47.5) / 14, (y - 33.5) / 17)
    gray = (200 / (1 + np.exp(20 * (distance - 1)))).astype(np.uint8)
    found = kernels.ellipse_gradient(gray, np.array([43.5, 34.5, 14, 17]), (7, 15, 1), outline(96))
    assert np.unravel_index(np.argmax(found), found.shape) == (2, 11)


@given(st.integers(0, 2**32))
@example(33751)  # whose outline meets the border of two pixels
def test_each_place_is_found_alone(seed: int) -> None:
    """A grid of one place, put at a place of a larger one, gives the same to the last bit."""
    arguments = case(seed)
    rows, cols, step = arguments["grid"]
    found = _core.ellipse_gradient(**arguments)
    for i, j in np.ndindex(rows, cols):
        place = arguments["ellipse"] + np.array([(j - cols // 2) * step, (i - rows // 2) * step, 0, 0])
        alone = _core.ellipse_gradient(**arguments | {"ellipse": place, "grid": (1, 1, 1)})
        assert_array_equal(alone, [[found[i, j]]])


@given(st.integers(0, 2**32))
def test_negative_is_alike(seed: int) -> None:
    """Dark on light is as good as light on dark, and added light changes nothing."""
    arguments = case(seed)
    half = arguments["gray"] // np.uint8(2)
    found = _core.ellipse_gradient(**arguments | {"gray": half})
    assert_array_equal(_core.ellipse_gradient(**arguments | {"gray": 255 - half}), found)
    assert_array_equal(_core.ellipse_gradient(**arguments | {"gray": half + np.uint8(128)}), found)


def test_outside_is_left_out(kernels: Kernels) -> None:
    """On a ramp an outline half outside has the mean of what is inside; wholly outside it is 0."""
    gray = np.tile(np.arange(40, dtype=np.uint8) * 2, (60, 1))
    pattern = np.array([[1.0, 0], [-1, 0], [0, 1], [0, -1]])
    ellipse = np.array([2.5, 30.5, 10, 12])  # its left is outside, its right, top and bottom inside
    assert_allclose(kernels.ellipse_gradient(gray, ellipse, (1, 1, 1), pattern), [[2 / 3]], rtol=1e-6)
    for x in (-20.0, 60.0, 1e300, -1e300):
        away = np.array([x, 30, 10, 12])
        assert_array_equal(kernels.ellipse_gradient(gray, away, (2, 3, 1), pattern), np.zeros((2, 3)))
    assert_array_equal(kernels.ellipse_gradient(gray[:0], ellipse, (2, 3, 1), pattern), np.zeros((2, 3)))


BAD: list[tuple[dict[str, Any], str]] = [
    ({"ellipse": np.zeros(3)}, r"ellipse: expected shape \(4,\), got \(3,\)"),
    ({"ellipse": np.full(4, np.nan)}, "ellipse: expected finite numbers, got nan"),
    ({"ellipse": np.array([1.0, 1, 0, 5])}, "ellipse: expected semi-axes above 0, got 0"),
    ({"grid": (4, 0, 1)}, r"grid: expected rows, cols and a step of 1 to 1024, .* got \(4, 0, 1\)"),
    ({"pattern": np.zeros((0, 2))}, "pattern: expected at least one place, got none"),
    ({"pattern": np.zeros((3, 3))}, r"pattern: expected shape \(3, 2\), got \(3, 3\)"),
    ({"pattern": np.array([[np.nan, 1.0]])}, "pattern: expected finite numbers, got nan"),
    ({"pattern": np.array([[0.5, 0.0]])}, "pattern: expected places on the unit circle, got 0.5"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.ellipse_gradient(**case(0, **changes))


def test_native_refuses_other_types() -> None:
    """Another type or layout is named, not converted."""
    with pytest.raises(TypeError, match=r"gray: expected a uint8 gray image \(H, W\), got float64"):
        _core.ellipse_gradient(**case(0, gray=np.zeros((3, 3))))
    with pytest.raises(ValueError, match="gray: expected a C-contiguous"):
        _core.ellipse_gradient(**case(0, gray=np.zeros((3, 6), np.uint8)[:, ::2]))
