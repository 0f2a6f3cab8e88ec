# SPDX-License-Identifier: MIT
"""Video files of drawn images."""

import os
from pathlib import Path

import cv2

from tricue.draw.canvas import Image


class OverlayWriter:
    """Writes images to a video file, .mp4 (mp4v) or .avi (MJPG); use it in ``with``.

    Where OpenCV can't encode mp4v, a .avi of the same name is written instead; ``path`` is the file written.
    The file is complete when ``with`` is left, also by an exception. The first image sets the size.
    fps: frames per second. ValueError for another suffix, OSError where the file can't be written.
    """

    def __init__(self, path: str | os.PathLike[str], fps: float) -> None:
        self.path, self.fps = Path(path), fps
        self._writer: cv2.VideoWriter | None = None
        self._written = 0
        if self.path.suffix.lower() not in (".mp4", ".avi"):
            raise ValueError(f"{path}: expected a video file's name that ends in .mp4 or .avi")
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.path.open("wb").close()  # OpenCV doesn't say why it can't write

    def __enter__(self) -> "OverlayWriter":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def write(self, picture: Image) -> None:
        """Append a BGR image (H, W, 3), of the first one's size."""
        if self._writer is None:
            self._writer = self._open(picture.shape[1], picture.shape[0])
        self._writer.write(picture)
        self._written += 1

    def close(self) -> None:
        """Finish the file; without any image it is removed."""
        if self._writer is not None:
            self._writer.release()
            self._check_whole()
        elif self.path.exists() and self.path.stat().st_size == 0:
            self.path.unlink()

    def _check_whole(self) -> None:
        """OSError where frames are missing from the file: OpenCV doesn't tell a full disk."""
        ffmpeg = cv2.videoio_registry.hasBackend(
            cv2.CAP_FFMPEG
        )  # OpenCV's own reader of AVI writes to stderr
        capture = cv2.VideoCapture(str(self.path), cv2.CAP_FFMPEG if ffmpeg else cv2.CAP_ANY)
        found = int(capture.get(cv2.CAP_PROP_FRAME_COUNT)) if capture.isOpened() else 0
        capture.release()
        if found < self._written:
            raise OSError(
                f"{self.path}: only {max(found, 0)} of {self._written} frames were written; is the disk full?"
            )

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
