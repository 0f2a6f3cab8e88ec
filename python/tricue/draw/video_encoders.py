# SPDX-License-Identifier: MIT
"""Encoders of video files: PyAV where it is installed, else OpenCV."""

import importlib
import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

import cv2

from tricue.draw.canvas import Image

MAX_DENOMINATOR = 1001  # of frames per second, as in 30000/1001
H264 = ("libx264", {"preset": "veryfast", "crf": "20"})
VP9 = ("libvpx-vp9", {"deadline": "realtime", "cpu-used": "8", "row-mt": "1", "crf": "30", "b": "0"})
CODECS = {".mp4": H264, ".mkv": H264, ".webm": VP9}
FOURCC = {".avi": "MJPG", ".webm": "VP80"}


class Encoder(Protocol):
    """Writes BGR images of one even size to a file."""

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None: ...

    def write(self, picture: Image) -> None: ...

    def close(self) -> None: ...


class PyAVEncoder:
    """H.264 or VP9, a key frame at least every second, and each second on the disk once it is encoded.

    An .mp4 is made of fragments while it grows, so that one cut off plays, and at its end is copied into an
    ordinary one, so that one can seek in it everywhere.
    """

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("av") is not None

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None:
        av: Any = importlib.import_module("av")
        self._path = path
        suffix = path.suffix.lower()
        codec, options = CODECS[suffix]
        container = {"flush_packets": "1"}
        if suffix == ".mp4":
            container["movflags"] = "frag_keyframe+empty_moov+default_base_moof"
        self._file: Any = av.open(str(path), "w", options=container)
        rate = max(Fraction(fps).limit_denominator(MAX_DENOMINATOR), Fraction(1, MAX_DENOMINATOR))
        self._stream: Any = self._file.add_stream(codec, rate=rate)
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "yuv420p"
        self._stream.options = {**options, "g": str(max(round(fps), 1))}
        self._frame = av.VideoFrame

    def write(self, picture: Image) -> None:
        with _naming(self._path):
            self._file.mux(self._stream.encode(self._frame.from_ndarray(picture, format="bgr24")))

    def close(self) -> None:
        with _naming(self._path), self._file:  # which closes the file
            self._file.mux(self._stream.encode())
        if self._path.suffix.lower() == ".mp4" and self._path.is_file():
            _defragment(self._path)


def _defragment(path: Path) -> None:
    """Copy the packets of a fragmented .mp4 into an ordinary one, which takes its place if that succeeds."""
    av: Any = importlib.import_module("av")
    whole = path.with_name(f"{path.name}.part")
    try:
        with (
            av.open(str(path)) as source,
            av.open(str(whole), "w", format="mp4", options={"movflags": "faststart"}) as copy,
        ):
            video = source.streams.video[0]
            stream = copy.add_stream_from_template(video)
            for packet in source.demux(video):
                if packet.dts is not None:  # the last one is empty
                    packet.stream = stream
                    copy.mux(packet)
        whole.replace(path)
    except OSError:  # such as of a full disk: the fragments play, too
        whole.unlink(missing_ok=True)


class OpenCVEncoder:
    """VP8 in .webm, MJPG in .avi. OSError where this OpenCV can't."""

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None:
        code = FOURCC[path.suffix.lower()]
        with _without_stderr():  # OpenCV says that WebM has no such codes, and writes it
            self._writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*code), fps, size)
        if not self._writer.isOpened():
            path.unlink(missing_ok=True)
            raise OSError(f"{path}: this OpenCV can't write it; PyAV can: pip install 'tricue[video]'")

    def write(self, picture: Image) -> None:
        self._writer.write(picture)

    def close(self) -> None:
        self._writer.release()


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Name the file in an error of PyAV, whose errors are also OSErrors."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


@contextmanager
def _without_stderr() -> Iterator[None]:
    """Leave out what native code writes to the process's stderr."""
    kept = os.dup(2)
    try:
        with Path(os.devnull).open("wb") as nothing:
            os.dup2(nothing.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
