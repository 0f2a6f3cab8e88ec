# SPDX-License-Identifier: MIT
"""Random access to the frames of any recording: a video, a folder of images, a robot recording."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

from numpy.typing import NDArray

from tricue.app.seekable_video import SeekableVideo
from tricue.camera.frame import Frame
from tricue.data.joint import JointStream
from tricue.data.live import LiveStream
from tricue.data.recordings.recording import Recording as Topics
from tricue.data.recordings.seekable import SeekableChannel, SeekableRecording
from tricue.data.source import Source
from tricue.data.streams import Stream, Video, mean_rate

MAX_UNREADABLE = 30  # consecutive frames, after which a recording counts as broken


class RecordedFrames:
    """A source's frames in any order, with a known number of frames. For one thread at a time.

    fps: frames per second; the mean rate of a video whose rate isn't constant. first: the number of the first
    readable frame.

    ValueError for a live camera, for a source without frames, and if the channels differ in length.
    """

    def __init__(self, source: Source) -> None:
        for stream in source.channels.values():
            if isinstance(stream, LiveStream):
                raise ValueError(f"{source.name}: expected a recording, got a live camera")
        self.source = replace(source, channels=_seekable(source))
        if self.source.length is None:
            raise ValueError(f"{source.name}: expected a recording whose frames can be read in any order")
        self.length: int = self.source.length
        if not self.length:
            raise ValueError(f"{source.name}: expected a recording with frames, this one has none")
        self.first, frame = self._first_readable()
        self.size = _size_of(frame)
        self.fps = self.source.fps
        if isinstance(self.source.clock, SeekableVideo):
            self.fps = mean_rate(self.fps, self.length, self.seconds(self.length - 1))

    def again(self) -> "RecordedFrames":
        """The same recording for another thread."""
        other = object.__new__(RecordedFrames)
        other.source = replace(self.source, channels=_again(self.source))
        other.length, other.fps = self.length, self.fps
        other.first, other.size = self.first, self.size
        return other

    def frame(self, number: int) -> Frame:
        """One frame by its number from 0; ValueError if its size differs from that of the first readable one,
        in whose pixels boxes are.
        """
        frame = self._read(number)
        if (size := _size_of(frame)) != self.size:
            first, here = ("x".join(map(str, each)) for each in (self.size, size))
            raise ValueError(f"frame {number}: expected the first frame's size {first}, got {here} px")
        return frame

    def image_size(self, number: int) -> tuple[int, int]:
        """The size of a frame's image, which may differ from the first one's; the latter's if it can't be
        read.
        """
        with suppress(ValueError):
            return _size_of(self._read(number))
        return self.size

    def _first_readable(self) -> tuple[int, Frame]:
        """The first readable frame with its number; ValueError if there is none among MAX_UNREADABLE."""
        for number in range(min(self.length, MAX_UNREADABLE)):
            with suppress(ValueError):
                return number, self._read(number)
        return 0, self._read(0)  # raises the reason

    def _read(self, number: int) -> Frame:
        return next(iter(self.source.frames([number])))

    def seconds(self, number: int) -> float:
        """The frame's time."""
        clock = self.source.clock
        if self.source.rate is None and isinstance(clock, SeekableVideo):
            return clock.index.seconds[number]
        times = getattr(clock, "times", None)
        if self.source.rate is None and times is not None:
            return float(times[number])
        return number / self.source.fps

    def frames(self, start: int, stop: int) -> Iterator[tuple[int, Frame]]:
        """Frames with their numbers from ``start`` to before ``stop``, backward if that is less.

        Backward, time increases as if the recording were mirrored, because trackers need increasing times.
        Frames that :meth:`frame` refuses are left out; ValueError for the first one, and for MAX_UNREADABLE
        in a row.
        """
        step = 1 if stop > start else -1
        unreadable = 0
        for number in range(start, stop, step):
            try:
                frame = self.frame(number)
            except ValueError:
                unreadable += 1
                if unreadable == MAX_UNREADABLE or number == start:
                    raise
                continue
            unreadable = 0
            yield number, frame if step > 0 else _mirrored(frame, self.seconds(start))


def _size_of(frame: Frame) -> tuple[int, int]:
    height, width = image_of(frame).shape[:2]
    return width, height


def image_of(frame: Frame) -> NDArray[Any]:
    """The image in whose pixels boxes are: color, or depth if there is none."""
    image = frame.depth if frame.color is None else frame.color
    assert image is not None  # a frame has one of the two
    return image


def _seekable(source: Source) -> dict[str, Stream]:
    """The source's channels as streams whose images can be had in any order, if possible."""
    joints: dict[int, SeekableRecording] = {}

    def seekable(stream: Stream) -> Stream:
        if isinstance(stream, Video):
            if stream.place != str(stream.path):
                raise ValueError(f"{stream.place}: expected a file; download the video, and open that")
            return SeekableVideo(stream.path)
        if isinstance(stream, JointStream) and isinstance(stream.joint, Topics):
            joint = joints.setdefault(id(stream.joint), SeekableRecording.of(stream.joint))
            return SeekableChannel(joint, stream.channel)
        return stream

    return {name: seekable(stream) for name, stream in source.channels.items()}


def _again(source: Source) -> dict[str, Stream]:
    """The channels for another thread; channels that are read together stay together."""
    joints: dict[int, SeekableRecording] = {}

    def again(stream: Stream) -> Stream:
        if isinstance(stream, SeekableVideo):
            return stream.again()
        if isinstance(stream, SeekableChannel):
            joint = joints.setdefault(id(stream.joint), stream.joint.again())
            return SeekableChannel(joint, stream.channel)
        return stream

    return {name: again(stream) for name, stream in source.channels.items()}


def _mirrored(frame: Frame, start: float) -> Frame:
    then = None if frame.timestamp is None else 2 * start - frame.timestamp
    return Frame(frame.color, frame.depth, frame.right, then, pose=frame.pose)
