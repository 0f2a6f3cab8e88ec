# SPDX-License-Identifier: MIT
"""Orientations and colors of a patch in cells of 2x2."""

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Planes = NDArray[np.float32]


def ones(rows: int, columns: int) -> Planes:
    """A taper that changes nothing."""
    return np.ones((rows, columns), np.float32)


def texture(rows: int, columns: int, seed: int = 0) -> Image:
    """Clouds of all colors, (2 rows, 2 columns)."""
    noise = np.random.default_rng(seed).normal(128, 200, (2 * rows, 2 * columns, 3))
    return np.asarray(cv2.GaussianBlur(noise, (0, 0), 1.5).clip(0, 255), np.uint8)


def as_angles(patch: Image) -> Planes:
    """(8, R, C) of a gray patch by OpenCV's angles: the ratio of the sides is their tangent."""
    gray = patch[..., 0]
    gx, gy = (
        cv2.Sobel(gray, cv2.CV_32F, *order, ksize=1, borderType=cv2.BORDER_REPLICATE)
        for order in ((1, 0), (0, 1))
    )
    angle = np.arctan2(gy.astype(float), gx)
    octant = np.floor(angle / (np.pi / 4))
    within = angle - octant * np.pi / 4
    odd = octant % 2 == 1
    diagonal = np.tan(np.where(odd, np.pi / 4 - within, within))
    size = np.hypot(gx, gy)
    bins = np.zeros((8, *gray.shape))
    rows, columns = np.mgrid[: gray.shape[0], : gray.shape[1]]
    first, second = octant.astype(int) % 8, (octant.astype(int) + 1) % 8
    np.add.at(bins, (first, rows, columns), size * np.where(odd, diagonal, 1 - diagonal))
    np.add.at(bins, (second, rows, columns), size * np.where(odd, 1 - diagonal, diagonal))
    cells = np.array(
        [4 * cv2.resize(plane, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA) for plane in bins]
    )
    energy = cv2.boxFilter(
        (cells**2).sum(axis=0), -1, (3, 3), normalize=False, borderType=cv2.BORDER_REPLICATE
    )
    return np.asarray(np.minimum(cells / np.sqrt(energy + 32**2), 0.4), np.float32)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (5, 1), (2, 3), (16, 9), (32, 32), (17, 35)])
@pytest.mark.parametrize("smooth", [False, True], ids=["noise", "clouds"])
def test_native_is_the_twin(shape: tuple[int, int], smooth: bool) -> None:
    """Both give the same bits for noise and clouds of any size and memory layout: all steps are single
    float32 operations in one order.
    """
    rng = np.random.default_rng(shape[1])
    rows, columns = shape
    wide = rng.integers(0, 256, (2 * rows, 2 * columns + 3, 3), np.uint8)
    if smooth:
        wide[:, 1:-2] = texture(rows, columns)
    taper = rng.random(shape).astype(np.float32)
    native = _core.gradient_color_cells(wide[:, 1:-2], taper)
    assert native.dtype == np.float32
    assert native.shape == (11, *shape)
    assert_array_equal(native, reference.gradient_color_cells(wide[:, 1:-2], taper))


def test_orientations_are_opencvs(kernels: Kernels) -> None:
    """A gray patch's orientations are those by OpenCV's gradients, box sums and an arctangent in float64, to
    float32's rounding of a dozen steps.
    """
    gray = np.repeat(texture(24, 20)[..., :1], 3, 2)
    found = kernels.gradient_color_cells(gray, ones(24, 20))[:8]
    assert_allclose(found, as_angles(gray), atol=1e-6)
    assert (found > 0.1).any(axis=(1, 2)).all()


def test_colors_are_opencvs(kernels: Kernels) -> None:
    """The colors are OpenCV's area means, minus their own."""
    patch = texture(12, 15)
    means = cv2.resize(patch.astype(np.float32) / 255, (15, 12), interpolation=cv2.INTER_AREA)
    expected = (means - means.mean(axis=(0, 1), dtype=np.float64)).transpose(2, 0, 1)
    assert_allclose(kernels.gradient_color_cells(patch, ones(12, 15))[8:], expected, atol=1e-6)


