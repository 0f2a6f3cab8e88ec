# SPDX-License-Identifier: MIT
"""Masks and blocks of the flow and depth tracker: the target's pixels are tinted, its blocks outlined."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.camera.box import Box
from tricue.draw.canvas import BLACK, STATUS_COLORS, WHITE, Color, to_bgr, to_pixels
from tricue.draw.overlays import overlay
from tricue.track.base.track import Status, Track

Blocks = tuple[tuple[Box, ...], tuple[Box, ...]]
"""The blocks of the target, and the occluded ones."""

TINT_WEIGHT = 0.45  # of the status color in a tinted pixel
BLOCK_PICTURE_SCALE = 4
_WINDOW_COLOR, _OCCLUDED_COLOR = (255, 200, 80), STATUS_COLORS[Status.OCCLUDED]


def flow_depth_overlay(
    image: NDArray[Any],
    track: Track,
    mask: NDArray[np.uint8],
    blocks: Blocks = ((), ()),
    *,
    truth: Box | None = None,
    note: str = "",
) -> Image:
    """:func:`tricue.draw.overlay` with the target's pixels tinted in the color of its status.

    image: BGR (H, W, 3) or gray (H, W). mask: (H, W), above 0 at the target's pixels. blocks: those of the
    target are drawn thin, the occluded ones crossed; their window (section 4.5 of Okada, Shirai and Miura,
    1996) is blue. truth: the true box. note: text below the status. ValueError for a mask of another size.
    """
    if mask.shape != image.shape[:2]:
        raise ValueError(f"mask: expected the image's shape {image.shape[:2]}, got {mask.shape}")
    color = STATUS_COLORS[track.status]
    canvas = overlay(_tinted(image, mask, color), track, truth=truth, note=note, ellipse=False)
    scale = canvas.shape[0] // image.shape[0]
    targets, occluded = blocks
    _draw_blocks(canvas, targets, scale, color, crossed=False)
    _draw_blocks(canvas, occluded, scale, _OCCLUDED_COLOR, crossed=True)
    _draw_window(canvas, (*targets, *occluded), scale, _WINDOW_COLOR, 1)
    return canvas


def block_picture(
    image: NDArray[Any],
    mask: NDArray[np.uint8] | None,
    targets: Sequence[Box] = (),
    occluded: Sequence[Box] = (),
    *,
    window: bool = True,
) -> Image:
    """A frame as in figure 8 of Okada, Shirai and Miura (1996), enlarged.

    The target's pixels are white, its blocks and the occluded ones black (the latter crossed), and their
    window is white, unless ``window=False``. image: BGR (H, W, 3) or gray (H, W). mask: (H, W), above 0 at
    the target's pixels.
    """
    canvas = to_bgr(image).copy()
    if mask is not None:
        canvas[mask > 0] = WHITE
    canvas = np.asarray(
        cv2.resize(
            canvas, None, fx=BLOCK_PICTURE_SCALE, fy=BLOCK_PICTURE_SCALE, interpolation=cv2.INTER_NEAREST
        )
    )
    canvas = canvas.astype(np.uint8, copy=False)
    _draw_blocks(canvas, targets, BLOCK_PICTURE_SCALE, BLACK, crossed=False)
    _draw_blocks(canvas, occluded, BLOCK_PICTURE_SCALE, BLACK, crossed=True)
    if window:
        _draw_window(canvas, (*targets, *occluded), BLOCK_PICTURE_SCALE, WHITE, 3)
    return canvas


def _tinted(image: NDArray[Any], mask: NDArray[np.uint8], color: Color) -> Image:
    canvas = to_bgr(image).copy()
    target = mask > 0
    canvas[target] = ((1 - TINT_WEIGHT) * canvas[target] + TINT_WEIGHT * np.array(color)).astype(np.uint8)
    return np.asarray(canvas, np.uint8)


def _corners(box: Box, scale: int) -> tuple[tuple[int, int], tuple[int, int]]:
    left, top, right, bottom = to_pixels(box.xyxy, scale)
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
