# SPDX-License-Identifier: MIT
"""Overlays: images with a track drawn as box, ellipse, particles, status, score and position."""

import math
from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.arrays import Image
from tricue.camera.box import Box, BoxLike
from tricue.camera.frame import Frame, FrameLike
from tricue.draw.canvas import (
    BLACK,
    STATUS_COLORS,
    WHITE,
    choose_scale,
    draw_box,
    draw_dots,
    draw_ellipse,
    enlarge,
    line_width,
    put_line,
)
from tricue.draw.depth_pictures import depth_picture
from tricue.track.base.track import Track

MIN_ELLIPSE = 24  # widths of a thin line; in a smaller box, an ellipse covers the target
_PARTICLE_COLOR, _TRUTH_COLOR, _OBJECT_COLOR = (255, 190, 60), WHITE, (230, 230, 230)


def overlay(
    image: FrameLike,
    track: Track,
    *,
    particles: ArrayLike | None = None,
    truth: BoxLike | None = None,
    note: str = "",
    ellipse: bool = True,
) -> Image:
    """A copy of an image, BGR (H, W, 3) or gray (H, W), or of a frame's color, with the track in it.

    A small image is enlarged by a whole number. particles: (N, 2 or more), their centers x, y in pixels.
    truth: the true box, drawn thin and white. note: text below the status. ellipse: whether the box's
    inscribed ellipse is drawn, too, unless the box is tiny. A frame of depth alone is drawn by
    :func:`depth_overlay`.
    """
    if isinstance(image, Frame):
        if image.color is None:
            assert image.depth is not None  # a frame has one or the other
            return depth_overlay(image.depth, track, particles=particles, truth=truth, note=note)
        image = image.color
    scale = choose_scale(*image.shape[:2])
    canvas = enlarge(image, scale, cv2.INTER_CUBIC)
    color = STATUS_COLORS[track.status]
    if particles is not None:
        draw_dots(canvas, np.asarray(particles, np.float64), scale, _PARTICLE_COLOR)
    if truth is not None:
        draw_box(canvas, Box(*truth), scale, _TRUTH_COLOR, 1)
    if ellipse and min(track.box[2:]) * scale >= MIN_ELLIPSE * line_width(canvas):
        draw_ellipse(canvas, track.box, scale, color)
    draw_box(canvas, track.box, scale, color, 2)
    _write_track(canvas, track, note)
    return canvas


def depth_overlay(
    depth: NDArray[np.float32],
    track: Track,
    *,
    particles: ArrayLike | None = None,
    objects: Iterable[Box] = (),
    truth: BoxLike | None = None,
    note: str = "",
    near: float | None = None,
    far: float | None = None,
) -> Image:
    """A depth image (H, W), meters, as colors (see :func:`depth_picture`), with the track in it.

    A small image is enlarged by a whole number. particles: (N, 2 or more), their centers x, y in pixels.
    objects: the boxes of the segmented objects, drawn thin and gray. truth: the true box, thin and white.
    note: text below the status. near, far: as in :func:`depth_picture`.
    """
    scale = choose_scale(*depth.shape)
    canvas = enlarge(depth_picture(depth, near, far), scale, cv2.INTER_NEAREST)
    for box in objects:
        draw_box(canvas, box, scale, _OBJECT_COLOR, 1)
    if particles is not None:
        draw_dots(canvas, np.asarray(particles, np.float64), scale, STATUS_COLORS[track.status])
    if truth is not None:
        draw_box(canvas, Box(*truth), scale, _TRUTH_COLOR, 1)
    draw_box(canvas, track.box, scale, BLACK, 5)
    draw_box(canvas, track.box, scale, STATUS_COLORS[track.status], 2)
    _write_track(canvas, track, note)
    return canvas


def _write_track(canvas: Image, track: Track, note: str) -> None:
    """Write status and score, the note, and the position with the standard deviation of its depth."""
    put_line(canvas, f"{track.status}  {track.score:.2f}", 0, STATUS_COLORS[track.status])
    put_line(canvas, note, 1, WHITE)
    if track.position is not None:
        x, y, z = track.position
        deviation = "" if track.covariance is None else f" +- {math.sqrt(max(track.covariance[2, 2], 0)):.3f}"
        put_line(canvas, f"x {x:+.2f}  y {y:+.2f}  z {z:.2f}{deviation} m", 2, WHITE)
