# SPDX-License-Identifier: MIT
"""Oriented gradients, texture and colors of a patch in cells of 2x2."""

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


def by_opencv(patch: Image) -> NDArray[np.float64]:
    """(16, R, C) of a gray patch by OpenCV's filters and angles, whose tangents are the sides' ratios."""
    gray = patch[..., 0]
    gx, gy = (
        cv2.Sobel(gray, cv2.CV_64F, *order, ksize=1, borderType=cv2.BORDER_REPLICATE)
        for order in ((1, 0), (0, 1))
    )
    angle = np.arctan2(gy, gx)
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
    hat = np.array([1, 3, 3, 1]) / 4
    signed = np.array(
        [
            cv2.sepFilter2D(each, -1, hat, hat, anchor=(1, 1), borderType=cv2.BORDER_CONSTANT)[::2, ::2]
            for each in bins
        ]
    )
    unsigned = signed[:4] + signed[4:]
    energy = cv2.copyMakeBorder((unsigned**2).sum(axis=0), 1, 1, 1, 1, cv2.BORDER_REPLICATE)
    contrast = np.sqrt(cv2.boxFilter(energy, -1, (2, 2), normalize=False)[1:, 1:] + 102**2)
    blocks = contrast[:-1, :-1], contrast[:-1, 1:], contrast[1:, :-1], contrast[1:, 1:]
    shares = np.array([np.minimum(np.concatenate([signed, unsigned]) / each, 0.2) for each in blocks])
    return np.concatenate([shares.sum(axis=0) / 2, 0.2357 * shares[:, :8].sum(axis=1)])


def stepped(at: int, height: int) -> Image:
    """(24, 24) levels that rise by `height` in column `at`."""
    patch = np.full((24, 24, 3), 5, np.uint8)
    patch[:, at:] += np.uint8(height)
    return patch


def cut(*shares: float) -> float:
    """The sum of shares of a contrast, each up to 0.2."""
    return sum(min(each, 0.2) for each in shares)


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
    native = _core.hog_color_cells(wide[:, 1:-2], taper)
    assert native.dtype == np.float32
    assert native.shape == (19, *shape)
    assert_array_equal(native, reference.hog_color_cells(wide[:, 1:-2], taper))


def test_orientations_are_opencvs(kernels: Kernels) -> None:
    """A gray patch's orientations and texture are those by OpenCV's filters and an arctangent in float64.

    With u = 2^-24, a pixel's shares are off by up to 3 u |g|, all bins together by 5 u |g|, and six roundings
    of the blend add 6 u s_k. A cell's bins add up to at most 2 √E, so s n is off by 18 u, and n, by E and
    seven roundings of its own, by relative 30 u. Where s n isn't cut, at 0.2, that is 25 u; half of four such
    with their sum's roundings are 52 u, and 0.2357 times the eight of texture 20 u: under 64 u.
    """
    gray = np.repeat(texture(24, 20)[..., :1], 3, 2)
    found = kernels.hog_color_cells(gray, ones(24, 20))[:16]
    assert_allclose(found, by_opencv(gray), rtol=0, atol=64 * 2**-24)
    assert (found > 0.1).any(axis=(1, 2)).all()


def test_colors_are_opencvs(kernels: Kernels) -> None:
    """The colors are OpenCV's area means, minus their own."""
    patch = texture(12, 15)
    means = cv2.resize(patch.astype(np.float32) / 255, (15, 12), interpolation=cv2.INTER_AREA)
    expected = (means - means.mean(axis=(0, 1), dtype=np.float64)).transpose(2, 0, 1)
    assert_allclose(kernels.hog_color_cells(patch, ones(12, 15))[16:], expected, atol=1e-6)


@pytest.mark.parametrize("height", [1, 8, 20, 60, 250])
def test_a_step_between_cells_in_closed_form(kernels: Kernels, height: int) -> None:
    """A step of h between two columns of cells has a gradient h in the pixels on either side of it, 3/4 + 1/4
    of them in each of the two, twice for the rows: 2 h towards 0 degrees. Of a cell's blocks two have both
    columns in them, and two only one.
    """
    found = kernels.hog_color_cells(stepped(12, height), ones(12, 12))[:16, 2:-2]
    both, one = (2 * height / np.sqrt(count * 4 * height**2 + 102**2) for count in (4, 2))
    expected = np.zeros((16, 8, 12))
    expected[[0, 8], :, 5:7] = cut(one, one, both, both) / 2
    # Upper left, upper right, lower left, lower right.
    expected[12:, :, 5] = 0.2357 * np.array([cut(one), cut(both), cut(one), cut(both)])[:, None]
    expected[12:, :, 6] = 0.2357 * np.array([cut(both), cut(one), cut(both), cut(one)])[:, None]
    assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.parametrize("height", [1, 8, 20, 60, 250])
