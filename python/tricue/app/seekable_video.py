# SPDX-License-Identifier: MIT
"""Exact random access to the frames of a video file, by seeking to key frames."""

import os
from collections import OrderedDict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import av
import av.error
import numpy as np
from av.video.reformatter import VideoReformatter
from numpy.typing import NDArray

from tricue.data.streams import (
    DEFAULT_FPS,
    FIRST_FRAMES,
    AnyImage,
    FrameTimes,
    checked_fps,
    plausible_fps,
)

KEPT_BYTES = 128 << 20  # of decoded frames, in YUV, kept for stepping and tracking backward
MIN_KEPT = 4  # frames to keep, however large
GUESSED_TIMES = {("avi", "h264"), ("avi", "hevc")}
"""Containers without timestamps for codecs that reorder frames: after a seek FFmpeg guesses them wrong."""


@dataclass(frozen=True)
class VideoIndex:
    """The display times of a video's frames, from its packets.

    times: (N,) int64, ascending, in units of ``unit`` seconds. keys: the numbers of the key frames, the first
    of which is 0. fps: frames per second, as the container states. Without unique times, frames are counted
    from the video's start.
    """

    times: NDArray[np.int64]
    keys: NDArray[np.int64]
    unit: Fraction
    fps: float
    timed: bool

    def key_before(self, number: int) -> int:
        """The number of the last key frame at or before this frame."""
        return int(self.keys[np.searchsorted(self.keys, number, side="right") - 1])

    @cached_property
    def seconds(self) -> list[float]:
        """The times since the first frame, as :class:`tricue.data.streams.Video` gives them."""
        times = FrameTimes(self.fps)
        return [times.add(float(time * self.unit)) for time in self.times.tolist()]


def read_index(path: Path) -> VideoIndex:
    """Read all packets of a video once, without decoding; ValueError if it has no frames."""
    with _opened(path) as container:
        stream = container.streams.video[0]
        packets = [
            (packet.pts, packet.is_keyframe)
            for packet in _packets(container, stream)
            if packet.size and not packet.is_discard
        ]
        unit = stream.time_base or Fraction(1, 1000)
        guessed = (container.format.name, stream.codec_context.name) in GUESSED_TIMES
        fps = plausible_fps(float(stream.average_rate or 0))
    first = next((at for at, (_, is_key) in enumerate(packets) if is_key), len(packets))
    packets = packets[first:]  # nothing before a key frame can be decoded
    if not packets:
        raise ValueError(f"{path}: expected a video, this file has no frame that can be decoded")
    shown = [pts for pts, _ in packets if pts is not None]
    if guessed or len(set(shown)) < len(packets):
        fps = fps or DEFAULT_FPS
        step = 1 / Fraction(fps).limit_denominator(1001)
        return VideoIndex(np.arange(len(packets)), np.zeros(1, np.int64), step, fps, False)
    start = packets[0][0] or 0  # frames shown before the first key frame depend on a missing one
    times = np.array(sorted(pts for pts in shown if pts >= start), np.int64)
    keys = np.array(sorted(pts for pts, is_key in packets if is_key and pts is not None), np.int64)
    fps = checked_fps(fps, [float(time * unit) for time in times[:FIRST_FRAMES].tolist()])
    return VideoIndex(times, np.searchsorted(times, keys), unit, fps or DEFAULT_FPS, True)


