# SPDX-License-Identifier: MIT
"""Pictures and videos of tracks: box, ellipse, particles, status, score, position; depth as color."""

import math
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.box import Box
from tricue.track.base.track import Status, Track

Image = NDArray[np.uint8]
Color = tuple[int, int, int]

STATUS_COLORS: dict[Status, Color] = {  # BGR; apart in lightness too, for eyes that don't tell red from green
    Status.TRACKED: (90, 220, 60),
    Status.OCCLUDED: (0, 160, 250),
    Status.LOST: (80, 60, 255),
}
_PARTICLE, _TRUTH, _INK, _SHADOW = (255, 190, 60), (255, 255, 255), (255, 255, 255), (0, 0, 0)
_OBJECT = (230, 230, 230)
_SHADES = cv2.COLORMAP_CIVIDIS  # even in lightness, also for eyes that don't tell red from green
_READABLE = 480  # rows; smaller pictures are enlarged so that lines and letters stay fine
_FONT = cv2.FONT_HERSHEY_SIMPLEX


def overlay(
    image: NDArray[Any],
    track: Track,
    *,
    particles: ArrayLike | None = None,
    truth: Box | None = None,
    note: str = "",
    ellipse: bool = True,
) -> Image:
    """A copy of the image (BGR or grey) with the track in it; a small one is enlarged by a whole number.

    particles: (N, 2 or more), their centres x, y in pixels. truth: the true box, drawn thin and white.
    ellipse: whether the box's own is drawn, too.
    """
    scale = max(1, _READABLE // image.shape[0])
    canvas = _canvas(image, scale, cv2.INTER_CUBIC)
    color = STATUS_COLORS[track.status]
    if particles is not None:
        _dots(canvas, np.asarray(particles, np.float64), scale, _PARTICLE)
    if truth is not None:
        _rectangle(canvas, truth, scale, _TRUTH, 1)
    if ellipse:
        _ellipse(canvas, track.box, scale, color)
    _rectangle(canvas, track.box, scale, color, 2)
    _words(canvas, track, note)
    return canvas


def depth_overlay(
    depth: NDArray[np.float32],
    track: Track,
    *,
    particles: ArrayLike | None = None,
    objects: Iterable[Box] = (),
    truth: Box | None = None,
    note: str = "",
    near: float | None = None,
    far: float | None = None,
) -> Image:
    """The picture of a depth image, see :func:`depth_picture`, with the track in it; small ones are enlarged.

    particles: (N, 2 or more), their centres x, y in pixels. objects: the boxes of what the frame was
    segmented into, thin and grey. truth: the true box, thin and white.
    """
    scale = max(1, _READABLE // depth.shape[0])
    canvas = _canvas(depth_picture(depth, near, far), scale, cv2.INTER_NEAREST)
    for box in objects:
        _rectangle(canvas, box, scale, _OBJECT, 1)
    if particles is not None:
        _dots(canvas, np.asarray(particles, np.float64), scale, STATUS_COLORS[track.status])
    if truth is not None:
        _rectangle(canvas, truth, scale, _TRUTH, 1)
    _rectangle(canvas, track.box, scale, _SHADOW, 5)
    _rectangle(canvas, track.box, scale, STATUS_COLORS[track.status], 2)
    _words(canvas, track, note)
    return canvas


def depth_picture(depth: NDArray[np.float32], near: float | None = None, far: float | None = None) -> Image:
    """A depth image (H, W), metres, as a BGR picture: near is bright, far is dark, NaN is black.

    near, far: the depths of the brightest and of the darkest shade, metres; without them the 2nd and the 98th
    percentile of the image. ValueError where near isn't below far.
    """
    if near is not None and far is not None and not near < far:
        raise ValueError(f"near, far: expected near below far, metres, got {near} and {far}")
    low, high = depth_range(depth) or (0.0, 1.0)
    low, high = low if near is None else near, high if far is None else far
    with np.errstate(invalid="ignore"):
        closeness = (high - np.asarray(depth, np.float32)) / max(high - low, 1e-6)
    levels = np.nan_to_num(np.clip(closeness, 0, 1) * 255).astype(np.uint8)
    picture = cv2.applyColorMap(levels, _SHADES)
    picture[~np.isfinite(depth)] = 0
    return np.asarray(picture, np.uint8)


def depth_range(depth: NDArray[np.float32]) -> tuple[float, float] | None:
    """The 2nd and the 98th percentile of what was measured, metres; None where nothing was."""
    rows, columns = (max(1, n // 120) for n in depth.shape)  # some ten thousand pixels say it as well as all
    sample = depth[::rows, ::columns]
    measured = sample[np.isfinite(sample)]
    if measured.size == 0:
        measured = depth[np.isfinite(depth)]
    if measured.size == 0:
        return None
    low, high = np.percentile(measured, [2, 98])
    return float(low), float(high)


class OverlayWriter:
    """A video file, .mp4 (mp4v) or .avi (MJPG), of the pictures given to :meth:`write`; use it in ``with``.

    Where OpenCV can't encode mp4v it writes a .avi of the same name instead; ``path`` says which one it is.
    The file is whole once ``with`` is left, by an exception too. The first picture decides the size.
    """

    def __init__(self, path: str | os.PathLike[str], fps: float) -> None:
        self.path, self.fps = Path(path), fps
        self._writer: cv2.VideoWriter | None = None
        if self.path.suffix.lower() not in (".mp4", ".avi"):
            raise ValueError(f"{path}: expected a video file's name that ends in .mp4 or .avi")
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.path.open("wb").close()  # OpenCV doesn't say why it can't write

    def __enter__(self) -> "OverlayWriter":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def write(self, picture: Image) -> None:
        """Append a BGR picture."""
        if self._writer is None:
            self._writer = self._open(picture.shape[1], picture.shape[0])
        self._writer.write(picture)

    def close(self) -> None:
        """Finish the file; an empty one is removed."""
        if self._writer is not None:
            self._writer.release()
        elif self.path.exists() and self.path.stat().st_size == 0:
            self.path.unlink()

    def _open(self, width: int, height: int) -> cv2.VideoWriter:
        names = (
            [self.path] if self.path.suffix.lower() == ".avi" else [self.path, self.path.with_suffix(".avi")]
        )
        for name in names:
            code = cv2.VideoWriter.fourcc(*("MJPG" if name.suffix.lower() == ".avi" else "mp4v"))
            writer = cv2.VideoWriter(str(name), code, self.fps, (width, height))
            if writer.isOpened():
                if name != self.path:
                    self.path.unlink(missing_ok=True)
                self.path = name
                return writer
        raise OSError(f"{self.path}: this OpenCV can write neither mp4v nor MJPG videos")


def letter_size(canvas: Image) -> float:
    """OpenCV's font scale of the words in a picture."""
    return max(0.4, float(canvas.shape[0]) / 800)


def put_text(canvas: Image, words: str, place: tuple[int, int], color: Color) -> None:
    """Write words, outlined, that begin at (x, y), pixels, on their baseline, or sooner to end inside."""
    size = letter_size(canvas)
    (width, _), _ = cv2.getTextSize(words, _FONT, size, 1)
    place = max(0, min(place[0], canvas.shape[1] - width - 2)), place[1]
    # A thick line for the outline would be a bolder, wider font in cv2 5, whose letters lie elsewhere.
    around = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]
    for (dx, dy), ink in [*((step, _SHADOW) for step in around), ((0, 0), color)]:
        cv2.putText(canvas, words, (place[0] + dx, place[1] + dy), _FONT, size, ink, 1, cv2.LINE_AA)


def _canvas(image: NDArray[Any], scale: int, interpolation: int) -> Image:
    color = cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) if image.ndim == 2 else image
    large = (
        cv2.resize(color, None, fx=scale, fy=scale, interpolation=interpolation)
        if scale > 1
        else color.copy()
    )
    return np.asarray(large, np.uint8)


def _whole(numbers: ArrayLike, scale: int) -> list[int]:
    """Scaled and rounded, and kept where OpenCV's integers can hold them."""
    scaled = np.rint(np.asarray(numbers, np.float64) * scale)
    return [int(n) for n in np.clip(scaled, -30000, 30000)]


def _rectangle(canvas: Image, box: Box, scale: int, color: Color, thickness: int) -> None:
    left, top, right, bottom = _whole(box.xyxy, scale)
    cv2.rectangle(canvas, (left, top), (right - 1, bottom - 1), color, thickness, cv2.LINE_AA)


def _ellipse(canvas: Image, box: Box, scale: int, color: Color) -> None:
    x, y, minor, major = _whole(box.ellipse, scale)
    cv2.ellipse(canvas, (x, y), (minor, major), 0, 0, 360, color, 1, cv2.LINE_AA)


def _dots(canvas: Image, particles: NDArray[np.float64], scale: int, color: Color) -> None:
    for x, y in particles[:, :2]:
        cv2.circle(canvas, tuple(_whole((x, y), scale)), 2, color, -1, cv2.LINE_AA)


def _words(canvas: Image, track: Track, note: str) -> None:
    _text(canvas, f"{track.status}  {track.score:.2f}", 0, STATUS_COLORS[track.status])
    _text(canvas, note, 1, _INK)
    if track.position is not None:
        x, y, z = track.position
        sure = "" if track.covariance is None else f" +- {math.sqrt(max(track.covariance[2, 2], 0)):.3f}"
        _text(canvas, f"x {x:+.2f}  y {y:+.2f}  z {z:.2f}{sure} m", 2, _INK)


def _text(canvas: Image, words: str, line: int, color: Color) -> None:
    size = letter_size(canvas)
    put_text(canvas, words, (round(16 * size), round(36 * size * (line + 1))), color)
