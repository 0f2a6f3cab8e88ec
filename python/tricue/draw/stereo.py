# SPDX-License-Identifier: MIT
"""Pictures of tracks in a stereo pair: the overlay of tricue.draw, and in a corner the target's disparity."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import StereoRig
from tricue.draw.overlays import STATUS_COLORS, Image, depth_picture, letter_size, overlay, put_text
from tricue.track.base.track import Track

Disparity = NDArray[np.float32]

AROUND = 1.6  # ellipses: the surround that is shown with the target
REACH = 0.3  # of the target's disparity, as far as disparities are shown
LEAST_REACH = 4.0  # pixels
RESOLUTION = 160  # columns, of which an image has a step each
WINDOW, WIDEST = 5, 31  # pixels, in an image of that resolution, and at most
UNIQUENESS, NO_CHECK = 10, -1
INSET = 0.35  # of the picture's height, and at most of its width
EDGE = 8  # pixels round the inset
_FRAME, _DARK = (255, 255, 255), 0.5


class Patch(NamedTuple):
    """The disparities (h, w), pixels, of a part of the left image that begins at (left, top); NaN where
    nothing was matched, or beside the image.
    """

    left: int
    top: int
    disparity: Disparity
    expected: float  # the target's, by its position


def stereo_overlay(
    frame: Frame, track: Track, rig: StereoRig, *, truth: Box | None = None, note: str = ""
) -> Image:
    """The left image with the track in it, see :func:`tricue.draw.overlay`, and an inset of the disparity.

    The inset shows the target and its surround: near is bright, far is dark, and where nothing was matched
    the image itself. There is none without a position. ValueError for a frame without a pair.
    """
    frame.require("color", "right")
    assert frame.color is not None
    canvas = overlay(frame.color, track, truth=truth, note=note)
    patch = disparity_round(frame, track, rig)
    if patch is not None:
        scale = canvas.shape[0] / frame.color.shape[0]
        target = Box(*(scale * number for number in track.box))
        _paste(canvas, _inset(frame.color, track, patch, canvas.shape), patch, target)
    return canvas


def disparity_round(frame: Frame, track: Track, rig: StereoRig) -> Patch | None:
    """The disparity where a track is, and round it; None where it has no position or is beside the image.

    ValueError for a frame without a pair.
    """
    frame.require("color", "right")
    assert frame.color is not None
    assert frame.right is not None
    height, width = frame.color.shape[:2]
    region = _surround(track.box, width, height)
    if region is None or track.position is None or not track.position[2] > 0:
        return None
    expected = rig.intrinsics.fx * rig.baseline / float(track.position[2])
    reach = _reach(expected)
    first, last = (min(max(0, round(end)), width) for end in (expected - reach, expected + reach))
    window = min(WINDOW + 2 * (max(1, round(width / RESOLUTION)) - 1), WIDEST)
    pair = _grey(frame.color), _grey(frame.right)
    match = kernels.load("native").sad_disparity
    found = match(*pair, region, False, first, last, window, UNIQUENESS, True, NO_CHECK)
    return Patch(*region[:2], found, expected)


def _surround(box: Box, width: int, height: int) -> tuple[int, int, int, int] | None:
    """x0, y0, x1, y1 of a target's surround, whole pixels of an image; None outside."""
    x, y, minor, major = box.ellipse
    part = Box.from_ellipse(x, y, AROUND * minor, AROUND * major).clip(width, height)
    if part.area <= 0:
        return None
    left, top = math.floor(part.x), math.floor(part.y)
    right, bottom = (math.ceil(end) for end in part.xyxy[2:])
    return left, top, right, bottom


def _reach(expected: float) -> float:
    """How far from the target's disparity others are looked for and shown, pixels."""
    return max(REACH * expected, LEAST_REACH)


def _grey(image: NDArray[np.uint8]) -> Image:
    return np.asarray(image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), np.uint8)


def _inset(image: NDArray[np.uint8], track: Track, patch: Patch, shape: tuple[int, ...]) -> Image:
    """The patch as a picture that fits into a corner of one of a shape."""
    rows, columns = patch.disparity.shape
    scale = INSET * min(shape[0] / rows, shape[1] / columns)
    size = max(1, round(columns * scale)), max(1, round(rows * scale))
    part = image[patch.top : patch.top + rows, patch.left : patch.left + columns]
    picture = np.asarray(cv2.resize(_shades(_grey(part), patch), size, interpolation=cv2.INTER_NEAREST))
    x, y, minor, major = track.box.ellipse
    center = round((x - patch.left) * scale), round((y - patch.top) * scale)
    axes = round(minor * scale), round(major * scale)
    cv2.ellipse(picture, center, axes, 0, 0, 360, STATUS_COLORS[track.status], 1, cv2.LINE_AA)
    return picture.astype(np.uint8, copy=False)


def _shades(part: Image, patch: Patch) -> Image:
    """A color a pixel (h, w, 3): of its disparity; where there is none that of the image, grey and dark."""
    reach = _reach(patch.expected)
    # The less a negative disparity is, the nearer, as with depth.
    shades = depth_picture(np.negative(patch.disparity), -patch.expected - reach, -patch.expected + reach)
    unseen = np.isnan(patch.disparity)
    shades[unseen] = (part[unseen] * _DARK).astype(np.uint8)[:, None]
    return shades


def _paste(canvas: Image, inset: Image, patch: Patch, target: Box) -> None:
    """Into a corner where the target isn't, the words in the upper left one aside; captioned."""
    height, width = inset.shape[:2]
    caption = round(32 * letter_size(canvas))
    low, right = canvas.shape[0] - height - caption - EDGE, canvas.shape[1] - width - EDGE
    corners = (right, low), (EDGE, low), (right, EDGE)
    left, top = min(corners, key=lambda at: target.iou(Box(at[0], at[1], width, height + caption)))
    canvas[top : top + height, left : left + width] = inset
    cv2.rectangle(canvas, (left - 1, top - 1), (left + width, top + height), _FRAME, 1)
    words = f"disparity {patch.expected:.1f} px"
    put_text(canvas, words, (left, top + height + round(0.8 * caption)), _FRAME)
