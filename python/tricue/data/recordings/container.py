# SPDX-License-Identifier: MIT
"""Containers of recorded messages: what ROS 1 bags, ROS 2 databases and MCAP files have in common."""

import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple


class Topic(NamedTuple):
    """A topic of a recording.

    type: such as "sensor_msgs/msg/Image", "foxglove.RawImage". encoding: how its messages are encoded:
    "ros1", "cdr", "json", "protobuf". definition: the text that defines the type, "" if the file lacks it.
    idl: whether this text is in OMG IDL, not in ROS's language.
    """

    name: str
    type: str
    encoding: str
    definition: str = ""
    idl: bool = False

    @property
    def kind(self) -> str:
        """The type without its package: "Image", "CompressedImage", "CameraInfo", ..."""
        return re.split(r"[/.:]", self.type)[-1]


class Message(NamedTuple):
    """A message as it was recorded. time: when, in nanoseconds."""

    topic: str
    time: int
    data: bytes


class Container(ABC):
    """Messages by topic, read from the file on demand.

    damage: why part of the file can't be read, "" if all can; it may be found only while reading.
    """

    path: Path
    topics: Mapping[str, Topic]
    damage: str = ""

    @abstractmethod
    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        """The messages of these topics in order of recording time; if the file is damaged, those before the
        damage.

        start: nanoseconds; earlier messages are skipped without reading them all.
        """

    @abstractmethod
    def counts(self) -> dict[str, int]:
        """The number of readable messages, by topic."""


class Chain(Container):
    """The files of one recording, one after the other."""

    def __init__(self, path: Path, parts: list[Container]) -> None:
        self.path, self.parts = path, parts
        self.topics = {name: topic for part in reversed(parts) for name, topic in part.topics.items()}

    @property
    def damage(self) -> str:  # type: ignore[override]  # it is the parts'
        """The first damage in any file."""
        return next((part.damage for part in self.parts if part.damage), "")

    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        for part in self.parts:
            yield from part.messages(names, start)

    def counts(self) -> dict[str, int]:
        total = dict.fromkeys(self.topics, 0)
        for part in self.parts:
            for name, count in part.counts().items():
                total[name] += count
        return total
