# SPDX-License-Identifier: MIT
"""The depth that the fused tracker measures, against depth images and stereo pairs of known depth."""

import cv2
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth, StereoSource

WIDTH, HEIGHT = 320, 240
RIG = StereoRig(Intrinsics.from_fov(WIDTH, HEIGHT, 60), 0.12)
FOCAL_BASELINE = RIG.intrinsics.fx * RIG.baseline  # pixels times meters
NATIVE = kernel_sets.load("native")
NUMBERED = np.arange(1, 13, dtype=np.float32).reshape(3, 4)
NAN = np.nan
GRIDS = [(-20.0, -20.0, 1.0), (310.0, 230.0, 1.0), (-500.0, 60.0, 2.0), (0.0, 0.0, 20.0), (100.0, 60.0, 0.02)]
CHANCE_MATCHES = "chance matches pass: almost half of a wall that isn't in the range searched have a depth"


def grain(width: int, seed: int) -> np.ndarray:
    """(HEIGHT, width) gray levels of noise, with detail of two pixels and more."""
    rng = np.random.default_rng(seed)
    fine = cv2.GaussianBlur(rng.normal(0, 1, (HEIGHT, width)), (0, 0), 1.2)
    return np.clip(128 + 45 * fine / fine.std(), 0, 255)


def shifted(image: np.ndarray, disparity: float) -> np.ndarray:
    """The right camera's image: everything so many pixels farther left."""
    move = np.float32([[1, 0, -disparity], [0, 1, 0]])
    return cv2.warpAffine(image, move, (image.shape[1], HEIGHT), flags=cv2.INTER_CUBIC)


def bgr(gray: np.ndarray) -> np.ndarray:
    """(HEIGHT, WIDTH, 3) of the levels."""
    return cv2.cvtColor(np.clip(np.rint(gray[:, :WIDTH]), 0, 255).astype(np.uint8), cv2.COLOR_GRAY2BGR)


def pair(disparity: float) -> StereoSource:
    """A wall with that disparity all over."""
    wall = grain(WIDTH + 100, 0)
    left, right = bgr(wall), bgr(shifted(wall, disparity))
    return StereoSource(left, right, RIG)


def test_a_depth_image_measures_each_box(kernels):
    """Of several boxes each has its own depth; beyond the image there is none."""
    boxes = np.array([[0.5, 0.5, 1, 1], [2.5, 1.5, 1, 1], [9.0, 1.0, 1, 1], [2.0, 2.5, 4, 1]])
    z, _, _ = DepthImageSource(NUMBERED).medians(kernels, boxes, 4, None, (9.0, 0.1)).T
    np.testing.assert_array_equal(z[:3], [1, 7, NAN])
    assert z[3] == 8.5  # of the square of the longer side, the lower part of which is beyond the image


@pytest.mark.parametrize("expected", [None, ExpectedDepth(4.0, 0.2)])
def test_stereo_measures_the_samples_in_a_box(expected, kernels):
    """Its medians are those of what it samples in the square around each box."""
    stereo, boxes = pair(8.0), np.array([[130.0, 100.0, 30.0, 40.0], [150.0, 110.0, 36.0, 24.0]])
    found = stereo.medians(kernels, boxes, 24, expected, (0.5, 0.1))
    for (x, y, width, height), measured in zip(boxes.tolist(), found, strict=True):
        side = max(width, height)
        depths = stereo.sample(kernels, (x - side / 2, y - side / 2, side / 24), 24, expected)
        box = np.array([[12.0, 12.0, 24 * width / side, 24 * height / side]])
        z = expected.z if expected else NAN
        np.testing.assert_array_equal(kernels.median_depths(depths, box, 24, z, 0.5, 0.1)[0], measured)
    assert np.abs(FOCAL_BASELINE / found[:, 0] - 8).max() < 0.2