def test_a_step_in_a_cell_in_closed_form(kernels: Kernels, height: int) -> None:
    """A step of h in the middle of a column of cells is in it with two gradients h of weight 3/4, and beside
    it with one of 1/4, twice for the rows: 3 h, and h / 2 on either side.
    """
    found = kernels.hog_color_cells(stepped(13, height), ones(12, 12))[:16, 2:-2]
    near = np.sqrt(2 * (9 + 0.25) * height**2 + 102**2)
    far = np.sqrt(2 * 0.25 * height**2 + 102**2)
    side, middle = height / 2, 3 * height
    expected = np.zeros((16, 8, 12))
    expected[[0, 8], :, 6] = cut(*4 * [middle / near]) / 2
    expected[12:, :, 6] = 0.2357 * cut(middle / near)
    for column, left, right in ((5, far, near), (7, near, far)):
        expected[[0, 8], :, column] = cut(*2 * [side / left, side / right]) / 2
        shares = [cut(side / left), cut(side / right)]
        expected[12:, :, column] = 0.2357 * np.array(2 * shares)[:, None]
    assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.parametrize("k", range(8))
def test_ramps_in_closed_form(kernels: Kernels, k: int) -> None:
    """A ramp towards 45 k degrees, a level a pixel along each axis it has, is in bin k alone, and of either
    sign in k mod 4: four gradients g over the root of the squares of four cells and 102².
    """
    y, x = np.mgrid[:16, :16]
    across, down = np.rint(np.cos(k * np.pi / 4)), np.rint(np.sin(k * np.pi / 4))
    ramp = np.repeat((128 + across * (x - 8) + down * (y - 8)).astype(np.uint8)[..., None], 3, 2)
    inner = kernels.hog_color_cells(ramp, ones(8, 8))[:16, 2:-2, 2:-2]
    share = 4 * 2 * np.hypot(across, down)
    share /= np.sqrt(4 * share**2 + 102**2)
    assert share < 0.2
    assert_allclose(inner[[k, 8 + k % 4]], 2 * share, rtol=1e-6)
    assert_allclose(inner[12:], 0.2357 * share, rtol=1e-6)
    assert_array_equal(np.delete(inner[:12], [k, 8 + k % 4], axis=0), 0)