class SeekableVideo:
    """A video file whose frames can be read in any order; a stream, see :mod:`tricue.data.streams`.

    The images are those that :class:`tricue.data.streams.Video` gives. It decodes from the key frame before
    the wanted frame, and keeps the last decoded frames. For one thread at a time; :meth:`again` gives one for
    another thread. ValueError names a frame that can't be decoded.
    """

    def __init__(self, path: Path, index: VideoIndex | None = None) -> None:
        self.path = path
        self.index = read_index(path) if index is None else index
        self.fps, self.timed = self.index.fps, self.index.timed
        self._numbers = {int(time): number for number, time in enumerate(self.index.times)}
        self._container: Any = None
        self._reformatter = VideoReformatter()  # one for all, as creating it takes longer than its use
        self._kept: OrderedDict[int, Any] = OrderedDict()
        self._decoded: Iterator[tuple[int, Any]] = iter(())
        self._coming: int | None = None  # the smallest number that may come next

    @property
    def length(self) -> int:
        return len(self.index.times)

    @property
    def size(self) -> tuple[int, int]:
        _, image = next(self.at([0]))
        return image.shape[1], image.shape[0]

    def again(self) -> "SeekableVideo":
        """The same video for another thread."""
        return SeekableVideo(self.path, self.index)

    def __iter__(self) -> Iterator[tuple[float, AnyImage]]:
        return self.at(range(self.length))

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, AnyImage]]:
        for number in indices:
            if not 0 <= number < self.length:
                raise ValueError(f"{self.path}: expected frame 0 to {self.length - 1}, got {number}")
            yield self.index.seconds[number], self._bgr(self._find(number))

    def _bgr(self, frame: Any) -> AnyImage:
        """The frame as BGR, (H, W, 3), upright as a phone held it."""
        image: AnyImage = self._reformatter.reformat(frame, format="bgr24").to_ndarray()
        turns = round(frame.rotation / 90) % 4
        return np.ascontiguousarray(np.rot90(image, turns)) if turns else image

    def _find(self, number: int) -> Any:
        if number not in self._kept and not self._decode_to(number):
            raise ValueError(f"{self.path}: frame {number} can't be decoded")
        return self._kept[number]

    def _decode_to(self, number: int) -> bool:
        """Decode up to the frame; False if the video doesn't have it."""
        key = self.index.key_before(number)
        if self._coming is None or not key <= self._coming <= number:
            self._seek(key)
        for found, frame in self._decoded:
            self._keep(found, frame)
            self._coming = found + 1
            if found >= number:
                break
        else:
            self._coming = None
        return number in self._kept

    def _keep(self, number: int, frame: Any) -> None:
        bytes_each = max(1, frame.width * frame.height * 3 // 2)
        self._kept[number] = frame
        self._kept.move_to_end(number)
        while len(self._kept) > max(MIN_KEPT, KEPT_BYTES // bytes_each):
            self._kept.popitem(last=False)

    def _seek(self, key: int) -> None:
        """Seek to a key frame, or to an earlier one if the file's own index leads past it."""
        while True:
            self._decoded = iter(())  # releases the decoder
            self._decoded = self._numbered(key)
            first = next(self._decoded, None)
            if key == 0 or (first is not None and first[0] <= key):
                break
            key = self.index.key_before(key - 1)
        self._coming = key
        if first is not None:
            self._decoded = _with_first(first, self._decoded)

    def _numbered(self, key: int) -> Iterator[tuple[int, Any]]:
        """Decoded frames with their numbers, from a key frame on."""
        from_start = key == 0 or not self.index.timed  # some containers can't seek there
        if self._container is not None and from_start:
            self._container.close()
            self._container = None
        if self._container is None:
            self._container = _opened(self.path)
            self._container.streams.video[0].thread_type = "AUTO"
        stream = self._container.streams.video[0]
        if not from_start:
            self._container.seek(int(self.index.times[key]), stream=stream, backward=True)
        for count, frame in enumerate(_frames(self._container, stream)):
            number = self._numbers.get(frame.pts) if self.index.timed else count
            if number is not None:
                yield number, frame


def _with_first(first: tuple[int, Any], rest: Iterator[tuple[int, Any]]) -> Iterator[tuple[int, Any]]:
    yield first
    yield from rest


def _opened(path: Path) -> Any:
    """The container of a video file, opened by PyAV; OSError or ValueError names the file."""
    try:
        container = av.open(os.path.join(os.curdir, path))  # noqa: PTH118 (FFmpeg takes a: for a protocol)
    except av.error.FileNotFoundError:
        raise FileNotFoundError(f"{path}: there is no such file") from None
    except (av.error.FFmpegError, UnicodeError):
        raise ValueError(f"{path}: expected a video, this file can't be opened as one") from None
    if not container.streams.video:
        container.close()
        raise ValueError(f"{path}: expected a video, this file has no pictures")
    if container.streams.video[0].codec_context is None:
        container.close()
        raise ValueError(f"{path}: there is no decoder for its codec; convert it to H.264")
    return container


def _packets(container: Any, stream: Any) -> Iterator[Any]:
    """The packets up to where the file is truncated or damaged."""
    try:
        yield from container.demux(stream)
    except av.error.FFmpegError:
        return


def _frames(container: Any, stream: Any) -> Iterator[Any]:
    """The decodable frames; packets that can't be decoded are skipped."""
    packets = container.demux(stream)
    while True:
        try:
            packet = next(packets, None)
            if packet is None:
                return
            decoded = packet.decode()
        except av.error.InvalidDataError:
            continue
        except av.error.FFmpegError:
            return
        yield from decoded
