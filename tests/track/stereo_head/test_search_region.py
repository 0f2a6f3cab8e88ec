# SPDX-License-Identifier: MIT
"""That a stereo pair is prepared in the first frame's light, and cells at the head's depth are coherent."""

import cv2
import numpy as np
import pytest
from tricue import StereoHeadTracker
from tricue.kernels import load
from tricue.track.stereo_head.prepared_pair import PreparedPair, cell_side
from tricue.track.stereo_head.search_region import crop_region

Params = StereoHeadTracker.Params
P = Params()
NO_BIN = 65535
K = load("native")


def picture(height: int, width: int, seed: int = 0) -> np.ndarray:
    """Clouds of color with fine grain, BGR."""
    rng = np.random.default_rng(seed)
    coarse = rng.integers(30, 220, (height // 4 + 1, width // 4 + 1, 3)).astype(np.uint8)
    smooth = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC).astype(int)
    return np.clip(smooth + rng.integers(-9, 10, smooth.shape), 0, 255).astype(np.uint8)


def shifted(image: np.ndarray, disparity: int) -> np.ndarray:
    """The right image of what lies wholly at a disparity."""
    return np.roll(image, -disparity, axis=1)


def mean_color(image: np.ndarray) -> np.ndarray:
    """(3,) mean blue, green and red."""
    return image.mean(axis=(0, 1))


def all_bins(k, image: np.ndarray, light: np.ndarray | None) -> np.ndarray:
    """The bins of an image's cells, with the light compensated to a first mean color."""
    height, width = image.shape[:2]
    return PreparedPair.of(k, image, image, np.inf, light, P).bins(k, (0, 0, width, height), 1, P)


@pytest.mark.parametrize("gains", [(2, 2, 2), (2, 1, 4), (1, 1, 1)], ids=str)
def test_another_light_is_taken_out_exactly(gains, kernels):
    """A picture whose channels are whole multiples of what they were in the first light has the bins that it
    had, every one.
    """
    first = picture(24, 32) // 4
    lit = first * np.array(gains, np.uint8)
    expected = kernels.color_bins(first, (0, 0, 32, 24), P.color_space, 1)
    np.testing.assert_array_equal(all_bins(kernels, lit, mean_color(first)), expected)


@pytest.mark.parametrize("gain", [0.5, 0.77, 1.3])
def test_gains_are_those_of_the_light(gain):
    """In a light of any gain, rounded to 8 bits, the gain that leads back is 1 / gain, to what rounding does
    to the mean: half a level of it at most.
    """
    first = picture(60, 80) // 2 + 20
    lit = np.rint(first * gain).astype(np.uint8)
    gains = PreparedPair.of(K, lit, lit, np.inf, mean_color(first), P).gains
    np.testing.assert_allclose(gains, 1 / gain, rtol=0.5 / mean_color(lit).min())


def test_without_light_nothing_is_changed(kernels):
    """Without the first frame's light bins are those of the picture's own colors."""
    image = picture(24, 32)
    expected = kernels.color_bins(image, (0, 0, 32, 24), P.color_space, 1)
    np.testing.assert_array_equal(all_bins(kernels, image, None), expected)


@pytest.mark.parametrize("light", [False, True])
@pytest.mark.parametrize("step", [1, 3])
@pytest.mark.parametrize(
    "region", [(-7, -5, 40, 30), (4, 3, 19, 18), (25, 20, 90, 80), (99, 0, 120, 9)], ids=str
)
def test_a_region_is_a_part_of_the_whole(region, step, light, kernels):
    """Bins of a region, over the edge too, are those of the whole picture in that light, and none outside."""
    image = picture(24, 32) // 4
    lit = 2 * image
    pair = PreparedPair.of(K, lit, lit, np.inf, mean_color(image) if light else None, P)
    expected = kernels.color_bins(image if light else lit, region, P.color_space, step)
    np.testing.assert_array_equal(pair.bins(kernels, region, step, P), expected)


@pytest.mark.parametrize("level", [0, 255])
def test_black_and_white_have_finite_gains(level, kernels):
    """A picture without light, or full of it, has finite gains, and one bin everywhere: black stays black."""
    image = np.full((24, 32, 3), level, np.uint8)
    light = mean_color(picture(24, 32))
    assert np.isfinite(PreparedPair.of(K, image, image, np.inf, light, P).gains).all()
    bins = all_bins(kernels, image, light)
    assert (bins == bins[0, 0]).all()
    if level == 0:
        np.testing.assert_array_equal(bins, all_bins(kernels, image, None))


@pytest.mark.parametrize(
    ("width", "resolution", "step"),
    [(160, 160, 1), (640, 160, 4), (320, 160, 2), (200, 160, 1), (100, 160, 1)],
)
def test_cells_are_squares_of_step_pixels(width, resolution, step):
    """A cell has the color of the middle pixel of a square of step by step pixels. About ``resolution`` cells
    lie in a row.
    """
    image = picture(48, width)
    pair = PreparedPair.of(K, image, shifted(image, 3), np.inf, None, Params(resolution=resolution))
    assert pair.step == step
    assert pair.shape == (48 // step, width // step)
    middles = np.ascontiguousarray(image[step // 2 :: step, step // 2 :: step])
    rows, columns = middles.shape[:2]
    region = (0, 0, columns, rows)
    expected = K.color_bins(middles, region, P.color_space, 1)
    np.testing.assert_array_equal(pair.bins(K, region, 1, P), expected)


@pytest.mark.parametrize(("rows", "read"), [(48, slice(None)), (480, slice(4, None, 8))])
def test_some_rows_tell_the_light(rows, read):
    """The mean color is that of about 60 rows, whatever the size of the head."""
    image = picture(rows, 40)
    for width in (5, np.inf):
        pair = PreparedPair.of(K, image, shifted(image, 3), width, None, P)
        np.testing.assert_allclose(pair.mean, image[read].mean(axis=(0, 1)), rtol=1e-12)


@pytest.mark.parametrize(
    ("width", "head_width", "least", "side"),
    [
        (1920, 92.0, 18, 5),
        (1920, 300.0, 18, 12),
        (640, 72.0, 18, 4),
        (640, 71.9, 18, 3),
        (640, 9.0, 18, 1),
        (160, 9.0, 18, 1),
        (1920, 92.0, 0, 12),
    ],
)
def test_cells_are_small_enough_for_the_head(width, head_width, least, side):
    """``min_head_cells`` lie across it unless that takes cells of less than a pixel."""
    p = Params(min_head_cells=least)
    assert cell_side((width // 2, width, 3), head_width, p) == side


@pytest.mark.parametrize("right", ["color", "gray"])
@pytest.mark.parametrize("cells", [False, True])
@pytest.mark.parametrize("ellipse", [False, True])
@pytest.mark.parametrize("limits", [(2, 9), (-3, 2), (-9, -4), (30, 60), (900, 905)], ids=str)
@pytest.mark.parametrize("shape", [(120, 160), (97, 322), (96, 641)], ids=str)
def test_disparities_of_a_region_are_those_of_the_whole_images(shape, limits, ellipse, cells, right):
    """What lies outside a region, its window and its candidates changes no disparity in it: they are those by
    the whole images turned gray, also over the edges and outside of the images.
    """
    image = picture(*shape)
    other = shifted(image, 4) if right == "color" else shifted(image, 4)[..., 1].copy()
    pair = PreparedPair.of(K, image, other, np.inf, None, P)
    side = pair.step if cells else 1
    whole = [K.reduce_gray(each, side) for each in (image, other)]
    height, width = shape[0] // side, shape[1] // side
    matching = (P.window if cells else pair.pixel_window(P)), P.uniqueness, P.prefilter
    for region in (
        (9, 8, 33, 30),
        (-9, -8, 20, 12),
        (width - 20, height - 9, width + 4, height + 7),
        (0, 0, width, height),
        (width + 5, height + 5, width + 9, height + 12),
        (-40, -30, -20, -10),
    ):
        found = pair.disparities(K, region, limits, P, ellipse=ellipse, cells=cells)
        expected = K.sad_disparity(*whole, region, ellipse, limits, matching)
        np.testing.assert_array_equal(found, expected)


def test_the_images_stay_as_they_were():
    """Neither picture is written to."""
    image = picture(48, 64)
    left, right = image.copy(), shifted(image, 2)
    kept = right.copy()
    PreparedPair.of(K, left, right, np.inf, 2 * mean_color(left), P)
    np.testing.assert_array_equal(left, image)
    np.testing.assert_array_equal(right, kept)


@pytest.mark.parametrize(("width", "expected"), [(160, 6.0), (640, 24.0)])
def test_cells_near_a_disparity_are_coherent(width, expected, kernels):
    """Of a picture at one disparity nearly all cells are coherent with it, and hardly any with one of three
    cells more or less.
    """
    image = picture(3 * width // 4, width)
    pair = PreparedPair.of(K, image, shifted(image, round(expected)), np.inf, None, P)
    ellipse = (width / 2, 3 * width / 8, 10.0 * pair.step, 12.0 * pair.step)
    shares = [
        crop_region(kernels, pair, ellipse, expected + off * pair.step, P).coherent.mean()
        for off in (-3, 0, 3)
    ]
    assert shares[1] > 0.95
    assert max(shares[0], shares[2]) < 0.05


@pytest.mark.parametrize("center", [(80.0, 60.0), (0.0, 0.0), (158.0, 3.0), (-400.0, 900.0)], ids=str)
def test_a_region_covers_all_that_the_search_touches(center, kernels):
    """A region reaches over ring and search to every side; its cells outside the image have no bin and no
    depth, those inside the bin of their color.
    """
    image = picture(120, 160)
    pair = PreparedPair.of(K, image, shifted(image, 5), np.inf, None, P)
    x, y = center
    cropped = crop_region(kernels, pair, (x, y, 8.0, 10.0), 5.0, P)
    assert cropped.bins.shape == cropped.coherent.shape
    height, width = cropped.bins.shape
    assert cropped.left <= x - P.ring * 8 - P.search[0]
    assert cropped.top <= y - P.ring * 10 - P.search[1]
    assert cropped.left + width >= x + P.ring * 8 + P.search[0]
    assert cropped.top + height >= y + P.ring * 10 + P.search[1]
    rows, columns = np.mgrid[cropped.top : cropped.top + height, cropped.left : cropped.left + width]
    inside = (rows >= 0) & (rows < 120) & (columns >= 0) & (columns < 160)
    assert (cropped.bins[~inside] == NO_BIN).all()
    assert not cropped.coherent[~inside].any()
    whole = kernels.color_bins(image, (0, 0, 160, 120), P.color_space, 1)
    np.testing.assert_array_equal(cropped.bins[inside], whole[rows[inside], columns[inside]])