def test_takes_the_channel_of_the_longest_gradient(kernels: Kernels) -> None:
    """Weaker channels don't count, and of equal ones the first does."""
    strong = texture(9, 9)[..., 0]
    for channel in range(3):
        patch = np.repeat((strong // 4)[..., None], 3, 2)
        patch[..., channel] = strong // 4 * 4
        gray = np.repeat(patch[..., channel : channel + 1], 3, 2)
        assert_array_equal(
            kernels.hog_color_cells(patch, ones(9, 9))[:16],
            kernels.hog_color_cells(gray, ones(9, 9))[:16],
        )
    y, x = np.mgrid[:18, :18].astype(np.uint8)
    tie = np.stack([6 * y, 6 * x, 6 * (17 - x)], axis=2)
    found = kernels.hog_color_cells(tie, ones(9, 9))[:8, 2:-2, 2:-2]
    assert (found[2] > 0.3).all()
    assert_array_equal(np.delete(found, 2, axis=0), 0)


def test_turns_with_the_patch(kernels: Kernels) -> None:
    """A quarter turn clockwise moves cells as the patch, orientations by two bins, and the block to the upper
    left to the upper right, and so on; sums in another order round otherwise, by the bound above for both.
    """
    patch = np.repeat(texture(14, 14)[..., :1], 3, 2)
    before = kernels.hog_color_cells(patch, ones(14, 14))
    after = kernels.hog_color_cells(np.ascontiguousarray(np.rot90(patch, -1)), ones(14, 14))
    turned = np.rot90(before, -1, (1, 2))
    tolerance = {"rtol": 0, "atol": 128 * 2**-24}
    assert_allclose(after[:8], np.roll(turned[:8], 2, axis=0), **tolerance)
    assert_allclose(after[8:12], np.roll(turned[8:12], 2, axis=0), **tolerance)
    assert_allclose(after[12:16], turned[[14, 12, 15, 13]], **tolerance)
    assert_allclose(after[16:], turned[16:], atol=1e-6)


def test_negatives_turn_only_what_is_signed(kernels: Kernels) -> None:
    """A negative has its patch's orientations of either sign, bit for bit, and the others four bins on."""
    patch = np.repeat(texture(11, 14)[..., :1], 3, 2)
    before, after = (kernels.hog_color_cells(each, ones(11, 14)) for each in (patch, 255 - patch))
    assert_array_equal(after[8:12], before[8:12])
    assert_array_equal(after[:8], np.roll(before[:8], 4, axis=0))


def test_brighter_light_changes_nothing(kernels: Kernels) -> None:
    """What adds 40 levels leaves orientations and texture, and the colors but for rounding."""
    patch = texture(10, 13) // 2
    plain, lit = (kernels.hog_color_cells(patch + np.uint8(add), ones(10, 13)) for add in (0, 40))
    assert_array_equal(lit[:16], plain[:16])
    assert_allclose(lit[16:], plain[16:], atol=3e-7)


def test_contrast_counts_up_to_a_limit(kernels: Kernels) -> None:
    """More contrast lowers no orientation and no texture, and where it is far above 102 levels, it changes
    nothing: shares that are cut stay so.
    """
    patch = texture(15, 12) // 2
    plain, strong = (kernels.hog_color_cells(times * patch, ones(15, 12))[:16] for times in (1, 2))
    assert (strong >= plain).all()  # exactly: a doubled sum has doubled roundings, and rounding is monotonic
    assert (strong > 1.01 * plain).any()
    steps = [kernels.hog_color_cells(stepped(12, height), ones(12, 12))[:16] for height in (60, 250)]
    assert_array_equal(*steps)
    assert steps[0].max() == np.float32(0.4)


def test_is_bounded_and_tapered(kernels: Kernels) -> None:
    """Orientations are from 0 to 0.4 and texture to 8 times 0.2 times 0.2357, no color has a mean, the taper
    multiplies all, and noise of one level, whose gradients are up to √2, is under 4 √2 / 102 in each block.
    """
    patch = np.random.default_rng(3).integers(0, 256, (32, 32, 3), np.uint8)
    plain = kernels.hog_color_cells(patch, ones(16, 16))
    assert plain[:16].min() >= 0
    assert plain[:12].max() <= np.float32(0.4)
    assert plain[12:16].max() <= 8 * 0.2 * 0.2357 * (1 + 8 * 2**-24)
    assert_allclose(plain[16:].mean(axis=(1, 2)), 0, atol=1e-6)
    faint = 100 + (patch > 128).astype(np.uint8)
    assert 0 < kernels.hog_color_cells(faint, ones(16, 16))[:12].max() < 2 * 4 * np.sqrt(2) / 102
    taper = np.random.default_rng(0).random((16, 16)).astype(np.float32)
    taper[:, :3] = 0
    assert_array_equal(kernels.hog_color_cells(patch, taper), plain * taper)


def test_exact_diagonals_have_no_straight_part(kernels: Kernels) -> None:
    """A gradient of two equal sides is in its diagonal bin alone: rounding takes no share below 0."""
    y, x = np.mgrid[:12, :12]
    for height in range(1, 256):
        patch = np.repeat((height * (x + y >= 12)).astype(np.uint8)[..., None], 3, 2)
        inner = kernels.hog_color_cells(patch, ones(6, 6))[:8, 1:-1, 1:-1]
        assert inner[1].max() > 0
        assert_array_equal(np.delete(inner, 1, axis=0), 0)


def test_refuses(kernels: Kernels) -> None:
    """A patch that isn't twice the taper's size, and a taper without cells, are named."""
    patch = np.zeros((8, 6, 3), np.uint8)
    message = r"patch: expected shape \(8, 8, 3\), twice the taper's, got \(8, 6, 3\)"
    with pytest.raises(ValueError, match=message):
        kernels.hog_color_cells(patch, ones(4, 4))
    with pytest.raises(ValueError, match="taper: expected at least one cell, got none"):
        kernels.hog_color_cells(patch, ones(0, 3))


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    with pytest.raises(TypeError, match=r"taper: expected float32 \(R, C\)"):
        _core.hog_color_cells(np.zeros((8, 8, 3), np.uint8), np.ones((4, 4)))
    with pytest.raises(ValueError, match="taper: expected a C-contiguous"):
        _core.hog_color_cells(np.zeros((8, 8, 3), np.uint8), ones(4, 8)[:, ::2])
    with pytest.raises(ValueError, match="patch: expected a uint8 BGR image"):
        _core.hog_color_cells(np.zeros((8, 8), np.uint8), ones(4, 4))
