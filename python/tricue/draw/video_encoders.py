# SPDX-License-Identifier: MIT
"""Encoders of video files: PyAV if installed, else OpenCV."""

import importlib
import importlib.util
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

import cv2

from tricue.arrays import Image
from tricue.doctor.install import install_extra

MAX_DENOMINATOR = 1001  # of frames per second, as in 30000/1001
MIN_TICKS = 10_000  # per second, the resolution of frames' times
MAX_STEP_BACK = 1.0  # seconds; a larger one is a clock that was set back, after which times count anew
MAX_STILL = 60.0  # seconds for which OpenCV's encoder repeats an image at most, even if none comes for longer
H264 = ("libx264", {"preset": "veryfast", "crf": "20", "bf": "0"})  # with B-frames fragments begin late
VP9 = ("libvpx-vp9", {"deadline": "realtime", "cpu-used": "8", "row-mt": "1", "crf": "30", "b": "0"})
CODECS = {".mp4": H264, ".mkv": H264, ".webm": VP9}
FOURCC = {".avi": "MJPG", ".webm": "VP80"}


class Encoder(Protocol):
    """Writes BGR images of one even size to a file.

    fps: frames per second of images without times. seconds: an image's time; the first one is the start.
    """

    written: int
    """The number of frames so far."""

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None: ...

    def write(self, picture: Image, seconds: float | None = None) -> None: ...

    def close(self) -> None: ...


def ffmpeg_name(path: Path) -> str:
    """The name by which FFmpeg opens a file: it would take the "T12:" of a relative name for a protocol."""
    return os.path.join(os.curdir, path)  # noqa: PTH118 (Path drops the dot)


