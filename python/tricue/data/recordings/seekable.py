# SPDX-License-Identifier: MIT
"""Random access to the frames of a robot recording: they are listed first, then read by position."""

from collections import OrderedDict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.data.joint import JointStream, Moment
from tricue.data.recordings.messages import ImageMessage
from tricue.data.recordings.pairing import Timed
from tricue.data.recordings.recording import Recording, Stored

KEPT_BYTES = 128 << 20  # of undecoded images, kept for stepping back
MAX_SKIPPED = 10**9  # nanoseconds; a gap up to this is read through, a larger one needs a seek
BEFORE = 15  # frames read ahead of the wanted one when stepping back, since they are wanted next
DISORDER = 2 * 10**9  # nanoseconds by which messages may be recorded out of order

Key = tuple[str, int, int]
"""Identifies an image: its channel, its time of recording, its index among those of the same time."""


@dataclass(frozen=True)
class FrameList:
    """The times of the frames and the positions of their images, in a few dozen bytes per frame.

    times: (N,) seconds. recorded: (N, C) nanoseconds, when each channel's image was recorded. places: (N, C)
    its index among the images of the same channel and time.
    """

    times: NDArray[np.float64]
    recorded: NDArray[np.int64]
    places: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.times)


def list_frames(recording: Recording) -> FrameList:
    """Pair the recording's images without decoding them, with one image at a time in memory."""
    light = (Timed(each.channel, each.time, each.item[:2]) for each in recording.images())
    paired = list(recording.paired(light))
    clock, channels = recording.clock, list(recording.chosen)
    places = np.array([[each[channel].item for channel in channels] for each in paired], np.int64)
    times = 1e-9 * np.array([each[clock].time for each in paired], np.float64)
    return FrameList(times, places[..., 0], places[..., 1])


class SeekableRecording:
    """A recording whose frames can be read in any order; a joint, see :mod:`tricue.data.joint`.

    The frames are those that :class:`Recording` gives. It reads on from the last frame or seeks to the wanted
    one, and keeps the last images undecoded. For one thread at a time. ValueError names a frame whose image
    is damaged.
    """

    def __init__(self, recording: Recording, frames: FrameList) -> None:
        self.recording, self.frames = recording, frames
        self._kept: OrderedDict[Key, ImageMessage] = OrderedDict()
        self._kept_bytes = 0
        self._images: Iterator[Timed[Stored]] = iter(())
        self._read_to = -1  # the time of recording of the last image read

    @classmethod
    def of(cls, recording: Recording) -> "SeekableRecording":
        """List the frames; ValueError if there are none."""
        return cls(recording, list_frames(recording))

    def again(self) -> "SeekableRecording":
        """The same recording for another thread."""
        return SeekableRecording(self.recording, self.frames)

    @property
    def fps(self) -> float:
        return self.recording.fps

    @property
    def paths(self) -> list[Path]:
        return self.recording.paths

    @property
    def remarks(self) -> tuple[str, ...]:
        return self.recording.remarks

    def size(self, channel: str) -> tuple[int, int]:
        return self.recording.size(channel)

    def count(self) -> int:
        return len(self.frames)

    def moments(self, channels: Sequence[str], indices: Sequence[int] | None = None) -> Iterator[Moment]:
        for number in range(len(self.frames)) if indices is None else indices:
            if not 0 <= number < len(self.frames):
                path, last = self.recording.container.path, len(self.frames) - 1
                raise ValueError(f"{path}: expected frame 0 to {last}, got {number}")
            yield self._moment(number, channels)

    def _moment(self, number: int, channels: Sequence[str]) -> Moment:
        moment = {}
        for channel, image in self._find(number).items():
            if channel in channels:
                seconds = 1e-9 * image.time if image.time else 1e-9 * self._where(number)[channel][0]
                moment[channel] = seconds, self.recording.decode(channel, image)
        return {channel: moment[channel] for channel in channels}

    def _where(self, number: int) -> dict[str, tuple[int, int]]:
        """The time of recording and the index of each channel's image."""
        pairs = zip(self.frames.recorded[number].tolist(), self.frames.places[number].tolist(), strict=True)
        return dict(zip(self.recording.chosen, pairs, strict=True))

    def _find(self, number: int) -> dict[str, ImageMessage]:
        """The images of a frame by channel; ValueError if they can't be read."""
        keys = {channel: (channel, *where) for channel, where in self._where(number).items()}
        found = {key: self._kept[key] for key in keys.values() if key in self._kept}
        if len(found) < len(keys):
            found |= self._read(number, keys.values() - found.keys())
        try:
            return {channel: found[key] for channel, key in keys.items()}
        except KeyError:
            raise ValueError(f"{self.recording.container.path}: frame {number} can't be read") from None

    def _read(self, number: int, missing: set[Key]) -> dict[Key, ImageMessage]:
        """Read on until no image is missing, or none of them can still come; return those found."""
        found: dict[Key, ImageMessage] = {}
        first, last = min(time for _, time, _ in missing), max(time for _, time, _ in missing)
        if not self._read_to < first <= self._read_to + MAX_SKIPPED:
            back = first <= self._read_to
            start = min(self._where(max(0, number - BEFORE * back)).values())[0]
            self._images = self.recording.images(min(start, first))
        for each in self._images:
            key = each.channel, each.item.time, each.item.place
            self._read_to = each.item.time
            self._keep(key, each.item.image)
            if key in missing:
                found[key] = each.item.image
            if len(found) == len(missing) or self._read_to > last + DISORDER:
                return found
        self._read_to = -1  # at the end: it can't read on from here
        return found

    def _keep(self, key: Key, image: ImageMessage) -> None:
        before = self._kept.pop(key, None)
        self._kept_bytes += len(image.data) - (0 if before is None else len(before.data))
        self._kept[key] = image
        fewest = (BEFORE + 1) * len(self.recording.chosen)
        while self._kept_bytes > KEPT_BYTES and len(self._kept) > fewest:
            _, gone = self._kept.popitem(last=False)
            self._kept_bytes -= len(gone.data)


class SeekableChannel(JointStream):
    """A channel of such a recording."""

    joint: SeekableRecording

    @property
    def length(self) -> int:  # type: ignore[override]  # which isn't known of other joints
        return self.joint.count()

    @property
    def times(self) -> NDArray[Any]:
        """The time of each frame, seconds."""
        return self.joint.frames.times
