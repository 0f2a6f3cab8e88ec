# SPDX-License-Identifier: MIT
"""Histograms inside ellipses, and in the rings round them."""

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

Bins = NDArray[np.uint16]
Floats = NDArray[np.float64]
SIZE = 24
NO_BIN = 65535


def some_bins(seed: int, shape: tuple[int, int]) -> Bins:
    """Bins below SIZE, and some pixels without one."""
    rng = np.random.default_rng(seed)
    return np.where(rng.random(shape) < 0.1, NO_BIN, rng.integers(0, SIZE, shape)).astype(np.uint16)


def some_ellipses(seed: int, count: int) -> Floats:
    """Ellipses in, over the edge of and beside a picture of 40 x 60, some smaller than a pixel."""
    rng = np.random.default_rng(seed)
    return np.column_stack(
        [rng.uniform(-30, 90, count), rng.uniform(-30, 70, count), rng.uniform(0.1, 30, (count, 2))]
    )


def counts_of(found: Bins) -> NDArray[np.int64]:
    """How often each bin is among ``found``."""
    return np.bincount(found[found != NO_BIN], minlength=SIZE)


@given(st.integers(0, 2**32), st.integers(0, 40), st.integers(0, 60), st.floats(1, 3))
def test_twin_counts_the_same(seed: int, height: int, width: int, margin: float) -> None:
    """Native and reference count the same pixels, wherever the ellipses lie."""
    arguments = (some_bins(seed, (height, width)), some_ellipses(seed, 4), SIZE, margin)
    for native, twin in zip(
        _core.ellipse_histogram(*arguments), reference.ellipse_histogram(*arguments), strict=True
    ):
        assert native.dtype == twin.dtype == np.int32
        assert_array_equal(native, twin)


def test_a_mask_takes_pixels_out(kernels: Kernels) -> None:
    """What a mask leaves out counts as little as a pixel without a bin; another shape is refused."""
    bins, ellipses = some_bins(0, (40, 60)), some_ellipses(0, 10)
    mask = np.random.default_rng(1).integers(0, 3, bins.shape, np.uint8)
    without = np.where(mask != 0, bins, np.uint16(NO_BIN))
    expected = kernels.ellipse_histogram(without, ellipses, SIZE, 1.4)
    for ours, theirs in zip(
        kernels.ellipse_histogram(bins, ellipses, SIZE, 1.4, mask), expected, strict=True
    ):
        assert_array_equal(ours, theirs)
    with pytest.raises(ValueError, match="mask: expected shape"):
        kernels.ellipse_histogram(bins, ellipses, SIZE, 1.4, mask[1:])


@pytest.mark.parametrize("seed", range(20))
def test_agrees_with_the_equation_of_an_ellipse(kernels: Kernels, seed: int) -> None:
    """Inside are the pixels of (x - x0)² / a² + (y - y0)² / b² <= 1, around those up to margin²."""
    bins, ellipses = some_bins(seed, (40, 60)), some_ellipses(seed, 10)
    inside, around = kernels.ellipse_histogram(bins, ellipses, SIZE, 1.4)
    y, x = np.mgrid[:40, :60] + 0.5
    for i, (x0, y0, minor, major) in enumerate(ellipses):
        distance = ((x - x0) / minor) ** 2 + ((y - y0) / major) ** 2
        assert_array_equal(inside[i], counts_of(bins[distance <= 1]))
        assert_array_equal(around[i], counts_of(bins[(distance > 1) & (distance <= 1.4**2)]))


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """OpenCV's ellipse and calcHist count the same but for pixels on the outline, under 2 a pixel of it."""
    bins = some_bins(3, (240, 320)) % np.uint16(SIZE)
    inside, _ = kernels.ellipse_histogram(bins, np.array([[160.5, 120.5, 50, 60]]), SIZE, 1.0)
    mask = cv2.ellipse(np.zeros(bins.shape, np.uint8), (160, 120), (50, 60), 0, 0, 360, 255, -1)
    baseline = cv2.calcHist([bins], [0], mask, [SIZE], [0, SIZE]).ravel()
    assert np.abs(inside[0] - baseline).sum() < 2 * np.pi * 60


def test_area(kernels: Kernels) -> None:
    """A large ellipse has pi a b pixels within its outline's length, its ring pi a b (margin² - 1)."""
    bins = np.zeros((1500, 1500), np.uint16)
    inside, around = kernels.ellipse_histogram(bins, np.array([[750.3, 749.8, 450, 500]]), 1, 1.4)
    assert abs(inside[0, 0] - np.pi * 450 * 500) < 100
    assert abs(around[0, 0] - np.pi * 450 * 500 * 0.96) < 150


