# SPDX-License-Identifier: MIT
"""That the outline of a head is found where its place is known roughly."""

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, kernels
from tricue.track.head_detection.head_outline import HeadOutline, find_outline

Image = NDArray[np.uint8]
ASPECT = 0.22 / 0.17


def picture(width: float, inside: int = 120, outside: int = 90) -> tuple[Image, Box]:
    """An ellipse as wide as said, of one gray level on another, BGR, and its box."""
    box = Box.from_ellipse(150.3, 120.6, width / 2, width / 2 * ASPECT)
    image = np.full((240, 300, 3), outside, np.uint8)
    shift = 6
    center, axes = (
        tuple(round((value - offset) * 2**shift) for value in pair)
        for pair, offset in ((box.center, 0.5), ((box.width / 2, box.height / 2), 0.0))
    )
    cv2.ellipse(image, center, axes, 0, 0, 360, (inside,) * 3, -1, cv2.LINE_AA, shift)
    return image, box


def moved(box: Box, right: float, down: float, scale: float) -> Box:
    """The box moved by shares of its width and height, and scaled about its middle."""
    (x, y), width, height = box.center, scale * box.width, scale * box.height
    return Box.from_ellipse(x + right * box.width, y + down * box.height, width / 2, height / 2)


def find(image: Image, box: Box) -> HeadOutline:
    """The outline by native kernels."""
    return find_outline(kernels.load("native"), image, box)


@pytest.mark.parametrize("width", [8.0, 20.0, 90.0])
@pytest.mark.parametrize("gray_levels", [(120, 90), (60, 90), (255, 0)])
@pytest.mark.parametrize("shift", [(0.0, 0.0, 1.0), (0.2, -0.15, 1.2), (-0.25, 0.1, 0.85)])
def test_a_box_is_moved_onto_the_outline(
    width: float, gray_levels: tuple[int, int], shift: tuple[float, float, float]
) -> None:
    """It proves that heads of all sizes are found from boxes that are off, brighter and darker than what is
    behind them.
    """
    image, true = picture(width, *gray_levels)
    start = moved(true, *shift)
    outline = find(image, start)
    assert outline.box.iou(true) > 0.8
    assert outline.evidence > 0.5


def test_gray_is_as_color() -> None:
    """It proves that an image without colors gives the same outline in three channels and in one."""
    image, true = picture(30.0)
    start = moved(true, 0.15, 0.1, 1.1)
    assert find(image, start) == find(np.ascontiguousarray(image[..., 0]), start)


def test_edges_that_run_anywhere_are_none() -> None:
    """It proves that noise, however strong, stripes and an even patch have less evidence than a head: noise
    that of the best of many places, and stripes that of the outline's sides.
    """
    _, box = picture(30.0)
    noise = np.random.default_rng(0).integers(0, 256, (240, 300, 3)).astype(np.uint8)
    stripes = np.where(np.arange(300) // 4 % 2, 200, 50).astype(np.uint8) * np.ones((240, 1), np.uint8)
    assert find(cv2.GaussianBlur(noise, (0, 0), 2), box).evidence < 0.4
    assert find(stripes, box).evidence < 0.4
    assert find(np.full((240, 300, 3), 90, np.uint8), box) == HeadOutline(0.0, box)


def test_a_head_at_the_border_is_no_error() -> None:
    """It proves that boxes partly and wholly outside of the image, and images of a pixel, give an outline."""
    image, _ = picture(30.0)
    for box in (Box(-20, -20, 34, 44), Box(290, 230, 34, 44), Box(1000, 1000, 34, 44)):
        assert np.isfinite(find(image, box).evidence)
    assert find(np.zeros((1, 1), np.uint8), Box(0, 0, 17, 22)).evidence == 0.0


def test_both_kernels_find_the_same() -> None:
    """It proves that native kernels and twins give the same outline, bit for bit."""
    image, true = picture(33.0)
    native, reference = (
        find_outline(kernels.load(name), image, moved(true, 0.1, 0.1, 1.1))
        for name in ("native", "reference")
    )
    assert native == reference
