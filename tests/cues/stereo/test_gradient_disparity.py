# SPDX-License-Identifier: MIT
"""Gradient disparity: how far a prediction is off, pixel by pixel."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.track.flow_depth.cues import GradientMatching

from tests.kernel_arguments import Place, with_argument

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]

USUAL = GradientMatching()
ONE_LEVEL = GradientMatching(levels=1, radius=0, max_step=2.0, sigma=2.0)  # the paper's


def clouds(seed: int, shape: tuple[int, int], scale: float = 1.5) -> Floats:
    """Texture without an end: 128 +- 40 gray levels."""
    noise = np.random.default_rng(seed).normal(size=shape)
    smooth = ndimage.gaussian_filter(noise, scale, mode="wrap")
    return 128 + 40 * smooth / smooth.std()


def gray(picture: Floats) -> Image:
    """Whole gray levels."""
    return np.rint(picture).clip(0, 255).astype(np.uint8)


def shifted(picture: Floats, disparity: Any) -> Image:
    """The right image of a left one, d a number or an array (H, W) over the right image's pixels."""
    y, x = np.mgrid[: picture.shape[0], : picture.shape[1]].astype(np.float64)
    return gray(ndimage.map_coordinates(picture, [y, x + disparity], order=5, mode="nearest"))


def pair(seed: int = 0, shape: tuple[int, int] = (60, 90), disparity: Any = 7.4) -> tuple[Image, Image]:
    """A textured wall and its true disparity's right image."""
    picture = clouds(seed, shape)
    return gray(picture), shifted(picture, disparity)


def assert_twins_agree(*arguments: Any, tolerance: float = 2e-4) -> None:
    """In single precision f is known to about 1e-4 gray levels a pixel, and the least slope that is kept is
    about 0.4, so d agrees to 2e-4 px, and which pixels are kept but for ties with a limit.
    """
    found, reliability = _core.gradient_disparity(*arguments)
    expected, twin_reliability = reference.gradient_disparity(*arguments)
    assert found.dtype == reliability.dtype == np.float32
    assert found.shape == expected.shape == reliability.shape
    assert (np.isnan(found) != np.isnan(expected)).mean() < 0.001
    both = np.isfinite(found) & np.isfinite(expected)
    assert_allclose(found[both], expected[both], rtol=0, atol=tolerance)
    assert_allclose(reliability, twin_reliability, rtol=1e-3, atol=1e-4)


CASES: list[tuple[float, GradientMatching, tuple[int, int, int, int] | None]] = [
    (6.1, USUAL, None),
    (8.0, GradientMatching(levels=1), None),
    (6.1, GradientMatching(levels=2, radius=1, sigma=0.7), None),
    (6.1, GradientMatching(levels=4, radius=3, sigma=2.0), None),
    (6.1, GradientMatching(levels=6, radius=7, sigma=5.9), None),
    (6.1, GradientMatching(radius=4, sigma=1.3), None),
    (6.1, GradientMatching(radius=5), (10, 4, 33, 21)),
    (6.1, GradientMatching(radius=6), (85, 55, 90, 60)),
    (6.1, USUAL, (-7, -9, 200, 101)),
    (6.1, USUAL, (41, 33, 42, 34)),
    (-5.5, USUAL, None),
    (80.0, USUAL, None),
    (6.1, GradientMatching(min_reliability=20.0, max_residual=0.02, max_step=0.2), None),
]


@pytest.mark.parametrize(("disparity", "matching", "region"), CASES, ids=str)
def test_twin_measures_the_same(disparity: float, matching: Any, region: Any) -> None:
    """Native and twin agree for any level, window, filter, prediction and region, also over the edge."""
    assert_twins_agree(*pair(), disparity, matching, region)


def test_twin_measures_the_same_without_windows() -> None:
    """A pixel alone may have nearly opposite slopes; the ridge of 0.01 then lets errors grow twentyfold."""
    assert_twins_agree(*pair(1), 7.0, ONE_LEVEL, tolerance=5e-3)


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (2, 3), (7, 64), (33, 5), (130, 610)], ids=str)
def test_twin_measures_the_same_in_any_shape(shape: tuple[int, int]) -> None:
    """Pictures smaller than the filters, of odd sides, and of more than one band of rows."""
    picture = np.random.default_rng(2).integers(0, 256, shape).astype(np.uint8)
    right = np.roll(picture, -1, 1)
    assert_twins_agree(picture, right, 0.6, GradientMatching(max_residual=9.0))


def test_rows_may_be_padded() -> None:
    """A view into larger images gives what its copy gives, to the last bit."""
    left, right = pair(3)
    views = left[3:50, 5:70], right[3:50, 5:70]
    copies = [np.ascontiguousarray(view) for view in views]
    for found, expected in zip(
        _core.gradient_disparity(*views, 7.0, USUAL),
        _core.gradient_disparity(*copies, 7.0, USUAL),
        strict=True,
    ):
        assert_array_equal(found, expected)


