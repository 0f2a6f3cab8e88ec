# SPDX-License-Identifier: MIT
"""How far away the fused tracker takes pixels to be, against depth images and pairs whose depth is known."""

import cv2
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImage, Pair
from tricue.track.fused.sight import Expected

WIDTH, HEIGHT = 320, 240
RIG = StereoRig(Intrinsics.from_fov(WIDTH, HEIGHT, 60), 0.12)
PRODUCT = RIG.intrinsics.fx * RIG.baseline  # pixels times metres
NUMBERED = np.arange(1, 13, dtype=np.float32).reshape(3, 4)
NAN = np.nan
GRIDS = [(-20.0, -20.0, 1.0), (310.0, 230.0, 1.0), (-500.0, 60.0, 2.0), (0.0, 0.0, 20.0), (100.0, 60.0, 0.02)]
CHANCE = "a pair's matches by chance pass: two thirds of a wall that isn't in the range searched have a depth"


def grain(width: int, seed: int) -> np.ndarray:
    """(HEIGHT, width) gray levels of noise, with detail of two pixels and more."""
    rng = np.random.default_rng(seed)
    fine = cv2.GaussianBlur(rng.normal(0, 1, (HEIGHT, width)), (0, 0), 1.2)
    return np.clip(128 + 45 * fine / fine.std(), 0, 255)


def shifted(image: np.ndarray, disparity: float) -> np.ndarray:
    """As the right camera has it: everything so many pixels farther left."""
    move = np.float32([[1, 0, -disparity], [0, 1, 0]])
    return cv2.warpAffine(image, move, (image.shape[1], HEIGHT), flags=cv2.INTER_CUBIC)


def bgr(gray: np.ndarray) -> np.ndarray:
    """(HEIGHT, WIDTH, 3) of the levels."""
    return cv2.cvtColor(np.clip(np.rint(gray[:, :WIDTH]), 0, 255).astype(np.uint8), cv2.COLOR_GRAY2BGR)


def pair(disparity: float, kernels=None) -> Pair:
    """A wall with that disparity all over."""
    wall = grain(WIDTH + 100, 0)
    left, right = bgr(wall), bgr(shifted(wall, disparity))
    return Pair(kernels or kernel_sets.load("native"), left, right, RIG)


@pytest.mark.parametrize(
    ("grid", "side", "expected"),
    [
        ((0, 0, 1), 2, [[1, 2], [5, 6]]),
        ((1.2, 0.9, 1), 2, [[6, 7], [10, 11]]),
        ((0, 0, 0.5), 4, [[1, 1, 2, 2], [1, 1, 2, 2], [5, 5, 6, 6], [5, 5, 6, 6]]),
        ((-1, -1, 1), 2, [[NAN, NAN], [NAN, 1]]),
        ((3, 2, 1), 2, [[12, NAN], [NAN, NAN]]),
        ((-0.5 - 1e-9, 0, 1), 1, [[NAN]]),
        ((-0.5, 0, 1), 1, [[1]]),
        ((3.5 - 1e-9, 2.4, 1), 1, [[12]]),
        ((3.5, 2.4, 1), 1, [[NAN]]),
        ((-9, -9, 20), 1, [[6]]),
        ((1e9, -1e9, 1), 1, [[NAN]]),
    ],
    ids=str,
)
def test_depth_is_that_of_the_pixel_under_the_middle(grid, side, expected):
    """Pixel (i, j) covers [j, j + 1) x [i, i + 1); beyond the image there is nothing."""
    metres = DepthImage(NUMBERED).metres(grid, side, None)
    assert metres.dtype == np.float32
    np.testing.assert_array_equal(metres, np.array(expected, np.float32))


def test_depth_does_not_ask_what_is_expected():
    """A depth camera measures what is there, holes included."""
    holed = np.where(NUMBERED == 6, np.float32(NAN), NUMBERED)
    ranger = DepthImage(holed)
    alone, told = (ranger.metres((0.0, 0.0, 1), 3, each) for each in (None, Expected(2.0, 0.01)))
    np.testing.assert_array_equal(alone, told)
    assert np.isnan(alone[1, 1])
    assert np.isnan(alone).sum() == 1


def test_posterior_agrees_with_metres(kernels):
    """Both read the same pixels: the posterior is high exactly where the metres are near what is expected."""
    depth = np.random.default_rng(0).uniform(1, 3, (40, 50)).astype(np.float32)
    depth[::3, ::2] = np.nan
    ranger, grid = DepthImage(depth), (-3.3, 7.6, 1.7)
    belief, nearer = ranger.posterior(kernels, grid, 24, Expected(2.0, 0.1), 0.5)
    metres = ranger.metres(grid, 24, None)
    np.testing.assert_array_equal(nearer, metres < 1.5)
    np.testing.assert_array_equal(belief == 0.5, np.isnan(metres))
    assert (np.abs(metres[belief > 0.5] - 2) < 0.22).all()
    assert (np.abs(metres[belief < 0.5] - 2) > 0.21).all()


