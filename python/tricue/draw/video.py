# SPDX-License-Identifier: MIT
"""Video files of drawn images, which browsers and players show."""

import os
from pathlib import Path
from types import TracebackType

import cv2
import numpy as np

from tricue.arrays import Image
from tricue.doctor.install import install_extra
from tricue.draw.video_encoders import Encoder, OpenCVEncoder, PyAVEncoder, count_packets, ffmpeg_name
from tricue.draw.writable import check_writable

SUFFIXES = (".mp4", ".mkv", ".webm", ".avi")


class OverlayWriter:
    """Writes images to a video file; use it in ``with``.

    .mp4 and .mkv are H.264, .webm is VP9, by PyAV (``tricue[video]``). Without PyAV they become .mp4.webm and
    .mkv.webm, VP8 by OpenCV, and ``note`` says so. .avi is MJPG, by OpenCV. ``path`` is the file written. The
    file is made by the first image, so that one that was there stays without any. It is complete when
    ``with`` is left, also by an exception; if the process is killed, it has what was written up to about a
    second before. The first image sets the size; odd ones get one more row or column.
    fps: frames per second of images without times, and of files that OpenCV writes, where images are repeated
    until the time of the next one. ValueError for another suffix and for a path that isn't UTF-8, OSError if
    the file can't be written.
    """

    def __init__(self, path: str | os.PathLike[str], fps: float) -> None:
        self.path, self.fps, self.note = Path(path), fps, ""
        self._encoder: Encoder | None = None
        self._size = (0, 0)
        check_name(self.path)
        suffix = self.path.suffix.lower()
        self._by_pyav = suffix != ".avi" and PyAVEncoder.available()
        self.path = written_path(self.path)
        if self.path.suffix.lower() != suffix:
            self.note = f"VP8, as H.264 needs PyAV: {install_extra('video')}"
        check_writable(self.path)
        self.path.parent.mkdir(parents=True, exist_ok=True)

    def __enter__(self) -> "OverlayWriter":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        self.close()

    @property
    def about(self) -> str:
        """The file's name, and the note if there is one."""
        return f"{self.path} ({self.note})" if self.note else str(self.path)

    def write(self, picture: Image, seconds: float | None = None) -> None:
        """Append a BGR image (H, W, 3); it is scaled to the size of the first one.

        seconds: its time, increasing from any start, so that the video plays as long as the frames took;
        without it an image is shown for one frame at ``fps``. ValueError for other kinds of images.
        """
        if picture.dtype != np.uint8 or picture.ndim != 3 or picture.shape[2] != 3:
            raise ValueError(f"picture: expected BGR (H, W, 3) uint8, got {picture.dtype} {picture.shape}")
        height, width = picture.shape[:2]
        if height % 2 or width % 2:  # colors are stored for 2x2 pixels
            picture = np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
        if self._encoder is None:
            self._size = picture.shape[1], picture.shape[0]
            self._encoder = self._open(self._size)
        elif picture.shape[1::-1] != self._size:  # OpenCV would skip it
            picture = np.asarray(cv2.resize(picture, self._size, interpolation=cv2.INTER_AREA), np.uint8)
        self._encoder.write(picture, seconds)

    def close(self) -> None:
        """Finish the file; without images there is none."""
        encoder, self._encoder = self._encoder, None
        if encoder is not None:
            encoder.close()
            self._check_whole(encoder.written)

    def _open(self, size: tuple[int, int]) -> Encoder:
        self.path.open("wb").close()  # OpenCV doesn't say why it can't write
        return (PyAVEncoder if self._by_pyav else OpenCVEncoder)(self.path, self.fps, size)

    def _check_whole(self, written: int) -> None:
        """Raise OSError if frames are missing in the file, since OpenCV doesn't report a full disk."""
        if not self.path.exists():
            raise OSError(f"{self.path}: was removed while it was written")
        found = count_frames(self.path)
        if found < written:
            raise OSError(f"{self.path}: only {found} of {written} frames were written; is the disk full?")


def check_name(path: Path) -> None:
    """ValueError for a suffix not in SUFFIXES, and for a path that isn't UTF-8, which crashes OpenCV."""
    if path.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{path}: expected a video file's name that ends in {', '.join(SUFFIXES)}")
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise ValueError(f"{str(path)!a}: expected a video's path in UTF-8; choose another name") from None


def written_path(path: Path) -> Path:
    """The file that :class:`OverlayWriter` writes for a name: o.mp4.webm for o.mp4 where PyAV is missing.

    It isn't o.webm, which may be another video.
    """
    needs_pyav = path.suffix.lower() in (".mp4", ".mkv")
    return path.with_name(f"{path.name}.webm") if needs_pyav and not PyAVEncoder.available() else path


def count_frames(path: Path) -> int:
    """The number of frames of a video file; with PyAV, of its packets.

    Without PyAV it is the number stated in the file, or else that of decodable frames. Some containers only
    imply it by rate and duration, which is right only for a constant rate.
    """
    if PyAVEncoder.available():
        return count_packets(path)
    ffmpeg = cv2.videoio_registry.hasBackend(cv2.CAP_FFMPEG)  # OpenCV's own reader of AVI writes to stderr
    capture = cv2.VideoCapture(ffmpeg_name(path), cv2.CAP_FFMPEG if ffmpeg else cv2.CAP_ANY)
    try:
        if not capture.isOpened():
            return 0
        count = int(capture.get(cv2.CAP_PROP_FRAME_COUNT))
        if count <= 0:
            count = 0
            while capture.grab():
                count += 1
        return count
    finally:
        capture.release()