@pytest.mark.parametrize("off", [-6.0, -4.0, -2.0, 0.0, 0.7, 2.0, 4.0, 6.0])
def test_reads_what_is_near_the_prediction(kernels: Kernels, off: float) -> None:
    """Three levels find a wall's disparity, known from interpolation by splines, from 6 px off."""
    left, right = pair(4, (80, 120), 9.3)
    found, _ = kernels.gradient_disparity(left, right, 9.3 - off, USUAL)
    inner = found[12:-12, 28:-28]
    errors = abs(inner[np.isfinite(inner)] - 9.3)
    assert np.isfinite(inner).mean() > 0.9
    assert np.median(errors) < 0.1
    assert np.quantile(errors, 0.95) < 0.2


@pytest.mark.parametrize("off", [-1.0, 0.0, 1.0])
def test_one_level_is_the_papers(kernels: Kernels, off: float) -> None:
    """Without levels and windows the reach is a pixel, with half of the pixels right to 0.15 px."""
    left, right = pair(5, (80, 120), 4.3)
    found, _ = kernels.gradient_disparity(left, right, 4.3 - off, ONE_LEVEL)
    inner = found[12:-12, 20:-20]
    assert np.isfinite(inner).mean() > 0.5
    assert np.nanmedian(abs(inner - 4.3)) < 0.15


def test_slanted_wall(kernels: Kernels) -> None:
    """A disparity that grows by 6 px across the picture is followed: x_left = x_right + d(x_right)."""
    x = np.arange(160.0)
    left, right = pair(6, (60, 160), np.broadcast_to(5 + 6 * x / 160, (60, 160)))
    found, _ = kernels.gradient_disparity(left, right, 8.0, USUAL)
    truth = np.interp(x, x + 5 + 6 * x / 160, 5 + 6 * x / 160)
    errors = abs(found - truth)[10:-10, 25:-20]
    assert np.isfinite(errors).mean() > 0.9
    assert np.nanquantile(errors, 0.9) < 0.15


def test_nearer_occluder_is_read_by_levels_only(kernels: Kernels) -> None:
    """Something 5 px nearer is measured as such coarse to fine; one level doesn't know it from the target."""
    behind, before = clouds(7, (90, 140)), clouds(8, (90, 140))
    left, right = gray(behind), shifted(behind, 6.0)
    left[20:70, 50:90] = gray(before)[20:70, 50:90]
    right[20:70, 39:79] = gray(before)[20:70, 50:90]  # d = 11
    inside = np.s_[28:62, 58:82]
    found = kernels.gradient_disparity(left, right, 6.0, USUAL)[0][inside]
    assert np.isfinite(found).mean() > 0.8
    assert (abs(found[np.isfinite(found)] - 11) < 0.5).mean() > 0.95
    one = kernels.gradient_disparity(left, right, 6.0, ONE_LEVEL)[0][inside]
    assert (abs(one - 11) < 0.5).mean() < 0.05
    taken_for_target = [(abs(each - 6) < 1).mean() for each in (found, one)]
    assert taken_for_target[0] < 0.005
    assert taken_for_target[1] > 0.03


def test_reliability_is_that_of_the_filters_of_scipy(kernels: Kernels) -> None:
    """(9) of two equal images without a window is twice f_x squared, f SciPy's derivative of a Gaussian."""
    left, _ = pair(9)
    _, reliability = kernels.gradient_disparity(left, left, 0.0, GradientMatching(1, 2.0, 0))
    f = ndimage.gaussian_filter(left.astype(np.float64), 2.0, order=(0, 1), mode="nearest", radius=5)
    slope = np.gradient(f, axis=1)[:, 3:-3]
    ratio = reliability[:, 3:-3] / np.maximum(2 * slope**2, 1e-9)
    ours, theirs = np.sqrt(reliability[:, 3:-3]), np.sqrt(2) * abs(slope)
    assert np.corrcoef(ours.ravel(), theirs.ravel())[0, 1] > 0.99999
    x = np.arange(-5, 6)
    bell = np.exp(-(x**2) / 8)
    gain = 4 * bell.sum() / (x**2 * bell).sum()  # on a ramp SciPy's, cut at 2.5 sigma, gives too little
    assert_allclose(np.median(ratio), gain**2, rtol=1e-4)


