# SPDX-License-Identifier: MIT
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue import Box
from tricue.camera.box import as_box
from tricue.errors import BoxError

places = st.floats(-1000, 1000, allow_nan=False)
sizes = st.floats(0.1, 1000)
boxes = st.builds(Box, places, places, sizes, sizes)
whole_boxes = st.builds(Box, *2 * [st.integers(-30, 30)], *2 * [st.integers(1, 40)])


def pixels(box: Box) -> set[tuple[int, int]]:
    """The pixels that a box of whole numbers covers."""
    x, y, width, height = map(int, box)
    return {(i, j) for i in range(y, y + height) for j in range(x, x + width)}


def test_a_box_is_a_tuple() -> None:
    """It proves that a box unpacks, compares and indexes as the tuple (x, y, width, height)."""
    x, y, width, height = Box(1, 2, 3, 4)
    assert (x, y, width, height) == Box(1, 2, 3, 4) == (1, 2, 3, 4)


def test_corners_center_area_ellipse() -> None:
    """It proves the conversions on numbers worked out by hand."""
    box = Box(10, 20, 6, 8)
    assert box.xyxy == (10, 20, 16, 28)
    assert box.center == (13, 24)
    assert box.area == 48
    assert box.ellipse == (13, 24, 3, 4)


@given(boxes)
def test_conversions_come_back(box: Box) -> None:
    """It proves that corners and the inscribed ellipse hold everything that the box holds, up to rounding."""
    assert Box.from_xyxy(*box.xyxy) == pytest.approx(box, abs=1e-9)
    assert Box.from_ellipse(*box.ellipse) == pytest.approx(box, abs=1e-9)


@given(whole_boxes, whole_boxes)
def test_iou_counts_pixels(a: Box, b: Box) -> None:
    """It proves that the overlap of whole boxes is the share of pixels that both cover."""
    assert a.iou(b) == pytest.approx(len(pixels(a) & pixels(b)) / len(pixels(a) | pixels(b)), abs=1e-12)


def test_iou_with_any_four_numbers() -> None:
    """It proves that true boxes in rows of an array need no conversion; NaN is an error."""
    box = Box(0, 0, 4, 4)
    for other in ((2, 0, 4, 4), [2.0, 0.0, 4.0, 4.0], np.array([2, 0, 4, 4]), np.array([2, 0, 4, 4.0])):
        assert box.iou(other) == box.iou(Box(2, 0, 4, 4)) == 1 / 3
    with pytest.raises(BoxError, match=r"^other: expected finite numbers"):
        box.iou(np.full(4, np.nan))
    with pytest.raises(TypeError, match=r"^other: expected four numbers"):
        box.iou(np.zeros((2, 4)))


@given(boxes, boxes)
def test_iou_is_a_symmetric_share(a: Box, b: Box) -> None:
    """It proves that the overlap lies in [0, 1], doesn't depend on the order, and is 1 for the box itself."""
    assert 0 <= a.iou(b) <= 1
    assert a.iou(b) == pytest.approx(b.iou(a), abs=1e-12)
    assert a.iou(a) == pytest.approx(1)


@given(whole_boxes, st.integers(1, 30), st.integers(1, 30))
def test_clip_keeps_the_pixels_inside(box: Box, width: int, height: int) -> None:
    """It proves that clipping leaves exactly the pixels inside the image, none for a box outside."""
    inside = {(i, j) for i, j in pixels(box) if 0 <= i < height and 0 <= j < width}
    clipped = box.clip(width, height)
    assert pixels(clipped) == inside
    assert clipped.area == len(inside)
    assert min(clipped.width, clipped.height) >= 0


@pytest.mark.parametrize(
    ("x", "y", "inside"), [(1, 2, True), (3.9, 5.9, True), (4, 3, False), (2, 6, False), (0.9, 3, False)]
)
def test_contains_is_half_open(x: float, y: float, inside: bool) -> None:
    """It proves that the left and top edges belong to the box and the right and bottom ones don't."""
    assert Box(1, 2, 3, 4).contains(x, y) is inside


@given(boxes)
def test_as_int_is_near_and_never_empty(box: Box) -> None:
    """It proves that whole boxes are Python ints within half a pixel, at least one pixel wide and high."""
    for whole, number in zip(box.as_int(), box, strict=True):
        assert type(whole) is int
        assert abs(whole - number) <= 0.5 or whole == 1
    assert min(box.as_int()[2:]) >= 1


@pytest.mark.parametrize(
    "form",
    [
        tuple,
        list,
        np.array,
        lambda box: np.array(box, np.float32),
        lambda box: np.array(box, np.int32),
        lambda box: tuple(map(np.int64, box)),
        lambda box: np.array([0, *box, 0])[1:5],
        lambda box: Box(*box),
    ],
)
def test_as_box_takes_any_four_numbers(form: Callable[[Any], Any]) -> None:
    """It proves that tuples, lists, arrays of any number type and NumPy scalars become a box of floats."""
    box = as_box(form((1, -2, 30, 40)))
    assert type(box) is Box
    assert box == (1, -2, 30, 40)
    assert all(type(number) is float for number in box)


BAD_TYPES = ["1,2,3,4", None, 5, {1, 2, 3, 4}, (1, 2, "3", 4), (1, 2, True, 4), (1, 2, 3, 4j), object()]
BAD_TYPES += [
    np.zeros((1, 4)),
    np.array(3.0),
    np.array(["1", "2", "3", "4"]),
    np.array([True] * 4),
    [[1, 2, 3, 4]],
]
BAD_VALUES = [
    (),
    (1, 2, 3),
    (1, 2, 3, 4, 5),
    np.zeros(3),
    (0, 0, 0, 0),
    (1, 2, 0, 5),
    (1, 2, 5, 0),
    (1, 2, -3, 4),
]
BAD_VALUES += [
    (math.nan, 2, 3, 4),
    (1, 2, math.inf, 4),
    (-math.inf, 2, 3, 4),
    (1, 2, 1e300, 4),
    (1e7, 2, 3, 4),
]


@pytest.mark.parametrize("box", [(1, 2, 0.25, 3), (1, 2, 3, 0.25)])
def test_a_box_may_be_thinner_than_a_pixel(box: tuple[float, ...]) -> None:
    """It proves that any width and height above 0 will do."""
    assert as_box(box) == box


@pytest.mark.parametrize("value", BAD_TYPES)
def test_as_box_refuses_what_is_no_box(value: Any) -> None:
    """It proves that anything but four numbers is a TypeError with the argument's name."""
    with pytest.raises(TypeError, match=r"^start: expected four numbers \(x, y, width, height\), got "):
        as_box(value, "start")


@pytest.mark.parametrize("value", BAD_VALUES)
def test_as_box_refuses_bad_numbers(value: Any) -> None:
    """It proves that wrong lengths, NaN, infinities, absurd places and empty boxes are ValueErrors."""
    with pytest.raises(ValueError, match=r"^box: expected .*, got "):
        as_box(value)


def test_a_box_dragged_backwards_is_explained() -> None:
    """It proves that the message for a negative size says where such boxes come from."""
    with pytest.raises(ValueError, match="dragged up or left"):
        as_box((50, 60, -20, 30))


@pytest.mark.parametrize("value", [10**400, -(10**400)], ids=["above", "below"])
def test_numbers_beyond_floats_are_infinite(value: int) -> None:
    """It proves that whole numbers that no float holds are refused by name, as infinity is."""
    with pytest.raises(BoxError, match="box: expected finite numbers"):
        as_box((value, 1, 2, 3))
