# SPDX-License-Identifier: MIT
"""Gaps filled in depth."""

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

Depth = NDArray[np.float32]
GAP, SLOPE, RAGGED = 0.1, 0.02, 0.035
HOLES = [np.nan, 0, -0.0, -1, np.inf, -np.inf]

shapes = st.tuples(st.integers(0, 5), st.integers(0, 70))
LEVELS = np.array([1.0, 1.1, 1.125, 1.25, 2.0, 3e38, *HOLES], np.float32).tolist()
levels = st.sampled_from(LEVELS)  # few, so that thresholds are met exactly
steps = st.sampled_from([0.0, 0.1, 0.125, 1e30]) | st.floats(0, 1)


def riddled(depth: Depth, share: float, seed: int = 0) -> Depth:
    """A share of the pixels missing, each by itself."""
    missing = np.random.default_rng(seed).random(depth.shape) < share
    return np.where(missing, np.float32(np.nan), depth)


def by_hand(depth: Depth, gap: float, slope: float) -> NDArray[np.float64]:
    """One pass, pixel by pixel, in float64."""
    filled = depth.astype(np.float64)
    height, width = depth.shape
    for y, x in zip(*np.nonzero(np.isnan(depth)), strict=True):
        around = depth[max(y - 1, 0) : min(y + 2, height), max(x - 1, 0) : min(x + 2, width)]
        known = around[~np.isnan(around)].astype(np.float64)
        surface = known[known <= known.min() + gap + slope * known.min() ** 2] if known.size else known
        if len(surface) >= 2:
            filled[y, x] = surface.mean()
    return filled


@given(
    arrays(np.float32, shapes) | arrays(np.float32, shapes, elements=levels),
    steps,
    steps,
    st.sampled_from([0.0, 0.25, 1.0]),
    st.integers(0, 3),
)
def test_twin_fills_the_same(
    depth: Depth, gap: float, slope: float, max_gap_share: float, passes: int
) -> None:
    """Native and reference agree to the last bit in any depth: both compute in float32, in one order."""
    native = _core.fill_gaps(depth, gap, slope, max_gap_share, passes)
    assert_array_equal(native, reference.fill_gaps(depth, gap, slope, max_gap_share, passes), strict=True)


@pytest.mark.parametrize("passes", [1, 3])
def test_twin_fills_the_same_in_pictures(picture: Depth, passes: int) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    native = _core.fill_gaps(picture, GAP, SLOPE, RAGGED, passes)
    assert_array_equal(native, reference.fill_gaps(picture, GAP, SLOPE, RAGGED, passes), strict=True)


def test_agrees_with_every_gap(kernels: Kernels) -> None:
    """A loop over the gaps, in float64, fills the same ones with the same depths but for eight roundings."""
    depth = riddled(np.random.default_rng(3).uniform(1, 2, (23, 31)).astype(np.float32), 0.6)
    expected = by_hand(depth, GAP, SLOPE)
    assert 50 < np.isnan(expected).sum() < np.isnan(depth).sum() - 50
    rounding = 8 * 2 * float(np.finfo(np.float32).eps)
    assert_allclose(kernels.fill_gaps(depth, GAP, SLOPE, 0.0, 1), expected, rtol=0, atol=rounding)


def test_agrees_with_opencv(kernels: Kernels, room: Depth) -> None:
    """Where every difference is on one surface, the mean is OpenCV's box filter over what was measured."""
    depth = riddled(room, 0.3)
    known = np.isfinite(depth).astype(np.float32)
    box: dict[str, Any] = {"ksize": (3, 3), "normalize": False, "borderType": cv2.BORDER_CONSTANT}
    count = cv2.boxFilter(known, -1, **box)
    mean = cv2.boxFilter(np.where(known > 0, depth, np.float32(0)), -1, **box) / np.maximum(count, 1)
    expected = np.where(known > 0, depth, np.where(count >= 2, mean, np.float32(np.nan)))
    assert_allclose(kernels.fill_gaps(depth, 100.0, 0.0, 0.0, 1), expected, rtol=1e-5)


def test_room_is_mended(kernels: Kernels, room: Depth, surfaces: NDArray[np.float64]) -> None:
    """With a third of the pixels gone nearly all come back: within the surface's own change over a pixel
    inside the person and the wall, and nothing appears in front of them.
    """
    mended = kernels.fill_gaps(riddled(room, 0.33), GAP, SLOPE, RAGGED, 3)
    assert np.isnan(mended).mean() < 0.01
    nearest = surfaces.argmin(axis=0)
    for surface, change in ((1, 0.03), (2, 0.02)):
        inside = cv2.erode((nearest == surface).astype(np.uint8), np.ones((7, 7), np.uint8)) == 1
        inside &= np.isfinite(mended)
        assert inside.sum() > 1000
        assert np.abs(mended - room)[inside].max() < change
    assert np.nanmin(mended) >= room.min()


def test_few_gaps_and_large_ones_stay(kernels: Kernels, room: Depth) -> None:
    """An image with a few gaps, or large ones, is left as it is: a shadow beside the person, no far wall."""
    few, shadow = riddled(room, 0.02), room.copy()
    shadow[:, 60:75] = np.nan
    shadow[room > 4.5] = np.nan
    for depth in (few, shadow):
        assert np.isnan(depth).any()
        assert_array_equal(kernels.fill_gaps(depth, GAP, SLOPE, RAGGED, 3), depth)


