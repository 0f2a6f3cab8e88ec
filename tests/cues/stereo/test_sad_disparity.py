# SPDX-License-Identifier: MIT
"""Disparity by block matching."""

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Disparity = NDArray[np.float32]

MATCHING, UNREJECTED = (5, 15, True), (5, 0, True)  # window, uniqueness, prefilter

# name: truth's gray levels per pixel, disparities that StereoBM searches
MIDDLEBURY = {"tsukuba": (16, 16), "venus": (8, 32), "sawtooth": (8, 32), "bull": (8, 32), "cones": (4, 64)}


def case(seed: int, **changes: Any) -> dict[str, Any]:
    """Arguments: pairs of noise, shifted or unlike, some with few gray levels, regions over their edges."""
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(1, 40)), int(rng.integers(1, 90))
    left, right = rng.integers(0, 256, (2, *shape)).astype(np.uint8)
    if rng.random() < 0.6:
        right = np.roll(left, -int(rng.integers(0, 6)), 1)
    if rng.random() < 0.3:
        left, right = left // 64, right // 64
    prefilter = bool(rng.integers(0, 2))
    first = int(rng.integers(-6, 7))
    x, y = int(rng.integers(-12, 90)), int(rng.integers(-12, 40))
    return {
        "left": left,
        "right": right,
        "region": (x, y, x + int(rng.integers(1, 90)), y + int(rng.integers(1, 50))),
        "ellipse": bool(rng.integers(0, 2)),
        "limits": (first, first + int(rng.integers(0, 40))),
        "matching": (
            int(rng.choice([1, 3, 5, 7, 9, 11, 15, *([31] * prefilter)])),
            int(rng.choice([0, 5, 15, 100])),
            prefilter,
        ),
        "tolerance": int(rng.integers(-1, 3)),
    } | changes


def clouds(seed: int, shape: tuple[int, int], blur: float = 1.2) -> Image:
    """A texture without repetition."""
    noise = cv2.GaussianBlur(np.random.default_rng(seed).normal(0, 1, shape), (0, 0), blur)
    return np.asarray((128 + 45 * noise / noise.std()).clip(0, 255).astype(np.uint8))


def shifted_pair(disparity: float, blur: float) -> tuple[Image, Image]:
    """A texture ten times as fine as pixels, seen by two cameras some tenths of a pixel apart."""
    noise = np.random.default_rng(3).normal(0, 1, (80, 2600))
    fine = cv2.GaussianBlur(noise, (0, 0), sigmaX=10 * blur, sigmaY=blur)
    fine = 128 + 45 * fine / fine.std()
    shift = round(10 * disparity)

    def seen(start: int) -> Image:
        means = fine[:, start : start + 2000].reshape(80, 200, 10).mean(axis=2)
        return np.asarray(means.round().clip(0, 255).astype(np.uint8))

    return seen(300), seen(300 + shift)


@settings(max_examples=50)  # the twin is slow
@given(st.integers(0, 2**32))
def test_twin_matches_the_same(seed: int) -> None:
    """Native and reference agree to the last bit: whole costs, and one float32 division and sum."""
    arguments = case(seed)
    native, twin = _core.sad_disparity(**arguments), reference.sad_disparity(**arguments)
    assert_array_equal(native, twin, strict=True)


@pytest.mark.parametrize("width", [1, 7, 8, 9, 16, 17, 31, 32, 33, 63, 64, 65, 97])
@pytest.mark.parametrize("window", [5, 7, 9, 13])
def test_twin_matches_the_same_at_any_width(width: int, window: int) -> None:
    """They also agree on rows that fill registers or nearly do, whether all candidates are in view or not."""
    left, right = clouds(0, (12, 170)), clouds(1, (12, 170))
    last = 40 if window < 9 else 20  # the twin takes each pixel of a window by itself
    for x in (2, 66):
        arguments = (left, right, (x, 3, x + width, 5), False, (1, last), (window, 10, True))
        assert_array_equal(_core.sad_disparity(*arguments), reference.sad_disparity(*arguments))


