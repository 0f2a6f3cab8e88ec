# SPDX-License-Identifier: MIT
"""Joint streams: channels that are read together, because one recording or device gives all of them."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, Protocol

from numpy.typing import NDArray

from tricue.data.streams import Stream

Moment = dict[str, tuple[float, NDArray[Any]]]
"""By channel: the time in seconds, and the image taken at that time."""


class Joint(Protocol):
    """A reader that gives the images of several channels at once."""

    @property
    def fps(self) -> float:
        """Frames per second."""

    @property
    def paths(self) -> Sequence[Path]:
        """The files that are read; none for a camera."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """Problems found while reading, such as images that were left out; one sentence each."""

    def size(self, channel: str) -> tuple[int, int]:
        """Width and height of the channel's first image, pixels."""

    def moments(self, channels: Sequence[str], indices: Sequence[int] | None = None) -> Iterator[Moment]:
        """The images of these channels, moment by moment.

        indices: numbers, from 0, of the moments to read; by default all. ValueError for an index beyond the
        last moment.
        """

    def count(self) -> int:
        """The number of moments."""


class JointStream:
    """One channel of a joint stream."""

    length = None
    timed = True

    def __init__(self, joint: Joint, channel: str) -> None:
        self.joint, self.channel = joint, channel

    @property
    def fps(self) -> float:
        return self.joint.fps

    @property
    def size(self) -> tuple[int, int]:
        return self.joint.size(self.channel)

    def __iter__(self) -> Iterator[tuple[float, NDArray[Any]]]:
        return (moment[self.channel] for moment in self.joint.moments([self.channel]))

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, NDArray[Any]]]:
        return (moment[self.channel] for moment in self.joint.moments([self.channel], indices))

    def count(self) -> int:
        """The number of images."""
        return self.joint.count()


def common_joint(streams: Iterable[Stream]) -> Joint | None:
    """The joint that all streams are channels of; None if they have none in common."""
    joints = [stream.joint if isinstance(stream, JointStream) else None for stream in streams]
    return joints[0] if joints and all(joint is joints[0] for joint in joints) else None


def joints_of(streams: Iterable[Stream]) -> list[Joint]:
    """The joints of the streams, each once."""
    found: list[Joint] = []
    for stream in streams:
        if isinstance(stream, JointStream) and all(stream.joint is not joint for joint in found):
            found.append(stream.joint)
    return found
