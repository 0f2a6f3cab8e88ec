# SPDX-License-Identifier: MIT
"""Drawing on images with OpenCV: enlarged copies, boxes, ellipses, dots, text."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.track.base.track import Status

Color = tuple[int, int, int]
"""BGR."""

STATUS_COLORS: dict[Status, Color] = {  # also different in lightness, for red-green color blindness
    Status.TRACKED: (90, 220, 60),
    Status.OCCLUDED: (0, 160, 250),
    Status.LOST: (80, 60, 255),
}
WHITE, BLACK = (255, 255, 255), (0, 0, 0)
MIN_ROWS = 480  # smaller images are enlarged, so that lines and letters look fine
MAX_COLUMNS = 4096  # the limit of this enlargement, because encoders and players reject much wider pictures
LINE_SIDE = 720  # pixels of the shorter side for each pixel of a thin line
MAX_DRAWN_COORDINATE = 30000  # pixels, within OpenCV's integer range
_FONT = cv2.FONT_HERSHEY_SIMPLEX


def to_bgr(image: NDArray[Any]) -> Image:
    """An image, BGR (H, W, 3) or gray (H, W), as BGR; a BGR image itself, not a copy."""
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) if image.ndim == 2 else image, np.uint8)


def to_gray(image: NDArray[Any]) -> Image:
    """An image, BGR (H, W, 3) or gray (H, W), as gray; a gray image itself, not a copy."""
    return np.asarray(image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), np.uint8)


def choose_scale(rows: int, columns: int) -> int:
    """The whole number by which to enlarge an image of this size before drawing on it."""
    return max(1, min(MIN_ROWS // rows, MAX_COLUMNS // columns))


def enlarge(image: NDArray[Any], scale: int, interpolation: int) -> Image:
    """A copy as BGR, enlarged by a whole number. interpolation: one of cv2.INTER_*."""
    color = to_bgr(image)
    large = (
        cv2.resize(color, None, fx=scale, fy=scale, interpolation=interpolation)
        if scale > 1
        else color.copy()
    )
    return np.asarray(large, np.uint8)


def to_pixels(coordinates: ArrayLike, scale: int) -> list[int]:
    """Image coordinates, scaled, rounded, and clipped to OpenCV's integer range."""
    scaled = np.rint(np.asarray(coordinates, np.float64) * scale)
    return [int(n) for n in np.clip(scaled, -MAX_DRAWN_COORDINATE, MAX_DRAWN_COORDINATE)]


def line_width(canvas: Image) -> int:
    """The width of a thin line, pixels; in a large image, 1 pixel can't be seen once it is shown smaller."""
    return max(1, int(min(canvas.shape[:2])) // LINE_SIDE)


def draw_box(canvas: Image, box: Box, scale: int, color: Color, thickness: int) -> None:
    """Outline a box, given in pixels of the image before its enlargement by ``scale``.

    thickness: in widths of a thin line.
    """
    left, top, right, bottom = to_pixels(box.xyxy, scale)
    width = thickness * line_width(canvas)
    cv2.rectangle(canvas, (left, top), (right - 1, bottom - 1), color, width, cv2.LINE_AA)


def draw_ellipse(canvas: Image, box: Box, scale: int, color: Color) -> None:
    """Outline the inscribed ellipse of a box."""
    x, y, minor, major = to_pixels(box.ellipse, scale)
    cv2.ellipse(canvas, (x, y), (minor, major), 0, 0, 360, color, line_width(canvas), cv2.LINE_AA)


def draw_dots(canvas: Image, points: NDArray[np.float64], scale: int, color: Color) -> None:
    """Draw a dot at each of the points (N, 2 or more), with x and y first."""
    radius = 2 * line_width(canvas)
    for x, y in points[:, :2]:
        cv2.circle(canvas, tuple(to_pixels((x, y), scale)), radius, color, -1, cv2.LINE_AA)


def choose_font_scale(canvas: Image) -> float:
    """OpenCV's font scale for text in an image of this size; lines of text fit upright images, too."""
    return max(0.4, float(min(canvas.shape[:2])) / 800)


def put_text(canvas: Image, text: str, position: tuple[int, int], color: Color) -> None:
    """Write outlined text whose baseline begins at (x, y), pixels, or farther left if needed to fit; empty
    text leaves the picture as it is.

    The picture is darkened behind it, so that it can be read on clutter.
    """
    if not text:
        return
    size = choose_font_scale(canvas)
    (width, height), below = cv2.getTextSize(text, _FONT, size, 1)
    x, y = max(0, min(position[0], canvas.shape[1] - width - 2)), position[1]
    plate = canvas[max(y - height - 3, 0) : max(y + below, 0), max(x - 3, 0) : x + width + 3]
    plate[...] = plate // 3
    # A thick line as outline would be a bolder, wider font in cv2 5, with letters at other places.
    around = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]
    for (dx, dy), ink in [*((step, BLACK) for step in around), ((0, 0), color)]:
        cv2.putText(canvas, text, (x + dx, y + dy), _FONT, size, ink, 1, cv2.LINE_AA)


def put_line(canvas: Image, text: str, line: int, color: Color) -> None:
    """Write a line of text in the upper left corner; lines count from 0."""
    size = choose_font_scale(canvas)
    put_text(canvas, text, (round(16 * size), round(36 * size * (line + 1))), color)