@pytest.mark.parametrize("prefilter", [True, False])
def test_strided_rows(kernels: Kernels, prefilter: bool) -> None:
    """Padded rows and every second row are read as they look."""
    left, right = clouds(0, (60, 90)), clouds(1, (60, 90))
    for view in (np.s_[5:50, 7:70], np.s_[::2]):
        arguments = ((4, 3, 44, 18), True, (0, 9), (5, 0, prefilter))
        expected = kernels.sad_disparity(left[view].copy(), right[view].copy(), *arguments)
        assert_array_equal(kernels.sad_disparity(left[view], right[view], *arguments), expected)


@pytest.mark.parametrize("shift", [-7, 0, 5, 40])
@pytest.mark.parametrize("prefilter", [True, False])
def test_finds_a_whole_shift(kernels: Kernels, shift: int, prefilter: bool) -> None:
    """Where the right image is the left one moved by d, the cost of d is 0, and no other is."""
    wide = clouds(2, (40, 200))
    left, right = wide[:, 50:150], wide[:, 50 + shift : 150 + shift]
    found = kernels.sad_disparity(left, right, (45, 5, 85, 35), False, (-10, 43), (5, 0, prefilter))
    assert_array_equal(found.round(), np.full((30, 40), shift))


@pytest.mark.parametrize("blur", [1.0, 2.5])
def test_finds_a_fraction(kernels: Kernels, blur: float) -> None:
    """At every tenth of a pixel the median is within 0.05 px: nothing draws it to whole numbers."""
    for tenth in range(10):
        disparity = 4 + tenth / 10
        pair = shifted_pair(disparity, blur)
        found = kernels.sad_disparity(*pair, (20, 10, 180, 70), False, (0, 9), MATCHING)
        assert abs(np.nanmedian(found) - disparity) < 0.05


def test_agrees_with_opencv_step_by_step(kernels: Kernels) -> None:
    """cv2.Sobel, cv2.absdiff and cv2.boxFilter give the costs whose least is found."""
    left, right = clouds(4, (50, 120)), clouds(5, (50, 120))
    slopes = [
        cv2.Sobel(image, cv2.CV_16S, 1, 0, borderType=cv2.BORDER_REPLICATE).clip(-31, 31)
        for image in (left, right)
    ]
    costs = np.stack(
        [
            cv2.boxFilter(
                np.minimum(cv2.absdiff(slopes[0], np.roll(slopes[1], d, 1)), 31).astype(np.float32),
                -1,
                (7, 7),
                normalize=False,
            )
            for d in range(20)
        ]
    )[:, 5:-5, 25:-5]
    found = kernels.sad_disparity(left, right, (25, 5, 115, 45), False, (0, 19), (7, 0, True))
    whole = np.rint(found).astype(int)
    half = np.abs(found - np.floor(found) - 0.5) < 1e-6  # may be rounded either way
    least = np.take_along_axis(costs, whole[None], 0)[0]
    assert half.mean() < 0.05
    assert_array_equal(least[~half], costs.min(axis=0)[~half])


def middlebury(folder: Path, gain: float) -> tuple[Image, Image, Disparity]:
    """Left, right times gain, true disparities with NaN where unknown."""
    names = ("im2.png", "im6.png", "disp2.png")
    left, right, levels = (cv2.imread(str(folder / name), cv2.IMREAD_GRAYSCALE) for name in names)
    truth = levels.astype(np.float32) / MIDDLEBURY[folder.name][0]
    return left, np.round(right * gain).astype(np.uint8), np.where(levels > 0, truth, np.float32(np.nan))