@pytest.mark.parametrize("k", range(8))
def test_ramps_in_closed_form(kernels: Kernels, k: int) -> None:
    """A ramp towards 45 k degrees, 4 levels a pixel along each axis it has, is in bin k alone: four gradients
    g of a cell over the root of the squares of nine cells and 32².
    """
    y, x = np.mgrid[:16, :16]
    across, down = np.rint(np.cos(k * np.pi / 4)), np.rint(np.sin(k * np.pi / 4))
    ramp = np.repeat((128 + 4 * (across * (x - 8) + down * (y - 8))).astype(np.uint8)[..., None], 3, 2)
    inner = kernels.gradient_color_cells(ramp, ones(8, 8))[:8, 2:-2, 2:-2]
    sums = 4 * 8 * np.hypot(across, down)
    assert_allclose(inner[k], sums / np.sqrt(9 * sums**2 + 32**2), rtol=1e-6)
    assert_allclose(np.delete(inner, k, axis=0), 0, atol=1e-6)


def test_takes_the_channel_of_the_longest_gradient(kernels: Kernels) -> None:
    """Weaker channels don't count, and of equal ones the first does."""
    strong = texture(9, 9)[..., 0]
    for channel in range(3):
        patch = np.repeat((strong // 4)[..., None], 3, 2)
        patch[..., channel] = strong // 4 * 4
        gray = np.repeat(patch[..., channel : channel + 1], 3, 2)
        assert_array_equal(
            kernels.gradient_color_cells(patch, ones(9, 9))[:8],
            kernels.gradient_color_cells(gray, ones(9, 9))[:8],
        )
    y, x = np.mgrid[:18, :18].astype(np.uint8)
    tie = np.stack([6 * y, 6 * x, 6 * (17 - x)], axis=2)
    assert_allclose(
        kernels.gradient_color_cells(tie, ones(9, 9))[2, 2:-2, 2:-2],
        48 / np.sqrt(9 * 48**2 + 32**2),
        rtol=1e-6,
    )


def test_turns_with_the_patch(kernels: Kernels) -> None:
    """A quarter turn moves cells as the patch, and orientations by two bins."""
    patch = np.repeat(texture(14, 14)[..., :1], 3, 2)
    before = kernels.gradient_color_cells(patch, ones(14, 14))
    after = kernels.gradient_color_cells(np.ascontiguousarray(np.rot90(patch, -1)), ones(14, 14))
    assert_allclose(after[:8], np.roll(np.rot90(before[:8], -1, (1, 2)), 2, axis=0), atol=1e-6)
    assert_allclose(after[8:], np.rot90(before[8:], -1, (1, 2)), atol=1e-6)


def test_brighter_light_changes_nothing(kernels: Kernels) -> None:
    """What adds 40 levels leaves the orientations, and the colors but for rounding."""
    patch = texture(10, 13) // 2
    plain, lit = (kernels.gradient_color_cells(patch + np.uint8(add), ones(10, 13)) for add in (0, 40))
    assert_array_equal(lit[:8], plain[:8])
    assert_allclose(lit[8:], plain[8:], atol=3e-7)


def test_is_bounded_and_tapered(kernels: Kernels) -> None:
    """Orientations are from 0 to 0.4, no color has a mean, noise of one level stays small, and the taper
    multiplies everything.
    """
    patch = texture(16, 16)
    plain = kernels.gradient_color_cells(patch, ones(16, 16))
    assert plain[:8].min() >= 0
    assert plain[:8].max() <= np.float32(0.4)
    assert_allclose(plain[8:].mean(axis=(1, 2)), 0, atol=1e-6)
    faint = 100 + (patch > 128).astype(np.uint8)
    assert kernels.gradient_color_cells(faint, ones(16, 16))[:8].max() < 0.2
    taper = np.random.default_rng(0).random((16, 16)).astype(np.float32)
    assert_array_equal(kernels.gradient_color_cells(patch, taper), plain * taper)


def test_refuses(kernels: Kernels) -> None:
    """A patch that isn't twice the taper's size, and a taper without cells, are named."""
    patch = np.zeros((8, 6, 3), np.uint8)
    message = r"patch: expected shape \(8, 8, 3\), twice the taper's, got \(8, 6, 3\)"
    with pytest.raises(ValueError, match=message):
        kernels.gradient_color_cells(patch, ones(4, 4))
    with pytest.raises(ValueError, match="taper: expected at least one cell, got none"):
        kernels.gradient_color_cells(patch, ones(0, 3))


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    with pytest.raises(TypeError, match=r"taper: expected float32 \(R, C\)"):
        _core.gradient_color_cells(np.zeros((8, 8, 3), np.uint8), np.ones((4, 4)))
    with pytest.raises(ValueError, match="taper: expected a C-contiguous"):
        _core.gradient_color_cells(np.zeros((8, 8, 3), np.uint8), ones(4, 8)[:, ::2])
    with pytest.raises(ValueError, match="patch: expected a uint8 BGR image"):
        _core.gradient_color_cells(np.zeros((8, 8), np.uint8), ones(4, 4))
