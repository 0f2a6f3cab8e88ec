# SPDX-License-Identifier: MIT
"""Overlays of several targets, each with its own color and its id."""

from collections.abc import Mapping

import cv2

from tricue.arrays import Image
from tricue.camera.frame import Frame, FrameLike
from tricue.draw.canvas import (
    BLACK,
    WHITE,
    Color,
    choose_font_scale,
    choose_scale,
    draw_box,
    enlarge,
    put_line,
    put_text,
    to_pixels,
)
from tricue.draw.depth_pictures import depth_picture
from tricue.track.base.track import Status, Track

# Okabe and Ito's colors without black, in BGR, distinct for all kinds of color vision; used in a cycle.
TARGET_COLORS: tuple[Color, ...] = (
    (233, 180, 86),
    (0, 159, 230),
    (115, 158, 0),
    (66, 228, 240),
    (167, 121, 204),
    (178, 114, 0),
    (0, 94, 213),
)
THICKNESS = {Status.TRACKED: 2, Status.OCCLUDED: 1, Status.LOST: 1}


def target_color(target: int) -> Color:
    """The color of a target by its id, which counts from 1."""
    return TARGET_COLORS[(target - 1) % len(TARGET_COLORS)]


def targets_overlay(
    image: FrameLike,
    tracks: Mapping[int, Track],
    *,
    note: str = "",
    names: Mapping[int, str] | None = None,
) -> Image:
    """A copy of an image, BGR (H, W, 3) or gray (H, W), or of a frame's color or depth, with the tracks of
    several targets by their ids.

    A small image is enlarged by a whole number. Each box has its target's color and name; occluded or lost
    ones are drawn thin, with their status. note: text in the upper left corner. names: by the ids; the ids
    themselves by default.
    """
    if isinstance(image, Frame):
        if image.color is None:
            assert image.depth is not None  # a frame has one or the other
            image = depth_picture(image.depth)
        else:
            image = image.color
    scale = choose_scale(*image.shape[:2])
    canvas = enlarge(image, scale, cv2.INTER_CUBIC)
    for target, track in tracks.items():
        draw_box(canvas, track.box, scale, BLACK, THICKNESS[track.status] + 2)
        draw_box(canvas, track.box, scale, target_color(target), THICKNESS[track.status])
    for target, track in tracks.items():  # on top of all boxes
        _write_name(canvas, target, (names or {}).get(target, str(target)), track, scale)
    put_line(canvas, note, 0, WHITE)
    return canvas


def _write_name(canvas: Image, target: int, name: str, track: Track, scale: int) -> None:
    """Write a target's name above the box, or in it if there is no room."""
    left, top, _, _ = to_pixels(track.box.xyxy, scale)
    height = round(30 * choose_font_scale(canvas))
    text = name if track.status is Status.TRACKED else f"{name} {track.status}"
    bottom = top - height // 4 if top > height else top + height
    baseline = min(max(bottom, height), canvas.shape[0] - height // 4)
    put_text(canvas, text, (left, baseline), target_color(target))
