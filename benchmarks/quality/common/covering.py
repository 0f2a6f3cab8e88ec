# SPDX-License-Identifier: MIT
"""Frames in which the target is covered by a copy of what is beside it."""

import math

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.camera.frame import Frame

MARGIN = 0.15
"""Share of the box's width and height that is also covered on each side, as true boxes may be too small."""

Image = NDArray[np.uint8]


def cover(image: Image, box: Box) -> Image:
    """A copy of an image, (H, W) or (H, W, 3), with a box and a margin around it covered.

    The cover is an equally large part of the image to the right, left, below or above: the first of these
    that is in the image, or else the mean color.
    """
    height, width = image.shape[:2]
    left, right = _span(box.x, box.width, width)
    top, bottom = _span(box.y, box.height, height)
    columns, rows = right - left, bottom - top
    covered: Image = image.copy()
    for x, y in ((columns, 0), (-columns, 0), (0, rows), (0, -rows)):
        beside = image[max(top + y, 0) : bottom + y, max(left + x, 0) : right + x]
        if beside.shape[:2] == (rows, columns):
            covered[top:bottom, left:right] = beside
            return covered
    covered[top:bottom, left:right] = image.mean(axis=(0, 1))
    return covered


def cover_target(frame: Frame, box: NDArray[np.float64]) -> Frame:
    """A frame with the color alone, in which a true box, (4,), is covered."""
    assert frame.color is not None, "the frame has color"
    return Frame(cover(frame.color, Box(*box.tolist())))


def _span(start: float, length: float, limit: int) -> tuple[int, int]:
    """The first pixel of a side with its margins, and the one after the last, clipped to the image."""
    margin = MARGIN * length
    first = max(math.floor(start - margin), 0)
    return first, max(min(math.ceil(start + length + margin), limit), first)
