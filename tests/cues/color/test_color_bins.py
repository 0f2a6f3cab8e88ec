# SPDX-License-Identifier: MIT
"""Bins of pixels in the color space (B - G, G - R, B + G + R)."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
NO_BIN = 65535
images = arrays(np.uint8, st.tuples(st.integers(0, 8), st.integers(0, 140), st.just(3)))
regions = st.tuples(*[st.integers(-20, 160)] * 4)
spaces = st.tuples(*[st.integers(1, 40)] * 3)


@given(images, regions, spaces, st.integers(1, 255), st.integers(1, 9))
def test_twin_bins_the_same(
    image: Image, region: tuple[int, int, int, int], bins: tuple[int, int, int], chroma: int, step: int
) -> None:
    """Native and reference agree on any region and step: whole numbers, nothing to round."""
    native = _core.color_bins(image, region, (bins, chroma), step)
    assert_array_equal(native, reference.color_bins(image, region, (bins, chroma), step))


@pytest.mark.parametrize("chroma", [1, 2, 63, 64, 100, 127, 128, 201, 254, 255])
def test_every_level_of_every_axis(chroma: int) -> None:
    """The native kernel's factors in float32 never miss the whole division, whatever level and bins."""
    fall, rise = np.arange(256), np.minimum(np.arange(256) * 2, 255)
    ramps = np.concatenate(
        [np.stack(planes, 1) for planes in ((fall, 0 * fall, 0 * fall), (rise, fall, 255 - fall))]
    )
    ramps = np.concatenate([ramps, ramps[:, ::-1], ramps[:, [1, 0, 2]], ramps[:, [2, 0, 1]]])
    image = ramps.astype(np.uint8)[None]
    for n in range(1, 257):
        for bins in ((n, 1, 1), (1, n, 1), (1, 1, n)):
            arguments = (image, (0, 0, image.shape[1], 1), (bins, chroma), 1)
            assert_array_equal(_core.color_bins(*arguments), reference.color_bins(*arguments))


def test_agrees_with_opencv(kernels: Kernels, picture: Image) -> None:
    """OpenCV's calcHist over the three differences counts as many pixels in each bin."""
    height, width = picture.shape[:2]
    bins = kernels.color_bins(picture, (0, 0, width, height), ((32, 16, 4), 255), 1)
    assert bins.dtype == np.uint16
    assert bins.shape == (height, width)
    if min(picture.shape[:2]) > 1:  # it takes a row of a single pixel for something else
        b, g, r = cv2.split(picture.astype(np.float32))
        ranges = [-255, 255, -255, 255, 0, 766]
        counts = cv2.calcHist(
            [cv2.min(b - g, 254), cv2.min(g - r, 254), b + g + r], [0, 1, 2], None, [32, 16, 4], ranges
        )
        assert_array_equal(np.bincount(bins.ravel(), minlength=32 * 16 * 4), counts.ravel())


@given(images, arrays(np.float64, 3, elements=st.floats(0, 300)), st.integers(1, 9))
def test_twin_takes_the_same_light(image: Image, gains: NDArray[np.float64], step: int) -> None:
    """Native and reference agree in any light: both multiply in float32 and round half to even."""
    arguments = (image, (0, 0, 140, 8), ((32, 32, 4), 64), step, gains)
    assert_array_equal(_core.color_bins(*arguments), reference.color_bins(*arguments))


@pytest.mark.parametrize("step", [1, 3])
def test_light_agrees_with_opencv(kernels: Kernels, step: int) -> None:
    """Bins in another light are those of the image that OpenCV's transform multiplies."""
    image = np.random.default_rng(0).integers(0, 256, (40, 50, 3), np.uint8)
    gains = np.array([0.83, 1.0, 1.37])
    lit = np.asarray(cv2.transform(image, np.diag(gains)), np.uint8)
    region = (-3, 2, 45, 44)
    found = kernels.color_bins(image, region, ((32, 16, 4), 64), step, gains)
    assert_array_equal(found, kernels.color_bins(lit, region, ((32, 16, 4), 64), step))


def test_in_any_brighter_light_black_stays_black(kernels: Kernels) -> None:
    """A gain that float32 doesn't hold makes what isn't black white, and leaves what is."""
    image = np.array([[[0, 0, 0], [0, 1, 0], [1, 1, 1]]], np.uint8)
    found = kernels.color_bins(image, (0, 0, 3, 1), ((32, 16, 4), 255), 1, np.full(3, 1e300))
    assert_array_equal(found, kernels.color_bins(255 * image, (0, 0, 3, 1), ((32, 16, 4), 255), 1))


@pytest.mark.parametrize("gain", [-0.1, np.nan, np.inf])
def test_light_that_is_none_is_refused(kernels: Kernels, gain: float) -> None:
    """Gains are finite and not negative."""
    with pytest.raises(ValueError, match="gains: expected finite numbers, none negative, got"):
        kernels.color_bins(
            np.zeros((2, 2, 3), np.uint8), (0, 0, 2, 2), ((8, 8, 4), 64), 1, np.array([1, gain, 1.0])
        )


