# SPDX-License-Identifier: MIT
"""Overlays for stereo pairs: the left image with the track, and an inset with the target's disparity."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import StereoRig
from tricue.draw.canvas import STATUS_COLORS, WHITE, choose_font_scale, put_text, to_gray
from tricue.draw.depth_pictures import depth_picture
from tricue.draw.overlays import overlay
from tricue.track.base.stereo_matching import StereoMatching
from tricue.track.base.track import Track

Disparity = NDArray[np.float32]

SURROUND_SCALE = 1.6  # relative to the target's ellipse; the region whose disparity is shown
DISPARITY_RANGE = 0.3  # on each side of the target's disparity, as a share of it
MIN_DISPARITY_RANGE = 4.0  # pixels
COLUMNS_PER_WINDOW_STEP = 160  # the matching window grows by 2 pixels per this many columns
MATCHING_WINDOW, MAX_MATCHING_WINDOW = 5, 31  # pixels
MATCHING_UNIQUENESS = 10  # percent
MAX_INSET_SHARE = 0.35  # of the image's height and width
INSET_MARGIN = 8  # pixels between the inset and the image's edge
_UNMATCHED_BRIGHTNESS = 0.5


class DisparityPatch(NamedTuple):
    """Disparities (h, w), pixels, of the part of the left image that begins at (left, top).

    They are NaN where nothing was matched.
    """

    left: int
    top: int
    disparity: Disparity
    expected: float  # the target's disparity, from its position


def stereo_overlay(
    frame: Frame, track: Track, rig: StereoRig, *, truth: Box | None = None, note: str = ""
) -> Image:
    """The left image with the track in it (see :func:`tricue.draw.overlay`), and an inset of its disparity.

    The inset shows the target and its surround: near is bright, far is dark, and unmatched pixels show the
    darkened image. Without a position there is no inset. truth: the true box. note: text below the status.
    ValueError for a frame without a stereo pair.
    """
    frame.require("color", "right")
    assert frame.color is not None
    canvas = overlay(frame.color, track, truth=truth, note=note)
    patch = measure_disparity(frame, track, rig)
    if patch is not None:
        scale = canvas.shape[0] / frame.color.shape[0]
        target = Box(*(scale * number for number in track.box))
        _paste(canvas, _inset(frame.color, track, patch, canvas.shape), patch, target)
    return canvas


def measure_disparity(frame: Frame, track: Track, rig: StereoRig) -> DisparityPatch | None:
    """The disparity of a track's target and its surround.

    None if the track has no position or is outside the image. ValueError for a frame without a stereo pair.
    """
    frame.require("color", "right")
    assert frame.color is not None
    assert frame.right is not None
    height, width = frame.color.shape[:2]
    region = _surround(track.box, width, height)
    if region is None or track.position is None or not track.position[2] > 0:
        return None
    expected = rig.intrinsics.fx * rig.baseline / float(track.position[2])
    span = _disparity_range(expected)
    first, last = (min(max(0, round(end)), width) for end in (expected - span, expected + span))
    window = min(
        MATCHING_WINDOW + 2 * (max(1, round(width / COLUMNS_PER_WINDOW_STEP)) - 1), MAX_MATCHING_WINDOW
    )
    pair = to_gray(frame.color), to_gray(frame.right)
    match = kernels.load("native").sad_disparity
    found = match(*pair, region, False, (first, last), StereoMatching(window, MATCHING_UNIQUENESS))
    return DisparityPatch(*region[:2], found, expected)


def _surround(box: Box, width: int, height: int) -> tuple[int, int, int, int] | None:
    """The region x0, y0, x1, y1 of a target's surround, whole pixels; None if it is outside the image."""
    x, y, minor, major = box.ellipse
    part = Box.from_ellipse(x, y, SURROUND_SCALE * minor, SURROUND_SCALE * major).clip(width, height)
    if part.area <= 0:
        return None
    left, top = math.floor(part.x), math.floor(part.y)
    right, bottom = (math.ceil(end) for end in part.xyxy[2:])
    return left, top, right, bottom


def _disparity_range(expected: float) -> float:
    """The searched and shown range on each side of the target's disparity, pixels."""
    return max(DISPARITY_RANGE * expected, MIN_DISPARITY_RANGE)


def _inset(image: NDArray[np.uint8], track: Track, patch: DisparityPatch, shape: tuple[int, ...]) -> Image:
    """The patch as a BGR image that fits into a corner of an image of this shape, with the ellipse."""
    rows, columns = patch.disparity.shape
    scale = MAX_INSET_SHARE * min(shape[0] / rows, shape[1] / columns)
    size = max(1, round(columns * scale)), max(1, round(rows * scale))
    part = image[patch.top : patch.top + rows, patch.left : patch.left + columns]
    picture = np.asarray(
        cv2.resize(_color_patch(to_gray(part), patch), size, interpolation=cv2.INTER_NEAREST)
    )
    x, y, minor, major = track.box.ellipse
    center = round((x - patch.left) * scale), round((y - patch.top) * scale)
    axes = round(minor * scale), round(major * scale)
    cv2.ellipse(picture, center, axes, 0, 0, 360, STATUS_COLORS[track.status], 1, cv2.LINE_AA)
    return picture.astype(np.uint8, copy=False)


def _color_patch(part: Image, patch: DisparityPatch) -> Image:
    """The colors (h, w, 3) of the disparities; unmatched pixels show the darkened gray image."""
    span = _disparity_range(patch.expected)
    # The negative disparity grows with distance, as depth does.
    colors = depth_picture(np.negative(patch.disparity), -patch.expected - span, -patch.expected + span)
    unseen = np.isnan(patch.disparity)
    colors[unseen] = (part[unseen] * _UNMATCHED_BRIGHTNESS).astype(np.uint8)[:, None]
    return colors


def _paste(canvas: Image, inset: Image, patch: DisparityPatch, target: Box) -> None:
    """Paste the inset with a caption into the corner that overlaps the target least.

    The upper left corner isn't used, because it has the text.
    """
    height, width = inset.shape[:2]
    caption = round(32 * choose_font_scale(canvas))
    low, right = canvas.shape[0] - height - caption - INSET_MARGIN, canvas.shape[1] - width - INSET_MARGIN
    corners = (right, low), (INSET_MARGIN, low), (right, INSET_MARGIN)
    left, top = min(corners, key=lambda at: target.iou(Box(at[0], at[1], width, height + caption)))
    left, top = max(min(left, canvas.shape[1] - width), 0), max(min(top, canvas.shape[0] - height), 0)
    canvas[top : top + height, left : left + width] = inset
    cv2.rectangle(canvas, (left - 1, top - 1), (left + width, top + height), WHITE, 1)
    text = f"disparity {patch.expected:.1f} px"
    put_text(canvas, text, (left, top + height + round(0.8 * caption)), WHITE)
