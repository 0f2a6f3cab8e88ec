# SPDX-License-Identifier: MIT
"""Pictures of the flow and depth tracker: the target's pixels tinted, its blocks, the window round them."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.draw.overlays import STATUS_COLORS, Color, Image, overlay
from tricue.track.base.track import Status, Track

Blocks = tuple[tuple[Box, ...], tuple[Box, ...]]

TINT = 0.45  # of a target pixel's color
LARGER = 4  # times, of the pictures of figure 8
_BLACK, _WHITE = (0, 0, 0), (255, 255, 255)
_WINDOW, _HIDDEN = (255, 200, 80), STATUS_COLORS[Status.OCCLUDED]
_FAR = 30000  # pixels: what OpenCV's integers can hold


def flow_depth_overlay(
    image: NDArray[Any],
    track: Track,
    mask: NDArray[np.uint8],
    blocks: Blocks = ((), ()),
    *,
    truth: Box | None = None,
    note: str = "",
) -> Image:
    """The image (BGR or grey) with the track in it, see :func:`tricue.draw.overlay`; the target's pixels are
    tinted in the color of its status.

    mask: (H, W) above 0 at the target's pixels. blocks: those of the target, thin, and the occluded ones,
    crossed; round them all is the window of section 4.5, blue. ValueError for a mask of another size.
    """
    if mask.shape != image.shape[:2]:
        raise ValueError(f"mask: expected the image's shape {image.shape[:2]}, got {mask.shape}")
    color = STATUS_COLORS[track.status]
    canvas = overlay(_tinted(image, mask, color), track, truth=truth, note=note, ellipse=False)
    scale = canvas.shape[0] // image.shape[0]
    targets, occluded = blocks
    _draw_blocks(canvas, targets, scale, color, crossed=False)
    _draw_blocks(canvas, occluded, scale, _HIDDEN, crossed=True)
    _draw_window(canvas, (*targets, *occluded), scale, _WINDOW, 1)
    return canvas


def block_picture(
    image: NDArray[Any],
    mask: NDArray[np.uint8] | None,
    targets: Sequence[Box] = (),
    occluded: Sequence[Box] = (),
) -> Image:
    """A frame as in the paper's figure 8, enlarged: target pixels white, target and occluded blocks black,
    here the occluded ones crossed, the window white.
    """
    canvas = _bgr(image).copy()
    if mask is not None:
        canvas[mask > 0] = _WHITE
    canvas = np.asarray(cv2.resize(canvas, None, fx=LARGER, fy=LARGER, interpolation=cv2.INTER_NEAREST))
    canvas = canvas.astype(np.uint8, copy=False)
    _draw_blocks(canvas, targets, LARGER, _BLACK, crossed=False)
    _draw_blocks(canvas, occluded, LARGER, _BLACK, crossed=True)
    _draw_window(canvas, (*targets, *occluded), LARGER, _WHITE, 3)
    return canvas


def _bgr(image: NDArray[Any]) -> Image:
    color = cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) if image.ndim == 2 else image
    return np.asarray(color, np.uint8)


def _tinted(image: NDArray[Any], mask: NDArray[np.uint8], color: Color) -> Image:
    canvas = _bgr(image).copy()
    mine = mask > 0
    canvas[mine] = ((1 - TINT) * canvas[mine] + TINT * np.array(color)).astype(np.uint8)
    return np.asarray(canvas, np.uint8)


def _corners(box: Box, scale: int) -> tuple[tuple[int, int], tuple[int, int]]:
    left, top, right, bottom = (int(n) for n in np.clip(np.rint(np.array(box.xyxy) * scale), -_FAR, _FAR))
    return (left, top), (right - 1, bottom - 1)


def _draw_blocks(canvas: Image, blocks: Sequence[Box], scale: int, color: Color, *, crossed: bool) -> None:
    for box in blocks:
        (left, top), (right, bottom) = _corners(box, scale)
        cv2.rectangle(canvas, (left, top), (right, bottom), color, 1)
        if crossed:
            cv2.line(canvas, (left, top), (right, bottom), color, 1)
            cv2.line(canvas, (left, bottom), (right, top), color, 1)


def _draw_window(canvas: Image, blocks: Sequence[Box], scale: int, color: Color, thickness: int) -> None:
    if not blocks:
        return
    edges = np.array([box.xyxy for box in blocks])
    window = Box.from_xyxy(*edges[:, :2].min(axis=0).tolist(), *edges[:, 2:].max(axis=0).tolist())
    cv2.rectangle(canvas, *_corners(window, scale), color, thickness)