@pytest.mark.parametrize("gain", [1.0, 0.9])
@pytest.mark.parametrize("pair", MIDDLEBURY)
def test_no_worse_than_stereobm(data: Path, pair: str, gain: float) -> None:
    """On all Middlebury pixels that StereoBM computes, in its unit of 1/16 px: mean, and over 1 px."""
    left, right, truth = middlebury(data / "disparity" / pair, gain)
    (height, width), count, window = left.shape, MIDDLEBURY[pair][1], 5
    matcher = cv2.StereoBM_create(count, window)
    matcher.setUniquenessRatio(0)
    matcher.setTextureThreshold(0)
    theirs = matcher.compute(left, right).astype(np.float32) / 16
    limits, matching = (0, count - 1), (window, 0, True)
    ours = _core.sad_disparity(left, right, (0, 0, width, height), False, limits, matching)
    same = (theirs >= 0) & (truth <= count - 2)
    assert same.mean() > 0.6

    def errors(disparity: Disparity) -> Disparity:
        return np.asarray(abs(disparity[same] - truth[same]))

    our_errors, their_errors = errors(np.round(ours * 16) / 16), errors(theirs)
    assert our_errors.mean() <= their_errors.mean()
    assert (our_errors > 1).mean() <= (their_errors > 1).mean()


@given(st.integers(0, 2**32))
def test_every_pixel_stands_for_itself(seed: int) -> None:
    """A pixel's disparity is the same in whatever region it lies: an ellipse and parts cut the whole."""
    changes: dict[str, Any] = {"tolerance": -1}
    whole_case = case(seed, ellipse=False, **changes)
    whole = _core.sad_disparity(**whole_case)
    cut = _core.sad_disparity(**case(seed, ellipse=True, **changes))
    assert_array_equal(cut[~np.isnan(cut)], whole[~np.isnan(cut)])
    x0, y0, x1, y1 = whole_case["region"]
    right, below = (x1 - x0) // 3, (y1 - y0) // 3
    part = (x0 + right, y0 + below, x1 - right, y1 - below)
    small = _core.sad_disparity(**whole_case | {"region": part})
    assert_array_equal(small, whole[below : y1 - y0 - below, right : x1 - x0 - right])


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_a_wide_search_is_that_of_its_parts(seed: int) -> None:
    """Many candidates are compared in strips of columns, whose borders change nothing."""
    rng = np.random.default_rng(seed)
    left = rng.integers(0, 256, (9, 900)).astype(np.uint8) // int(rng.choice([1, 64]))
    right = np.roll(left, -int(rng.integers(0, 700)), 1)
    first, last = int(rng.integers(-900, 100)), int(rng.integers(2500, 3000))
    changes = {"left": left, "right": right, "limits": (first, last), "tolerance": -1}
    arguments = case(seed, **changes, region=(-5, 0, 905, 9), ellipse=False)
    whole = _core.sad_disparity(**arguments)
    edges = range(-5, 905, 70)
    parts = [_core.sad_disparity(**arguments | {"region": (x, 0, x + 70, 9)}) for x in edges]
    assert_array_equal(whole, np.concatenate(parts, axis=1))


def test_the_ellipse_is_inscribed(kernels: Kernels) -> None:
    """Those pixels are measured whose centers lie in it, pi / 4 of them, as many as at the other side."""
    image = clouds(6, (90, 120))
    inside = ~np.isnan(kernels.sad_disparity(image, image, (20, 10, 91, 70), True, (-2, 2), UNREJECTED))
    v, u = np.mgrid[:60, :71] + 0.5
    assert_array_equal(inside, ((u - 35.5) / 35.5) ** 2 + ((v - 30) / 30) ** 2 <= 1)
    assert_array_equal(inside, inside[::-1, ::-1])
    assert abs(inside.mean() - np.pi / 4) < 0.01


@pytest.mark.parametrize("change", [-25, 25])
def test_light_cancels(kernels: Kernels, change: int) -> None:
    """The prefilter takes a constant out: the right image brighter or darker gives the same disparities."""
    left, right = clouds(7, (40, 80)), clouds(8, (40, 80))
    left, right = left // 2 + 60, right // 2 + 60
    other = (right.astype(int) + change).astype(np.uint8)
    arguments = ((10, 0, 80, 40), False, (0, 9))
    expected = kernels.sad_disparity(left, right, *arguments, UNREJECTED)
    assert_array_equal(kernels.sad_disparity(left, other, *arguments, UNREJECTED), expected)
    raw = kernels.sad_disparity(left, other, *arguments, (5, 0, False))
    assert not np.array_equal(raw, kernels.sad_disparity(left, right, *arguments, (5, 0, False)))


