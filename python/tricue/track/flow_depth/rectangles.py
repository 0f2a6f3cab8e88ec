# SPDX-License-Identifier: MIT
"""Rectangles (x0, y0, x1, y1) in cells, with corners as floats."""

import math

Rectangle = tuple[float, float, float, float]
Region = tuple[int, int, int, int]  # of whole cells, x1 and y1 excluded


def moved(rectangle: Rectangle, right: float, down: float) -> Rectangle:
    """The rectangle, moved."""
    x0, y0, x1, y1 = rectangle
    return x0 + right, y0 + down, x1 + right, y1 + down


def grown(rectangle: Rectangle, across: float, along: float) -> Rectangle:
    """The rectangle, extended by ``across`` on the left and right and by ``along`` above and below."""
    x0, y0, x1, y1 = rectangle
    return x0 - across, y0 - along, x1 + across, y1 + along


def whole(rectangle: Rectangle) -> Rectangle:
    """The rectangle, enlarged to whole cells."""
    x0, y0, x1, y1 = rectangle
    return math.floor(x0), math.floor(y0), math.ceil(x1), math.ceil(y1)


def around(one: Rectangle, other: Rectangle) -> Rectangle:
    """The rectangle around both."""
    (x0, y0, x1, y1), (left, top, right, bottom) = one, other
    return min(x0, left), min(y0, top), max(x1, right), max(y1, bottom)


def contains(region: Region, other: Region) -> bool:
    """Whether all cells of the other region, if any, are in this region."""
    x0, y0, x1, y1 = other
    left, top, right, bottom = region
    return x0 >= x1 or y0 >= y1 or (left <= x0 and top <= y0 and x1 <= right and y1 <= bottom)


def cells_of(rectangle: Rectangle, shape: tuple[int, ...]) -> Region:
    """The whole cells of an image (H, W) that a rectangle touches; may be empty."""
    x0, y0, x1, y1 = rectangle
    height, width = shape
    left, right = _cells_between(x0, x1, width)
    top, bottom = _cells_between(y0, y1, height)
    return left, top, right, bottom


def _cells_between(low: float, high: float, count: int) -> tuple[int, int]:
    """The first of ``count`` cells that an interval touches, and the one after the last."""
    first, end = math.floor(low), math.ceil(high)
    # Comparisons, because calls of min and max are several times slower.
    if first < 0:
        first = 0
    elif first > count:
        first = count
    if end > count:
        end = count
    return (first, end) if end > first else (first, first)