def test_example_by_hand(kernels: Kernels) -> None:
    """A pixel's own circle and the four neighbors at a distance of exactly 1, which is inside."""
    bins = np.arange(25, dtype=np.uint16).reshape(5, 5)
    inside, around = kernels.ellipse_histogram(bins, np.array([[2.5, 2.5, 1, 1]]), 25, 1.5)
    assert_array_equal(np.flatnonzero(inside), [7, 11, 12, 13, 17])
    assert_array_equal(np.flatnonzero(around), [6, 8, 16, 18])


@given(st.integers(0, 2**32), st.integers(-20, 20), st.integers(-20, 20))
def test_moved_by_whole_pixels(seed: int, right: int, down: int) -> None:
    """Ellipses moved along with the picture count the same, wherever in a pixel their centers are."""
    bins = some_bins(seed, (40, 60))
    ellipses = np.ceil(some_ellipses(seed, 3) * 64) / 64  # so that no sum is rounded
    moved = ellipses + np.array([100 + right, 100 + down, 0, 0])
    frame = np.full((240, 260), NO_BIN, np.uint16)
    frame[100 + down :, 100 + right :][:40, :60] = bins
    for kernels in (_core, reference):
        for one, other in zip(
            kernels.ellipse_histogram(bins, ellipses, SIZE, 1.3),
            kernels.ellipse_histogram(frame, moved, SIZE, 1.3),
            strict=True,
        ):
            assert_array_equal(one, other)


@given(st.integers(0, 2**32), st.floats(1, 2), st.floats(1, 2))
def test_ellipse_and_ring_make_the_larger_ellipse(seed: int, margin: float, more: float) -> None:
    """Inside and around together are what is inside an ellipse of the margin's size; larger holds smaller."""
    bins, ellipses = some_bins(seed, (40, 60)), some_ellipses(seed, 4)
    inside, around = _core.ellipse_histogram(bins, ellipses, SIZE, margin)
    whole, _ = _core.ellipse_histogram(bins, ellipses * np.array([1, 1, margin, margin]), SIZE, 1.0)
    assert_array_equal(inside + around, whole)
    _, wider = _core.ellipse_histogram(bins, ellipses, SIZE, margin * more)
    assert np.all(wider >= around)


def test_nothing_there(kernels: Kernels) -> None:
    """No ellipse, no picture, an ellipse far away or without a ring: no counts."""
    bins = some_bins(0, (40, 60))
    for ellipses in ([[1e300, 5, 9, 9]], [[-1e9, -1e9, 9, 9]], [[30, 2.0**31, 9, 9]]):
        assert not np.any(kernels.ellipse_histogram(bins, np.array(ellipses), SIZE, 1.4))
    assert not np.any(kernels.ellipse_histogram(bins[:0], some_ellipses(0, 2), SIZE, 1.4))
    assert not np.any(kernels.ellipse_histogram(bins, some_ellipses(0, 9), SIZE, 1.0)[1])
    assert kernels.ellipse_histogram(bins, np.empty((0, 4)), SIZE, 1.4)[0].shape == (0, SIZE)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"ellipses": np.zeros((2, 3))}, r"ellipses: expected shape \(2, 4\), got \(2, 3\)"),
    ({"ellipses": np.full((1, 4), np.nan)}, "ellipses: expected finite numbers, got nan"),
    ({"ellipses": np.array([[1.0, 1, 0, 5]])}, "ellipses: expected semi-axes above 0, got 0"),
    ({"ellipses": np.array([[1.0, 1, 3000, 5]])}, "ellipses: expected semi-axes of at most 4096 pixels with"),
    ({"margin": 0.9}, "margin: expected 1 to 16, got 0.9"),
    ({"margin": np.nan}, "margin: expected 1 to 16, got nan"),
    ({"size": 0}, "size: expected 1 to 65535 bins, got 0"),
    ({"size": 65536}, "size: expected 1 to 65535 bins, got 65536"),
    ({"size": 5}, "bins: expected bins below 5, or 65535 for none, got 23"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    bins = np.arange(SIZE, dtype=np.uint16).reshape(4, 6)
    arguments = {"bins": bins, "ellipses": np.ones((1, 4)), "size": SIZE, "margin": 1.4} | changes
    with pytest.raises(ValueError, match=message):
        kernels.ellipse_histogram(**arguments)


def test_native_refuses_other_types() -> None:
    """Another type or layout is named, not converted."""
    bins = np.zeros((4, 6), np.uint16)
    with pytest.raises(TypeError, match=r"bins: expected uint16 bins \(H, W\), got int64"):
        _core.ellipse_histogram(bins.astype(int), np.ones((1, 4)), 1, 1.4)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="bins: expected a C-contiguous"):
        _core.ellipse_histogram(bins[:, ::2], np.ones((1, 4)), 1, 1.4)