def test_checks_only_reject(kernels: Kernels) -> None:
    """More uniqueness and less tolerance leave fewer pixels, and what they leave as it was."""
    left, right = clouds(9, (40, 90)), np.roll(clouds(9, (40, 90)), -4, 1)
    right = (right + np.random.default_rng(0).normal(0, 25, right.shape)).clip(0, 255).astype(np.uint8)
    arguments = (left, right, (20, 0, 90, 40), False, (0, 15))
    every = kernels.sad_disparity(*arguments, (3, 0, True))
    assert not np.isnan(every).any()
    kept = [kernels.sad_disparity(*arguments, (3, u, True)) for u in (0, 5, 20, 60)]
    kept += [kernels.sad_disparity(*arguments, (3, 60, True), t) for t in (5, 1, 0)]
    counts = [np.isfinite(found).sum() for found in kept]
    assert counts == sorted(counts, reverse=True)
    assert len(set(counts)) > 5
    for found in kept:
        assert_array_equal(found[np.isfinite(found)], every[np.isfinite(found)])


def test_ambiguous_texture_is_rejected(kernels: Kernels) -> None:
    """Flat pictures and stripes that repeat have no unique disparity; a column out of view has none."""
    flat = np.full((20, 60), 99, np.uint8)
    stripes = np.tile(np.uint8([0, 40, 90, 150, 120, 60]), (20, 10))
    for image in (flat, stripes):
        arguments = (image, image, (15, 0, 55, 20), False, (0, 12))
        assert np.isnan(kernels.sad_disparity(*arguments, MATCHING)).all()
        assert not np.isnan(kernels.sad_disparity(*arguments, UNREJECTED)).any()
    out_of_view = kernels.sad_disparity(flat, flat, (0, 0, 60, 20), False, (10, 12), UNREJECTED)
    assert_array_equal(np.isnan(out_of_view[0]), np.arange(60) < 10)


def test_left_right_check_rejects_what_is_hidden(kernels: Kernels) -> None:
    """Background that a nearer square hides in the right image claims pixels that fit another better."""
    back, front = clouds(10, (60, 140)), clouds(11, (60, 140))
    left, right = back.copy(), np.roll(back, -2, 1)
    left[15:45, 60:90], right[15:45, 48:78] = front[15:45, 60:90], front[15:45, 60:90]
    found = kernels.sad_disparity(left, right, (30, 0, 130, 60), False, (0, 20), UNREJECTED, 1)
    hidden = np.zeros(found.shape, np.bool_)
    hidden[18:42, 20:30] = True  # columns 50 to 60, of which the right image shows the square
    seen = ~cv2.dilate(hidden.astype(np.uint8), np.ones((9, 9), np.uint8)).astype(bool)
    seen[10:50, 25:65] = False  # windows over the square's edge
    assert np.isnan(found[hidden]).mean() > 0.7
    assert np.isnan(found[seen]).mean() < 0.05


@pytest.mark.parametrize(
    "region", [(200, 0, 205, 5), (-9, 0, 0, 5), (0, 50, 5, 55), (-(2**31), 2**31 - 9, 9 - 2**31, 2**31 - 1)]
)
def test_nothing_to_see(kernels: Kernels, region: tuple[int, int, int, int]) -> None:
    """A region beside the image is all NaN, no error: a head may leave the picture."""
    image = clouds(0, (50, 80))
    found = kernels.sad_disparity(image, image, region, False, (0, 5), MATCHING)
    assert found.shape == (region[3] - region[1], region[2] - region[0])
    assert np.isnan(found).all()