@pytest.mark.parametrize("unit", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("disparity", [5.0, 8.0, 12.5, 22.25])
def test_a_wall_is_measured(disparity, unit):
    """Without an expected depth most squares of a wall are measured, their median to a tenth of a sample of
    disparity, nine tenths of them to half a sample.
    """
    depths = pair(disparity).sample(NATIVE, (110.0, 70.0, unit), 40, None)
    found = FOCAL_BASELINE / depths[np.isfinite(depths)]
    assert found.size > 0.8 * depths.size
    assert np.median(found) == pytest.approx(disparity, abs=0.1 * unit)
    assert np.mean(np.abs(found - disparity) < 0.5 * unit) > 0.9


@pytest.mark.parametrize("off", [-0.2, 0.0, 0.25])
@pytest.mark.parametrize("disparity", [8.0, 12.5])
def test_an_expected_wall_is_measured(disparity, off):
    """With a depth expected that is up to a quarter off, the wall is measured as well as without."""
    expected = ExpectedDepth((1 + off) * FOCAL_BASELINE / disparity, 0.1)
    depths = pair(disparity).sample(NATIVE, (110.0, 70.0, 1.0), 40, expected)
    found = FOCAL_BASELINE / depths[np.isfinite(depths)]
    assert found.size > 0.8 * depths.size
    assert np.median(found) == pytest.approx(disparity, abs=0.1)
    assert np.mean(np.abs(found - disparity) < 0.5) > 0.9


@pytest.mark.xfail(strict=True, raises=AssertionError, reason=CHANCE_MATCHES)
def test_only_what_is_near_the_expected_is_found():
    """A wall 30 samples of disparity away from what is expected is hardly ever taken for anything."""
    depths = pair(4.0).sample(NATIVE, (130.0, 70.0, 1.0), 40, ExpectedDepth(FOCAL_BASELINE / 34, 0.1))
    assert np.mean(np.isfinite(depths)) < 0.2


def test_a_target_in_front_of_a_wall(kernels):
    """Both depths are measured to 0.3 pixels of disparity, where the window doesn't reach the other."""
    wall, nearer = grain(WIDTH + 100, 0), grain(WIDTH + 100, 1)
    left, right = wall.copy(), shifted(wall, 5.0)
    left[80:160, 120:200], right[80:160, 108:188] = nearer[80:160, 120:200], nearer[80:160, 120:200]
    stereo = StereoSource(bgr(left), bgr(right), RIG)
    found = FOCAL_BASELINE / stereo.sample(kernels, (100.0, 60.0, 2.0), 60, None)
    inside, outside = found[16:44, 16:44], found[:6]  # 8 pixels or more from the edge
    for part, disparity in ((inside, 12.0), (outside, 5.0)):
        measured = part[np.isfinite(part) & (part > 0)]
        assert measured.size > 0.7 * part.size
        assert np.median(measured) == pytest.approx(disparity, abs=0.3)


@pytest.mark.parametrize("side", [4.0, 8.0, 20.0])
@pytest.mark.parametrize("disparity", [3.0, 30.0, 70.0])
def test_a_small_box_is_measured(disparity, side):
    """However small a box is, what is near is measured in it, to a hundredth."""
    boxes = np.array([[200.0, 120.0, side, side]])
    z, _, _ = pair(disparity).medians(NATIVE, boxes, 48, None, (0.5, 0.1))[0]
    assert FOCAL_BASELINE / z == pytest.approx(disparity, rel=0.01, abs=0.2)


def test_what_the_right_image_does_not_show_has_no_depth(kernels):
    """Near the left border, where the other image ends before what matches, chance finds depth in at most one
    box of ten.
    """
    boxes = np.array([[x, y, 40.0, 50.0] for x in (16.0, 25.0, 35.0, 44.0) for y in range(40, 201, 20)])
    found = pair(70.0).medians(kernels, boxes, 48, None, (0.5, 0.1))
    assert np.isfinite(found[:, 0]).mean() < 0.1


def test_sets_of_kernels_agree():
    """Native and reference kernels measure the same bits."""
    native, reference = (
        pair(8.0).sample(kernel_sets.load(name), (100.0, 60.0, 1.5), 24, ExpectedDepth(4.0, 0.2))
        for name in ("native", "reference")
    )
    np.testing.assert_array_equal(native, reference)


@pytest.mark.parametrize("expected", [None, ExpectedDepth(3.0, 0.1)])
def test_blank_walls_have_no_depth(expected):
    """Where nothing can be compared nothing is measured."""
    blank = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
    depths = StereoSource(blank, blank, RIG).sample(NATIVE, (100.0, 60.0, 1.0), 30, expected)
    assert not np.isfinite(depths).any()


@pytest.mark.parametrize("grid", GRIDS, ids=str)
@pytest.mark.parametrize(
    "expected", [None, ExpectedDepth(0.05, 3.0), ExpectedDepth(3.0, 0.1), ExpectedDepth(1e4, 0.1)], ids=str
)
def test_any_grid_gives_depths_above_zero(grid, expected):
    """Over the edge, far outside, coarse or fine: what is measured is above 0."""
    depths = pair(8.0).sample(NATIVE, grid, 24, expected)
    assert depths.shape == (24, 24)
    assert (depths[np.isfinite(depths)] > 0).all()


def test_noise_grows_with_the_distance():
    """A stereo pair's error grows with the square of the distance and with the samples' size; a depth
    camera's with the distance.
    """
    stereo, camera = pair(8.0), DepthImageSource(NUMBERED)
    assert stereo.noise(4.0, 1.0) == pytest.approx(4 * stereo.noise(2.0, 1.0))
    assert stereo.noise(2.0, 3.0) == pytest.approx(3 * stereo.noise(2.0, 1.0))
    assert stereo.noise(2.0, 0.3) == stereo.noise(2.0, 1.0)  # a match in finer samples is no more precise
    assert camera.noise(4.0, 1.0) == pytest.approx(2 * camera.noise(2.0, 1.0))


def test_noise_predicts_the_spread():
    """The spread of a noisy wall's measurements is ``noise``, within 1:3."""
    rng = np.random.default_rng(0)
    clean = pair(12.5)
    left, right = (
        np.clip(image + rng.normal(0, 4, image.shape), 0, 255).astype(np.uint8)
        for image in (clean.left, clean.right)
    )
    depths = clean._replace(left=left, right=right).sample(NATIVE, (110.0, 70.0, 1.0), 60, None)
    off = depths[np.isfinite(depths)] - FOCAL_BASELINE / 12.5
    spread = 1.4826 * np.median(np.abs(off))
    assert 1 / 3 < spread / clean.noise(FOCAL_BASELINE / 12.5, 1.0) < 3