def test_example_by_hand(kernels: Kernels) -> None:
    """Gray, blue by 64 and red by 63 over 8 x 8 x 4 bins of ±64: the ends of the axes and their middle."""
    image = np.array(
        [[[0, 0, 0], [255, 255, 255], [164, 100, 100], [100, 100, 163], [99, 100, 100]]], np.uint8
    )
    expected = [4 * 32 + 4 * 4, 4 * 32 + 4 * 4 + 3, 7 * 32 + 4 * 4 + 1, 4 * 32 + 0 + 1, 3 * 32 + 4 * 4 + 1]
    assert_array_equal(kernels.color_bins(image, (0, 0, 5, 1), ((8, 8, 4), 64), 1), [expected])


def test_beyond_an_axis_is_its_end(kernels: Kernels) -> None:
    """Colors of any stronger chroma stay in the end bins."""
    image = np.array([[[200, 100, 0], [255, 100, 0], [255, 101, 1], [180, 100, 20]]], np.uint8)
    bins = kernels.color_bins(image, (0, 0, 4, 1), ((16, 16, 1), 64), 1)
    assert_array_equal(bins, [[255, 255, 255, 255]])


def test_outside_is_no_bin(kernels: Kernels, picture: Image) -> None:
    """A region over every edge is the picture's bins in a frame of no bin."""
    height, width = picture.shape[:2]
    inner = kernels.color_bins(picture, (0, 0, width, height), ((8, 8, 4), 64), 1)
    outer = kernels.color_bins(picture, (-3, -2, width + 5, height + 4), ((8, 8, 4), 64), 1)
    assert_array_equal(outer, np.pad(inner, ((2, 4), (3, 5)), constant_values=NO_BIN))


@pytest.mark.parametrize("step", [2, 3, 8])
@pytest.mark.parametrize("corner", [(0, 0), (-7, -5), (11, 4)])
def test_step_takes_the_middle_of_each_block(
    kernels: Kernels, picture: Image, step: int, corner: tuple[int, int]
) -> None:
    """With a step the bins are every step-th of those without, from half a step on."""
    (x, y), (height, width) = corner, (30, 90)
    width, height = width // step * step, height // step * step
    region = (x, y, x + width, y + height)
    every = kernels.color_bins(picture, region, ((32, 32, 4), 64), 1)
    assert_array_equal(
        kernels.color_bins(picture, region, ((32, 32, 4), 64), step),
        every[step // 2 :: step, step // 2 :: step],
    )


@given(images, st.integers(0, 100))
def test_chroma_is_blind_to_added_light(image: Image, light: int) -> None:
    """The same added to all channels, unless it saturates, leaves the chroma bins as they are."""
    region, dark = (0, 0, image.shape[1], image.shape[0]), image // 2
    lit = dark + np.uint8(light)
    space = (32, 32, 1), 64
    assert_array_equal(_core.color_bins(dark, region, space, 1), _core.color_bins(lit, region, space, 1))


@pytest.mark.parametrize(
    "region", [(5, 5, 5, 9), (9, 0, 3, 9), (20, 20, -5, -5), (2**31 - 1, 0, -(2**31), 3)]
)
def test_empty_regions(kernels: Kernels, region: tuple[int, int, int, int]) -> None:
    """A region without pixels has no bins."""
    assert kernels.color_bins(np.zeros((4, 4, 3), np.uint8), region, ((8, 8, 4), 64), 1).size == 0


def test_far_outside(kernels: Kernels) -> None:
    """A region at the end of what can be counted is outside the picture, as any other."""
    far = 2**31 - 1
    for region in ((far - 2, 0, far, 2), (0, far - 2, 2, far), (-far - 1, -far - 1, -far + 1, -far + 1)):
        bins = kernels.color_bins(np.zeros((4, 4, 3), np.uint8), region, ((8, 8, 4), 64), 1)
        assert_array_equal(bins, np.full((2, 2), NO_BIN))


IMAGE = np.zeros((2, 2, 3), np.uint8)
BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"space": ((0, 8, 4), 64)},
        "bins: expected 1 to 256 on each axis and at most 65535 in all, got .0, 8, 4",
    ),
    ({"space": ((8, 257, 1), 64)}, "bins: expected 1 to 256 on each axis"),
    (
        {"space": ((64, 64, 16), 64)},
        "bins: expected 1 to 256 on each axis and at most 65535 in all, got .64, 64, 16",
    ),
    ({"space": ((2, 2, 2), 0)}, "chroma: expected 1 to 255, got 0"),
    ({"space": ((2, 2, 2), 256)}, "chroma: expected 1 to 255, got 256"),
    ({"step": 0}, "step: expected 1 to 1024, got 0"),
    ({"step": 1025}, "step: expected 1 to 1024, got 1025"),
    ({"region": (0, 0, 32769, 1)}, "region: expected sides of at most 32768 pixels, got 32769"),
    (
        {"region": (-(2**31), 0, 2**31 - 1, 1)},
        "region: expected sides of at most 32768 pixels, got 4294967295",
    ),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values are named."""
    arguments = {"image": IMAGE, "region": (0, 0, 2, 2), "space": ((8, 8, 4), 64), "step": 1} | changes
    with pytest.raises(ValueError, match=message):
        kernels.color_bins(**arguments)


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match="image: expected a uint8 BGR image"):
        _core.color_bins(IMAGE.astype(np.float32), (0, 0, 2, 2), ((8, 8, 4), 64), 1)  # type: ignore[arg-type]