def test_no_candidate_in_view(kernels: Kernels) -> None:
    """Disparities that lead out of the right image for every pixel leave nothing."""
    image = clouds(0, (10, 30))
    for limits in ((30, 40), (-60, -30), (2**31 - 1, 2**31 - 1)):
        assert np.isnan(kernels.sad_disparity(image, image, (0, 0, 30, 10), False, limits, MATCHING)).all()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"left": np.zeros((0, 5), np.uint8)}, "left: expected at least one pixel, got none"),
    ({"right": np.zeros((9, 8), np.uint8)}, r"right: expected the left image's shape \(9, 9\), got \(9, 8\)"),
    ({"region": (0, 0, 0, 4)}, "region: expected a width and height of 1 to 16384, got 0 x 4"),
    ({"region": (0, 1, 4, 0)}, "region: expected a width and height of 1 to 16384, got 4 x -1"),
    ({"region": (0, 0, 16385, 1)}, "region: expected a width and height of 1 to 16384, got 16385 x 1"),
    ({"limits": (6, 5)}, "last: expected at least first, 6, got 5"),
    ({"limits": (0, 4096)}, "last: expected at most 4095 above first, 0, got 4096"),
    ({"matching": (4, 15, True)}, "window: expected an odd number, 1 to 31, got 4"),
    ({"matching": (-1, 15, True)}, "window: expected an odd number, 1 to 31, got -1"),
    ({"matching": (17, 15, False)}, "window: expected an odd number, 1 to 15, got 17"),
    ({"matching": (5, 101, True)}, "uniqueness: expected 0 to 100, got 101"),
    ({"matching": (5, -1, True)}, "uniqueness: expected 0 to 100, got -1"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    image = np.zeros((9, 9), np.uint8)
    good = {"left": image, "right": image, "region": (0, 0, 4, 4), "ellipse": True}
    good |= {"limits": (0, 5), "matching": MATCHING}
    with pytest.raises(ValueError, match=message):
        kernels.sad_disparity(**good | changes)


def test_native_refuses_other_images() -> None:
    """Color, floats and pixels that aren't packed are named, never converted."""
    gray = np.zeros((9, 9), np.uint8)
    rest: tuple[Any, ...] = ((0, 0, 4, 4), True, (0, 5), MATCHING)
    with pytest.raises(ValueError, match="left: expected a uint8 gray image"):
        _core.sad_disparity(np.zeros((9, 9, 3), np.uint8), gray, *rest)
    with pytest.raises(TypeError, match="right: expected a uint8 gray image"):
        _core.sad_disparity(gray, gray.astype(np.float32), *rest)
    with pytest.raises(ValueError, match="right: expected packed pixels"):
        _core.sad_disparity(gray[:, :4], gray[:, ::2][:, :4], *rest)


TOO_LARGE = "expected integers of at most 32 bits in it"


def test_native_refuses_other_tuples() -> None:
    """Limits and matching are tuples of the right size; their numbers are whole and fit 32 bits."""
    gray = np.zeros((9, 9), np.uint8)
    good: dict[str, Any] = {"left": gray, "right": gray, "region": (0, 0, 4, 4), "ellipse": True}
    good |= {"limits": (0, 5), "matching": MATCHING}
    for name, value, error, message in (
        ("limits", [0, 5], TypeError, "incompatible function arguments"),
        ("limits", (0, 5, 1), ValueError, "limits: expected a tuple of 2, got one of 3"),
        ("limits", (0, 5.0), TypeError, "limits: expected an integer in it, got float"),
        ("limits", (0, 2**31), ValueError, f"limits: {TOO_LARGE}"),
        ("limits", (0, 2**64), ValueError, f"limits: {TOO_LARGE}"),
        ("matching", (5, None, True), TypeError, "matching: expected an integer in it, got NoneType"),
        ("matching", (5, 15, 1), TypeError, "matching: expected True or False in it, got int"),
    ):
        with pytest.raises(error, match=message):
            _core.sad_disparity(**good | {name: value})