def test_ragged_is_a_share_of_the_measured(kernels: Kernels) -> None:
    """Two small gaps on eight measured pixels are more than 0.24, not more than 0.25."""
    depth = np.float32([[1, 1, 0, 1, 1], [1, 0, 1, 1, 1]])
    assert np.isnan(kernels.fill_gaps(depth, GAP, SLOPE, 0.25, 1)).sum() == 2
    assert_array_equal(kernels.fill_gaps(depth, GAP, SLOPE, 0.24, 1), np.ones((2, 5), np.float32))


@pytest.mark.parametrize(("length", "small"), [(1, True), (3, True), (4, False), (0, False)])
def test_small_gaps_are_up_to_three_pixels_between_others(kernels: Kernels, length: int, small: bool) -> None:
    """Only gaps of one to three pixels count: not of four, nor what a row begins or ends with."""
    depth = np.full((2, 12), np.nan, np.float32)
    depth[:, 2:4] = depth[:, 4 + length : 6 + length] = 2
    changed = np.isfinite(kernels.fill_gaps(depth, GAP, SLOPE, 0.0, 1)) & np.isnan(depth)
    assert changed.any() == small


@pytest.mark.parametrize(("max_gap_share", "left"), [(0.06, 3), (0.04, 0)])
def test_goes_on_until_half_as_many(kernels: Kernels, max_gap_share: float, left: int) -> None:
    """After one pass a gap is left in the middle of the widest, on 39 pixels of a row, 0.026: that is less
    than half of 0.06, and more than half of 0.04, though less than 0.04 itself.
    """
    depth = np.full((3, 40), 2, np.float32)
    depth[:, 4:28:6] = depth[:, 33:36] = np.nan
    assert np.isnan(kernels.fill_gaps(depth, GAP, SLOPE, max_gap_share, 2)).sum() == left


def test_nearer_surface_wins(kernels: Kernels) -> None:
    """Between a person and a wall a gap is the person's; a lone nearer pixel is no surface."""
    depth = np.float32([[2, np.nan, 4], [2, np.nan, 4], [2, np.nan, 4]])
    assert_array_equal(kernels.fill_gaps(depth, GAP, SLOPE, 0.0, 1)[:, 1], np.float32([2, 2, 2]))
    lone = np.float32([[4, 4, 4], [2, np.nan, 4], [4, 4, 4]])
    assert np.isnan(kernels.fill_gaps(lone, GAP, SLOPE, 0.0, 1)[1, 1])


def test_each_pass_reaches_a_pixel_farther(kernels: Kernels) -> None:
    """Into a hole five pixels wide the first pass fills its rim, the third all of it."""
    depth = np.full((9, 30), np.nan, np.float32)
    depth[:, :9] = 3
    depth[2:7, 2:7] = np.nan
    depth[4, [25, 27]] = 1, 5  # two surfaces of one pixel: this gap stays, and there are many
    filled = (kernels.fill_gaps(depth, GAP, SLOPE, 0.0, passes)[:, :9] for passes in range(5))
    left = [int(np.isnan(each).sum()) for each in filled]
    assert left == [25, 9, 1, 0, 0]


@given(arrays(np.float32, shapes, elements=levels), st.integers(0, 3))
def test_what_was_measured_stays(depth: Depth, passes: int) -> None:
    """Measured pixels keep their depth, and all others are a depth or NaN."""
    filled = _core.fill_gaps(depth, GAP, SLOPE, 0.0, passes)
    measured = (depth > 0) & np.isfinite(depth)
    assert_array_equal(filled[measured], depth[measured])
    rest = filled[~measured]
    assert ((rest > 0) & np.isfinite(rest) | np.isnan(rest)).all()


@pytest.mark.parametrize("hole", HOLES)
def test_all_holes_are_gaps(kernels: Kernels, hole: float) -> None:
    """Whatever stands for no measurement is filled."""
    depth = np.full((6, 70), 2, np.float32)
    depth[::2, 1::3] = hole
    assert_array_equal(kernels.fill_gaps(depth, 0.0, 0.0, RAGGED, 1), np.full((6, 70), 2, np.float32))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((-0.1, 0.0, 0.0, 1), "gap: expected a finite number, not negative, got -0.1"),
        ((np.nan, 0.0, 0.0, 1), "gap: expected a finite number, not negative, got nan"),
        ((0.0, np.inf, 0.0, 1), "slope: expected a finite number, not negative, got inf"),
        ((0.0, 0.0, -0.5, 1), "max_gap_share: expected a share from 0 to 1, got -0.5"),
        ((0.0, 0.0, 1.5, 1), "max_gap_share: expected a share from 0 to 1, got 1.5"),
        ((0.0, 0.0, np.nan, 1), "max_gap_share: expected a share from 0 to 1, got nan"),
        ((0.0, 0.0, 0.0, -1), "passes: expected 0 to 1000, got -1"),
    ],
)
def test_refuses_other_numbers(
    kernels: Kernels, values: tuple[float, float, float, int], message: str
) -> None:
    """A number out of its range is named."""
    with pytest.raises(ValueError, match=message):
        kernels.fill_gaps(np.ones((2, 2), np.float32), *values)


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.fill_gaps(np.ones((2, 2)), GAP, SLOPE, RAGGED, 1)  # type: ignore[arg-type]
