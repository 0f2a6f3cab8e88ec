# SPDX-License-Identifier: MIT
"""Pictures and videos of tracks: box, ellipse, particles, status, score."""

import os
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.box import Box
from tricue.track.track import Status, Track

Image = NDArray[np.uint8]
Color = tuple[int, int, int]

STATUS_COLORS: dict[Status, Color] = {  # BGR; apart in lightness too, for eyes that don't tell red from green
    Status.TRACKED: (90, 220, 60),
    Status.OCCLUDED: (0, 160, 250),
    Status.LOST: (80, 60, 255),
}
_PARTICLE, _TRUTH, _INK, _SHADOW = (255, 190, 60), (255, 255, 255), (255, 255, 255), (0, 0, 0)
_READABLE = 480  # rows; smaller pictures are enlarged so that lines and letters stay fine
_FONT = cv2.FONT_HERSHEY_SIMPLEX


def overlay(
    image: NDArray[Any],
    track: Track,
    *,
    particles: ArrayLike | None = None,
    truth: Box | None = None,
    note: str = "",
) -> Image:
    """A copy of the image (BGR or grey) with the track drawn in it; a small image is enlarged by a whole number.

    particles: (N, 2 or more), their centres x, y in pixels. truth: the true box, drawn thin and white.
    """
    scale = max(1, _READABLE // image.shape[0])
    canvas = _canvas(image, scale)
    color = STATUS_COLORS[track.status]
    if particles is not None:
        _dots(canvas, np.asarray(particles, np.float64), scale)
    if truth is not None:
        _rectangle(canvas, truth, scale, _TRUTH, 1)
    _ellipse(canvas, track.box, scale, color)
    _rectangle(canvas, track.box, scale, color, 2)
    _text(canvas, f"{track.status}  {track.score:.2f}", 0, color)
    _text(canvas, note, 1, _INK)
    return canvas


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


def _canvas(image: NDArray[Any], scale: int) -> Image:
    color = cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) if image.ndim == 2 else image
    large = (
        cv2.resize(color, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
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


def _dots(canvas: Image, particles: NDArray[np.float64], scale: int) -> None:
    for x, y in particles[:, :2]:
        cv2.circle(canvas, tuple(_whole((x, y), scale)), 2, _PARTICLE, -1, cv2.LINE_AA)


def _text(canvas: Image, words: str, line: int, color: Color) -> None:
    size = max(0.4, canvas.shape[0] / 800)
    place = (round(16 * size), round(36 * size * (line + 1)))
    for ink, thickness in ((_SHADOW, 4), (color, 1)):
        cv2.putText(canvas, words, place, _FONT, size, ink, thickness, cv2.LINE_AA)