class PyAVEncoder:
    """H.264 or VP9, with a key frame at least every second; each second is on the disk once it is encoded.

    Images have their own times. An .mp4 consists of fragments while it grows, so that a truncated one plays.
    At the end it is copied into an ordinary one, in which all players can seek.
    """

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("av") is not None

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None:
        av: Any = importlib.import_module("av")
        self._path, self.written = path, 0
        self._error: Exception | None = None
        suffix = path.suffix.lower()
        codec, options = CODECS[suffix]
        container = {"flush_packets": "1"}
        if suffix == ".mp4":
            container["movflags"] = "frag_keyframe+empty_moov+default_base_moof"
        self._file: Any = av.open(ffmpeg_name(path), "w", options=container)
        rate = max(Fraction(fps).limit_denominator(MAX_DENOMINATOR), Fraction(1, MAX_DENOMINATOR))
        self._stream: Any = self._file.add_stream(codec, rate=rate)
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "yuv420p"
        self._stream.options = {**options, "g": str(max(round(fps), 1))}
        self._ticks = rate.numerator * -(-MIN_TICKS // rate.numerator)  # per second, a whole number per frame
        self._step = int(self._ticks / rate)
        self._stream.codec_context.time_base = Fraction(1, self._ticks)
        self._start = 0.0
        self._time, self._key = -self._step, -self._ticks  # times of the last frame and key frame, ticks
        self._frame = av.VideoFrame
        self._key_frame = av.video.frame.PictureType.I

    def write(self, picture: Image, seconds: float | None = None) -> None:
        with _naming(self._path):
            frame = self._frame.from_ndarray(picture, format="bgr24")
            frame.pts, frame.time_base = self._due(seconds), Fraction(1, self._ticks)
            if frame.pts - self._key >= self._ticks:
                frame.pict_type, self._key = self._key_frame, frame.pts
            self._time = frame.pts
            self._mux(frame)
        self.written += 1

    def close(self) -> None:
        with _naming(self._path), self._file:  # this closes the file
            if self._error is not None:
                raise self._error
            self._mux(None)
        if self._path.suffix.lower() == ".mp4" and self._path.is_file():
            _defragment(self._path)

    def _mux(self, frame: Any) -> None:
        """Encode a frame, None to flush, and write the packets; after an error, as on a full disk, FFmpeg
        would crash in the next packet.
        """
        try:
            self._file.mux(self._stream.encode(frame))
        except Exception as error:
            self._error = error
            raise

    def _due(self, seconds: float | None) -> int:
        """The time to show the next image, ticks from the start; always after the previous one."""
        if seconds is None:
            return self._time + self._step
        if not self.written:
            self._start = seconds
        due = round((seconds - self._start) * self._ticks)
        if due < self._time - MAX_STEP_BACK * self._ticks:
            due = self._time + self._step
            self._start = seconds - due / self._ticks
        return max(self._time + 1, due)


def _defragment(path: Path) -> None:
    """Copy the packets of a fragmented .mp4 into an ordinary one, which replaces it if that succeeds."""
    av: Any = importlib.import_module("av")
    path = path.resolve()  # a link stays a link
    with suppress(OSError):  # such as a full disk; the fragments play, too
        number, name = tempfile.mkstemp(prefix=".tricue-", dir=path.parent)
        os.close(number)
        whole = Path(name)
        try:
            with (
                av.open(ffmpeg_name(path)) as source,
                av.open(ffmpeg_name(whole), "w", format="mp4", options={"movflags": "faststart"}) as copy,
            ):
                video = source.streams.video[0]
                stream = copy.add_stream_from_template(video)
                for packet in source.demux(video):
                    if packet.dts is not None:  # the last one is empty
                        packet.stream = stream
                        copy.mux(packet)
            shutil.copymode(path, whole)
            whole.replace(path)
        finally:
            whole.unlink(missing_ok=True)


def count_packets(path: Path) -> int:
    """The number of packets in a file's video, each a frame, by PyAV, up to where the file can't be read."""
    av: Any = importlib.import_module("av")
    count = 0
    with suppress(av.FFmpegError), av.open(ffmpeg_name(path)) as file:
        for packet in file.demux(video=0) if file.streams.video else ():
            count += packet.size > 0
    return count


class OpenCVEncoder:
    """VP8 in .webm, MJPG in .avi. OSError if this OpenCV can't write it.

    The rate is constant: an image is written at least once and repeated until the time of the next one, at
    most for MAX_STILL.
    """

    def __init__(self, path: Path, fps: float, size: tuple[int, int]) -> None:
        self.written, self._fps = 0, fps
        self._start = 0.0
        self._last: Image | None = None
        code = FOURCC[path.suffix.lower()]
        with _without_stderr():  # OpenCV prints that WebM has no such codes, and writes it
            self._writer = cv2.VideoWriter(ffmpeg_name(path), cv2.VideoWriter.fourcc(*code), fps, size)
        if not self._writer.isOpened():
            path.unlink(missing_ok=True)
            raise OSError(f"{path}: this OpenCV can't write it; PyAV can: {install_extra('video')}")

    def write(self, picture: Image, seconds: float | None = None) -> None:
        if seconds is not None:
            self._repeat_until(seconds)
            self._last = picture.copy()
        self._put(picture)

    def close(self) -> None:
        self._writer.release()

    def _repeat_until(self, seconds: float) -> None:
        """Repeat the last image until the time of the next one."""
        if self._last is None:
            self._start = seconds
            return
        missing = round((seconds - self._start) * self._fps) - self.written
        if missing < -MAX_STEP_BACK * self._fps:
            self._start, missing = seconds - self.written / self._fps, 0
        most = round(MAX_STILL * self._fps)
        for _ in range(min(missing, most)):
            self._put(self._last)
        self._start += max(missing - most, 0) / self._fps  # leave out the rest of a pause

    def _put(self, picture: Image) -> None:
        self._writer.write(picture)
        self.written += 1


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Name the file in PyAV's errors; those of its libraries become OSErrors, as most others are."""
    av: Any = importlib.import_module("av")
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    except av.FFmpegError as error:
        raise OSError(f"{path}: expected a video that the encoder can write, got: {error.strerror}") from None


@contextmanager
def _without_stderr() -> Iterator[None]:
    """Suppress what native code writes to the process's stderr."""
    kept = os.dup(2)
    try:
        with Path(os.devnull).open("wb") as nothing:
            os.dup2(nothing.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