@pytest.mark.parametrize("unit", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("disparity", [5.0, 8.0, 12.5, 22.25])
def test_a_wall_is_where_it_is(disparity, unit):
    """Without an expected depth most squares of a wall are measured, their median to a tenth of a sample of
    disparity, nine tenths of them to half a sample.
    """
    metres = pair(disparity).metres((110.0, 70.0, unit), 40, None)
    found = PRODUCT / metres[np.isfinite(metres)]
    assert found.size > 0.8 * metres.size
    assert np.median(found) == pytest.approx(disparity, abs=0.1 * unit)
    assert np.mean(np.abs(found - disparity) < 0.5 * unit) > 0.9


@pytest.mark.parametrize("off", [-0.2, 0.0, 0.25])
@pytest.mark.parametrize("disparity", [8.0, 12.5])
def test_an_expected_wall_is_where_it_is(disparity, off):
    """With a depth expected that is up to a quarter off, the wall is measured as well as without."""
    around = Expected((1 + off) * PRODUCT / disparity, 0.1)
    metres = pair(disparity).metres((110.0, 70.0, 1.0), 40, around)
    found = PRODUCT / metres[np.isfinite(metres)]
    assert found.size > 0.8 * metres.size
    assert np.median(found) == pytest.approx(disparity, abs=0.1)
    assert np.mean(np.abs(found - disparity) < 0.5) > 0.9


@pytest.mark.xfail(strict=True, raises=AssertionError, reason=CHANCE)
def test_only_what_is_near_the_expected_is_found():
    """A wall 30 samples of disparity away from what is expected is hardly ever taken for anything."""
    metres = pair(4.0).metres((130.0, 70.0, 1.0), 40, Expected(PRODUCT / 34, 0.1))
    assert np.mean(np.isfinite(metres)) < 0.2


def test_a_target_before_a_wall(kernels):
    """Each of two depths is measured where it is, to half a pixel of disparity beside the window's reach."""
    wall, nearer = grain(WIDTH + 100, 0), grain(WIDTH + 100, 1)
    left, right = wall.copy(), shifted(wall, 5.0)
    left[80:160, 120:200], right[80:160, 108:188] = nearer[80:160, 120:200], nearer[80:160, 120:200]
    eyes = Pair(kernels, bgr(left), bgr(right), RIG)
    found = PRODUCT / eyes.metres((100.0, 60.0, 2.0), 60, None)
    inside, outside = found[16:44, 16:44], found[:6]  # 8 pixels or more from the edge
    for part, disparity in ((inside, 12.0), (outside, 5.0)):
        measured = part[np.isfinite(part) & (part > 0)]
        assert measured.size > 0.7 * part.size
        assert np.median(measured) == pytest.approx(disparity, abs=0.3)


def test_sets_of_kernels_agree():
    """Native and reference kernels measure the same bits."""
    native, reference = (
        pair(8.0, kernel_sets.load(name)).metres((100.0, 60.0, 1.5), 24, Expected(4.0, 0.2))
        for name in ("native", "reference")
    )
    np.testing.assert_array_equal(native, reference)


@pytest.mark.parametrize("around", [None, Expected(3.0, 0.1)])
def test_blank_walls_have_no_depth(around):
    """Where nothing can be compared nothing is measured."""
    blank = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
    metres = Pair(kernel_sets.load("native"), blank, blank, RIG).metres((100.0, 60.0, 1.0), 30, around)
    assert not np.isfinite(metres).any()


@pytest.mark.parametrize("grid", GRIDS, ids=str)
@pytest.mark.parametrize(
    "around", [None, Expected(0.05, 3.0), Expected(3.0, 0.1), Expected(1e4, 0.1)], ids=str
)
def test_any_grid_gives_metres_above_zero(grid, around):
    """Over the edge, far outside, coarse or fine: what is measured is above 0."""
    metres = pair(8.0).metres(grid, 24, around)
    assert metres.shape == (24, 24)
    assert (metres[np.isfinite(metres)] > 0).all()


def test_noise_grows_with_the_distance():
    """A pair's error grows with the square of the distance and with the samples' size, a depth camera's with
    the distance.
    """
    eyes, camera = pair(8.0), DepthImage(NUMBERED)
    assert eyes.noise(4.0, 1.0) == pytest.approx(4 * eyes.noise(2.0, 1.0))
    assert eyes.noise(2.0, 3.0) == pytest.approx(3 * eyes.noise(2.0, 1.0))
    assert camera.noise(4.0, 1.0) == pytest.approx(2 * camera.noise(2.0, 1.0))


def test_noise_is_about_what_it_says():
    """The spread of a noisy wall's measurements is what ``noise`` says, within 1:3."""
    rng = np.random.default_rng(0)
    clean = pair(12.5)
    left, right = (
        np.clip(image + rng.normal(0, 4, image.shape), 0, 255).astype(np.uint8)
        for image in (clean.left, clean.right)
    )
    metres = clean._replace(left=left, right=right).metres((110.0, 70.0, 1.0), 60, None)
    off = metres[np.isfinite(metres)] - PRODUCT / 12.5
    spread = 1.4826 * np.median(np.abs(off))
    assert 1 / 3 < spread / clean.noise(PRODUCT / 12.5, 1.0) < 3
