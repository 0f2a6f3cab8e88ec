# SPDX-License-Identifier: MIT
"""The disparity of an ellipse."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.reference.base.ellipse_shape import mask_of

Image = NDArray[np.uint8]


def case(seed: int) -> dict[str, Any]:
    """Arguments: pairs of noise, shifted or unlike, color and gray, with ellipses over their edges."""
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(1, 50)), int(rng.integers(1, 90))
    left, right = rng.integers(0, 256, (2, *shape, 3)).astype(np.uint8)
    if rng.random() < 0.7:
        right = np.roll(left, -int(rng.integers(0, 6)), 1)
    if rng.random() < 0.3:
        left, right = left // 32, right // 32
    if rng.random() < 0.3:
        right = np.ascontiguousarray(right[..., 1])
    if rng.random() < 0.3:
        left = np.ascontiguousarray(left[..., 1])
    first = int(rng.integers(-6, 7))
    return {
        "left": left,
        "right": right,
        "ellipse": rng.uniform((-12, -12, 0.2, 0.2), (100, 60, 30, 25)).round(int(rng.integers(0, 3))) + 1e-3,
        "limits": (first, first + int(rng.integers(0, 40))),
        "matching": (int(rng.choice([1, 3, 5, 11])), int(rng.choice([0, 5, 15])), bool(rng.integers(0, 2))),
        "statistic": (bool(rng.integers(0, 2)), bool(rng.integers(0, 2)), float(rng.choice([0, 0.6, 2]))),
    }


@given(st.integers(0, 2**32))
def test_twin_gives_the_same(seed: int) -> None:
    """Native and reference agree to the last bit. The sum of the mean is one of float32 numbers with few
    digits in float64, which rounds nothing.
    """
    arguments = case(seed)
    native, twin = _core.ellipse_disparity(**arguments), reference.ellipse_disparity(**arguments)
    np.testing.assert_equal(native, twin)


@given(st.integers(0, 2**32))
def test_agrees_with_numpy_on_the_whole_images(seed: int) -> None:
    """Median, mean and counts are NumPy's of the disparities by the whole gray images: the mean to the
    rounding of NumPy's sum of up to 3000 float32 numbers in pairs.
    """
    arguments = case(seed)
    gray = [_core.reduce_gray(arguments[name], 1) for name in ("left", "right")]
    height, width = gray[0].shape
    search = arguments["limits"], arguments["matching"]
    found = _core.sad_disparity(*gray, (0, 0, width, height), False, *search)
    x, y, minor, major = arguments["ellipse"]
    row, column = np.mgrid[:height, :width] + 0.5
    matched = found[(((column - x) / minor) ** 2 + ((row - y) / major) ** 2 <= 1) & np.isfinite(found)]
    subpixel, median, tolerance = arguments["statistic"]
    if not subpixel:
        matched = np.ceil(matched - np.float32(0.5))
    disparity, count, near = _core.ellipse_disparity(**arguments)
    assert count == matched.size
    if count == 0:
        assert math.isnan(disparity)
        assert near == 0
        return
    if median:
        assert disparity == np.median(matched)
    else:
        assert disparity == pytest.approx(matched.mean(), rel=1e-5, abs=1e-5)
    off = np.abs(matched - np.float32(disparity))
    assert near == np.count_nonzero(off <= np.float32(tolerance))


@pytest.mark.parametrize("median", [True, False])
@pytest.mark.parametrize("disparity", [0, 7, 40, -3])
def test_a_shifted_picture_has_that_disparity(kernels: Kernels, disparity: int, median: bool) -> None:
    """What lies at one disparity has it, and all pixels of the ellipse are near it."""
    left = np.random.default_rng(2).integers(0, 256, (60, 160, 3)).astype(np.uint8)
    found = kernels.ellipse_disparity(
        left,
        np.roll(left, -disparity, 1),
        np.array([80.0, 32, 10, 12]),
        (disparity - 5, disparity + 6),
        (5, 5, True),
        (False, median, 0.0),
    )
    assert found[0] == disparity
    assert found[1] == found[2]
    assert found[1] == pytest.approx(np.pi * 10 * 12, rel=0.03)


def test_the_median_leaves_out_what_is_behind(kernels: Kernels) -> None:
    """A third of the ellipse at another disparity pulls the mean, and leaves the median as it is."""
    left = np.random.default_rng(3).integers(0, 256, (60, 160, 3)).astype(np.uint8)
    right = np.roll(left, -10, 1)
    right[:27] = np.roll(left, -4, 1)[:27]
    arguments = (left, right, np.array([75.0, 32, 15, 12]), (0, 14), (5, 5, True))
    median, _, near = kernels.ellipse_disparity(*arguments, (False, True, 0.5))
    mean, count, _ = kernels.ellipse_disparity(*arguments, (False, False, 0.5))
    assert median == 10
    assert 7 < mean < 9.5
    assert 0.6 < near / count < 0.8


@given(st.integers(0, 2**32))
def test_the_pixels_are_those_of_the_color_search(seed: int) -> None:
    """The ellipse has the pixels whose colors ellipse_search counts: wherever it lies, one disparity for the
    whole image matches as many.
    """
    rng = np.random.default_rng(seed)
    ellipse = rng.uniform((0, 0, 0.2, 0.2), (60, 40, 9, 9))
    image = np.zeros((40, 60), np.uint8)
    rest = (0, 0), (1, 0, False), (True, False, 0.0)
    _, count, near = _core.ellipse_disparity(image, image, ellipse, *rest)
    assert count == near == mask_of(ellipse, image.shape).sum()


@pytest.mark.parametrize("place", [(-300.0, 20.0), (20.0, 1e300), (-(2.0**31), 2.0**31)])
def test_an_ellipse_outside_or_between_pixels_has_none(kernels: Kernels, place: tuple[float, float]) -> None:
    """Far from the image, or so small that it contains no pixel's center, it has no disparity."""
    image = np.zeros((40, 60, 3), np.uint8)
    rest = (0, 4), (5, 0, False), (True, False, 0.0)
    for ellipse in (np.array([*place, 5, 6]), np.array([20.0, 20.0, 0.4, 0.4])):
        disparity, count, near = kernels.ellipse_disparity(image, image, ellipse, *rest)
        assert math.isnan(disparity)
        assert (count, near) == (0, 0)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"statistic": (True, True, -1.0)}, "tolerance: expected 0 or more"),
    ({"statistic": (True, True, np.nan)}, "tolerance: expected 0 or more"),
    ({"right": np.zeros((12, 15, 3), np.uint8)}, "right: expected the left image's shape"),
    ({"ellipse": np.array([2.0, 2, 0, 4])}, "ellipse: expected semi-axes above 0"),
    ({"ellipse": np.array([2.0, 2, 3, 4097])}, "ellipse: expected semi-axes of at most 4096 pixels, got"),
    ({"ellipse": np.array([2.0, np.nan, 3, 4])}, "ellipse: expected finite numbers"),
    ({"ellipse": np.ones(3)}, r"ellipse: expected shape \(4,\)"),
    ({"limits": (0, -1)}, "last: expected at least first"),
    ({"matching": (4, 5, True)}, "window: expected an odd number"),
    ({"matching": (5, 101, True)}, "uniqueness: expected 0 to 100"),
]


@pytest.mark.parametrize(("changes", "text"), BAD)
def test_bad_values_are_refused(kernels: Kernels, changes: dict[str, Any], text: str) -> None:
    """Errors name the argument, what was expected and what came."""
    image = np.zeros((12, 16, 3), np.uint8)
    ellipse = np.array([3.0, 3, 2, 2.5])
    arguments = case(0) | {"left": image, "right": image, "ellipse": ellipse, "limits": (0, 4)}
    with pytest.raises(ValueError, match=text):
        kernels.ellipse_disparity(**arguments | changes)
