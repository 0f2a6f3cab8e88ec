# SPDX-License-Identifier: MIT
"""Boxes in the image: (x, y, width, height), floats in pixels; x and y are the top-left corner."""

import math
from collections.abc import Sequence
from numbers import Real
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.numbers import to_float
from tricue.errors import BoxError

BoxLike = Sequence[float] | NDArray[Any]
MAX_COORDINATE = 1e6  # pixels: far larger than any image, and far too small to overflow a kernel's integers


class Box(NamedTuple):
    """A rectangle over [x, x + width) by [y, y + height), in pixels; it may extend beyond the image.

    It unpacks and compares like the tuple ``(x, y, width, height)``. The pixel in row i and column j covers
    [j, j + 1) by [i, i + 1). The constructor checks nothing; :func:`as_box` checks what users pass.
    """

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def from_xyxy(cls, left: float, top: float, right: float, bottom: float) -> "Box":
        """The box between two opposite corners, pixels."""
        return cls(left, top, right - left, bottom - top)

    @classmethod
    def from_ellipse(cls, x: float, y: float, minor: float, major: float) -> "Box":
        """The bounding box of an upright ellipse: center (x, y), semi-axes minor along x, major along y."""
        return cls(x - minor, y - major, 2 * minor, 2 * major)

    @property
    def ellipse(self) -> tuple[float, float, float, float]:
        """The inscribed ellipse (x, y, minor, major): its center, and its semi-axes along x and y."""
        return (*self.center, self.width / 2, self.height / 2)

    @property
    def xyxy(self) -> tuple[float, float, float, float]:
        """The corners: (left, top, right, bottom)."""
        return self.x, self.y, self.x + self.width, self.y + self.height

    @property
    def center(self) -> tuple[float, float]:
        """The center (x, y)."""
        return self.x + self.width / 2, self.y + self.height / 2

    @property
    def area(self) -> float:
        """The area in square pixels."""
        return self.width * self.height

    def as_int(self) -> tuple[int, int, int, int]:
        """(x, y, width, height) in whole pixels, as OpenCV needs; at least one pixel wide and high."""
        return round(self.x), round(self.y), max(1, round(self.width)), max(1, round(self.height))

    def contains(self, x: float, y: float) -> bool:
        """Whether a point is inside; the right and bottom edges aren't."""
        return self.x <= x < self.x + self.width and self.y <= y < self.y + self.height

    def clip(self, width: float, height: float) -> "Box":
        """The part inside an image of this size; its area is 0 if nothing of the box is inside."""
        left, top, right, bottom = self.xyxy
        x, y = min(max(left, 0.0), width), min(max(top, 0.0), height)
        return Box(x, y, max(min(right, width) - x, 0.0), max(min(bottom, height) - y, 0.0))

    def iou(self, other: "BoxLike") -> float:
        """Intersection over union, in [0, 1], with another box, also a tuple or a row of an array."""
        box = other if isinstance(other, Box) else as_box(other, "other")
        shared = shared_area(self, box)
        if shared == 0:
            return 0.0
        # With large coordinates, rounding may make the intersection slightly larger than the union.
        return min(1.0, shared / (self.area + box.area - shared))

    def _repr_html_(self) -> str:
        from tricue.notebook.tracks import box_html

        return box_html(self)


def shared_area(box: Box, other: Box) -> float:
    """The area of the intersection, square pixels."""
    wide = min(box.x + box.width, other.x + other.width) - max(box.x, other.x)
    high = min(box.y + box.height, other.y + other.height) - max(box.y, other.y)
    return 0.0 if wide <= 0 or high <= 0 else wide * high


def as_box(value: BoxLike, name: str = "box") -> Box:
    """A checked :class:`Box` from any sequence or array of four numbers (x, y, width, height).

    Raises TypeError for anything but four numbers, and ValueError for NaN, infinity, coordinates beyond a
    million pixels, and a width or height that isn't above 0. Messages name the argument as ``name``.
    """
    box = Box(*_four_numbers(value, name))
    if not all(-MAX_COORDINATE <= number <= MAX_COORDINATE for number in box):
        expected = "at most a million pixels" if all(map(math.isfinite, box)) else "finite numbers"
        raise BoxError(f"{name}: expected {expected}, got {tuple(box)}")
    if not (box.width > 0 and box.height > 0):
        dragged = name == "box" and min(box.width, box.height) < 0  # by a person, not by a tracker
        hint = "; a box dragged up or left has its corners swapped" if dragged else ""
        raise BoxError(f"{name}: expected width and height above 0, got {tuple(box)}{hint}")
    return box


def _four_numbers(value: Any, name: str) -> tuple[float, ...]:
    numbers = value.tolist() if isinstance(value, np.ndarray) and value.ndim == 1 else value
    wrong = f"{name}: expected four numbers (x, y, width, height), got {_describe(value)}"
    if not isinstance(numbers, (tuple, list)) or not all(map(_is_number, numbers)):
        raise TypeError(wrong)
    if len(numbers) != 4:
        raise ValueError(wrong)
    return tuple(map(to_float, numbers))


def _is_number(value: object) -> bool:
    kind = type(value)
    return kind is float or kind is int or (isinstance(value, Real) and kind is not bool)


def _describe(value: object) -> str:
    return f"an array of shape {value.shape}" if isinstance(value, np.ndarray) else f"{value!r:.80}"