@pytest.mark.parametrize(
    "region", [(0, 0, 160, 35), (17, 3, 18, 100), (60, 41, 141, 103), (-20, 90, 40, 160)]
)
@pytest.mark.parametrize("predicted", [7.0, 3.7, -2.2])
def test_region_is_a_part_of_the_whole(
    kernels: Kernels, region: tuple[int, int, int, int], predicted: float
) -> None:
    """A region's result is the whole's in it, to the last bit, and nothing outside the picture."""
    left, right = pair(10, (120, 160))
    x0, y0, x1, y1 = region
    rows, columns = np.arange(y0, y1), np.arange(x0, x1)
    seen = ((rows >= 0) & (rows < 120))[:, None] & ((columns >= 0) & (columns < 160))
    for index, nothing in ((0, np.nan), (1, 0)):
        part = kernels.gradient_disparity(left, right, predicted, USUAL, region)[index]
        whole = kernels.gradient_disparity(left, right, predicted, USUAL)[index]
        expected = whole[np.ix_(rows.clip(0, 119), columns.clip(0, 159))]
        assert_array_equal(part, np.where(seen, expected, np.float32(nothing)))


def test_light_and_contrast(kernels: Kernels) -> None:
    """20 gray levels more in one image change nothing; twice the contrast multiplies (9) by 4."""
    left, right = (image // 2 + 20 for image in pair(11))
    all_reliable, one_level = GradientMatching(min_reliability=0.0), GradientMatching(levels=1)
    found, _ = kernels.gradient_disparity(left, right, 7.0, all_reliable)
    brighter, _ = kernels.gradient_disparity(left, right + np.uint8(20), 7.0, all_reliable)
    assert (np.isnan(found) == np.isnan(brighter)).mean() > 0.999
    assert np.nanmax(abs(found - brighter)) < 1e-3
    _, strong = kernels.gradient_disparity(2 * (left - 20), 2 * (right - 20), 7.0, one_level)
    _, weak = kernels.gradient_disparity(left, right, 7.0, one_level)
    assert_allclose(strong, 4 * weak, rtol=1e-4, atol=1e-4)


def test_prediction_follows_the_image(kernels: Kernels) -> None:
    """Moving the right image by 8 columns and the prediction with it moves the readings by 8 px."""
    wide = clouds(12, (50, 200))
    left = gray(wide)[:, 40:140]
    near, far = (shifted(wide, d)[:, 40:140] for d in (4.4, 12.4))
    first, _ = kernels.gradient_disparity(left, near, 4.0, USUAL)
    second, _ = kernels.gradient_disparity(left, far, 12.0, USUAL)
    inner = np.s_[:, 36:-24]
    assert_allclose(second[inner], first[inner] + 8, rtol=0, atol=1e-3)


def test_limits_only_reject(kernels: Kernels) -> None:
    """A stricter limit leaves fewer readings, and those that stay unchanged."""
    left, right = pair(13, disparity=6.0)
    right = gray(right + np.random.default_rng(0).normal(0, 8, right.shape))
    loose = GradientMatching(min_reliability=0.0, max_residual=2.0, max_step=9.0)
    every, _ = kernels.gradient_disparity(left, right, 5.0, loose)
    for name, values in {
        "min_reliability": (0, 5, 20, 80),
        "max_residual": (1, 0.2, 0.1, 0.02),
        "max_step": (1, 0.5, 0.1, 0),
    }.items():
        limits = [loose._replace(**{name: value}) for value in values]
        kept = [kernels.gradient_disparity(left, right, 5.0, matching)[0] for matching in limits]
        counts = [np.isfinite(found).sum() for found in kept]
        assert counts == sorted(counts, reverse=True)
        assert counts[-1] < counts[0]
        for found in kept:
            assert_array_equal(found[np.isfinite(found)], every[np.isfinite(found)])


def test_nothing_to_read(kernels: Kernels) -> None:
    """Flat images and a prediction out of the picture leave nothing; of unrelated ones few pixels
    pass, and those are spread over the reach.
    """
    flat = np.full((40, 70), 90, np.uint8)
    assert np.isnan(kernels.gradient_disparity(flat, flat, 3.0, USUAL)[0]).all()
    one, other = gray(clouds(14, (90, 120))), gray(clouds(15, (90, 120)))
    unrelated, _ = kernels.gradient_disparity(one, other, 3.0, USUAL)
    assert np.isfinite(unrelated).mean() < 0.1
    assert (abs(unrelated - 3) < 1).mean() < 0.02
    for predicted in (16384.0, -16384.0, 200.0, -150.5):
        found, reliability = kernels.gradient_disparity(one, one, predicted, USUAL)
        assert np.isnan(found).all()
        assert_array_equal(reliability, 0)
    outside, _ = kernels.gradient_disparity(one, one, 0.0, USUAL, (120, 0, 130, 9))
    assert np.isnan(outside).all()


def test_columns_that_the_right_image_lacks(kernels: Kernels) -> None:
    """The first d columns of the left image have no disparity, but for what looks alike by chance."""
    left, right = pair(16, (60, 120), 10.0)
    found, _ = kernels.gradient_disparity(left, right, 10.0, USUAL)
    assert np.isnan(found[:, :10]).mean() > 0.95
    assert np.isfinite(found[5:-5, 14:]).mean() > 0.9


def test_is_finer_than_block_matching_on_real_images(kernels: Kernels, data: Any) -> None:
    """Round the truth of a real pair it errs less than cv2.StereoBM in the pixels that both read."""
    left, right = (
        cv2.imread(str(data / "disparity" / "venus" / name), cv2.IMREAD_GRAYSCALE)
        for name in ("im2.png", "im6.png")
    )
    levels = cv2.imread(str(data / "disparity" / "venus" / "disp2.png"), cv2.IMREAD_GRAYSCALE)
    assert left is not None
    assert right is not None
    assert levels is not None
    truth = levels / 8.0
    views = np.asarray(left, np.uint8), np.asarray(right, np.uint8)
    found, _ = kernels.gradient_disparity(*views, 10.0, USUAL)
    theirs = cv2.StereoBM.create(32, 5).compute(left, right) / 16
    near = np.isfinite(found) & (theirs >= 0) & (levels > 0) & (abs(truth - 10) <= 2)
    assert near.sum() > 5000
    assert np.median(abs(found - truth)[near]) < np.median(abs(theirs - truth)[near])


BAD: list[tuple[Place, Any, str]] = [
    (0, np.zeros((0, 5), np.uint8), "left: expected at least one pixel, got none"),
    (1, np.zeros((9, 8), np.uint8), r"right: expected the left image's shape \(9, 9\), got \(9, 8\)"),
    (2, np.nan, "disparity: expected -16384 to 16384, got nan"),
    (2, 16385.0, "disparity: expected -16384 to 16384, got 16385"),
    ((3, 0), 0, "levels: expected 1 to 6, got 0"),
    ((3, 0), 7, "levels: expected 1 to 6, got 7"),
    ((3, 1), 0.4, "sigma: expected 0.5 to 6, got 0.4"),
    ((3, 1), np.nan, "sigma: expected 0.5 to 6, got nan"),
    ((3, 2), -1, "radius: expected 0 to 7, got -1"),
    ((3, 2), 8, "radius: expected 0 to 7, got 8"),
    ((3, 3), -0.1, "min_reliability: expected a number that isn't negative, got -0.1"),
    ((3, 4), np.nan, "max_residual: expected a number that isn't negative, got nan"),
    ((3, 5), -1.0, "max_step: expected a number that isn't negative, got -1"),
    (
        4,
        (3, 0, 3, 9),
        r"region: expected x0 < x1 and y0 < y1, at most 16384 apart, got \(3, 0, 3, 9\)",
    ),
    (4, (0, 4, 9, -1), r"region: expected x0 < x1 .* got \(0, 4, 9, -1\)"),
    (4, (0, 0, 16385, 1), r"region: expected .* at most 16384 apart, got \(0, 0, 16385, 1\)"),
    (4, (-(2**31), 0, 2**31 - 1, 1), "region: expected .* at most 16384 apart"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    image = np.zeros((9, 9), np.uint8)
    with pytest.raises(ValueError, match=message):
        kernels.gradient_disparity(*with_argument((image, image, 0.0, USUAL, None), place, value))


def test_native_refuses_other_numbers() -> None:
    """What isn't a tuple of six numbers, or of four integers of 32 bits, is named."""
    arguments = np.zeros((9, 9), np.uint8), np.zeros((9, 9), np.uint8), 0.0, USUAL, (0, 0, 9, 9)
    with pytest.raises(ValueError, match="matching: expected a tuple of 6, got one of 5"):
        _core.gradient_disparity(*with_argument(arguments, 3, USUAL[:5]))
    with pytest.raises(TypeError, match="matching: expected an integer in it, got float"):
        _core.gradient_disparity(*with_argument(arguments, (3, 2), 2.0))
    with pytest.raises(ValueError, match="region: expected integers of at most 32 bits in it"):
        _core.gradient_disparity(*with_argument(arguments, (4, 2), 2**31))


def test_native_refuses_other_images() -> None:
    """Color, floats and pixels that aren't packed are named, never converted."""
    gray_image = np.zeros((9, 9), np.uint8)
    with pytest.raises(ValueError, match="left: expected a uint8 gray image"):
        _core.gradient_disparity(np.zeros((9, 9, 3), np.uint8), gray_image, 0.0, USUAL)
    with pytest.raises(TypeError, match="right: expected a uint8 gray image"):
        _core.gradient_disparity(gray_image, gray_image.astype(np.float32), 0.0, USUAL)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="right: expected packed pixels"):
        _core.gradient_disparity(gray_image[:, :4], gray_image[:, ::2][:, :4], 0.0, USUAL)
