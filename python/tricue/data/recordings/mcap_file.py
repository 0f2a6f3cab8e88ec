# SPDX-License-Identifier: MIT
"""MCAP files, by the library mcap: indexed, or, where the index is missing, from the start to the end."""

import struct
from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from tricue.data.recordings.container import EXTRA, Container, Message, Topic


class McapFile(Container):
    """An MCAP file; one without a summary, such as one cut off, is read once to find its topics."""

    def __init__(self, path: Path) -> None:
        mcap = _library(path)
        self.path = path
        self._broken: tuple[type[Exception], ...] = (
            *(mcap.McapError, _zstd_error(), struct.error, EOFError, RuntimeError, ValueError),
            *(KeyError, MemoryError, OverflowError),  # numbers of channels and lengths that can't be
        )
        with path.open("rb") as file:
            try:
                reader = mcap.make_reader(file)
            except (mcap.McapError, struct.error):
                raise ValueError(f"{path}: expected an MCAP file, this file isn't one") from None
            try:
                self._summary = reader.get_summary()
            except self._broken:
                self._summary = None
        self._counts: Counter[str] = Counter()
        if self._summary is None or self._summary.statistics is None or not self._summary.channels:
            self._summary = None
            self._scan()
        else:
            self.topics = _topics(self._summary.channels.values(), self._summary.schemas)
            counts = self._summary.statistics.channel_message_counts
            for number, channel in self._summary.channels.items():
                self._counts[channel.topic] += counts.get(number, 0)

    def messages(self, names: Collection[str]) -> Iterator[Message]:
        try:
            if self._summary is not None and self._summary.chunk_indexes:
                yield from self._indexed(names)
            else:
                yield from self._in_order(names)
        except self._broken as error:
            self.damage = self.damage or f"it is damaged: {error or type(error).__name__}"

    def counts(self) -> dict[str, int]:
        return {name: self._counts[name] for name in self.topics}

    def _indexed(self, names: Collection[str]) -> Iterator[Message]:
        with self.path.open("rb") as file:
            reader = _library(self.path).make_reader(file, validate_crcs=True)
            for _, channel, message in reader.iter_messages(topics=list(names)):
                yield Message(channel.topic, message.log_time, message.data)

    def _in_order(self, names: Collection[str]) -> Iterator[Message]:
        channels: dict[int, str] = {}
        for record in self._records():
            if hasattr(record, "message_encoding"):
                channels[record.id] = record.topic
            elif hasattr(record, "log_time") and channels.get(record.channel_id) in names:
                yield Message(channels[record.channel_id], record.log_time, record.data)

    def _records(self) -> Iterator[Any]:
        mcap = _library(self.path)
        with self.path.open("rb") as file:
            for record in mcap.StreamReader(file, validate_crcs=True).records:
                if isinstance(record, mcap.Schema | mcap.Channel | mcap.Message):
                    yield record

    def _scan(self) -> None:
        schemas: dict[int, Any] = {}
        channels: dict[int, Any] = {}
        try:
            for record in self._records():
                if hasattr(record, "message_encoding"):
                    channels[record.id] = record
                elif hasattr(record, "log_time"):
                    self._counts[channels[record.channel_id].topic] += 1
                else:
                    schemas[record.id] = record
        except self._broken:
            self.damage = "it is cut off or wasn't closed"
        self.topics = _topics(channels.values(), schemas)


def _topics(channels: Collection[Any], schemas: dict[int, Any]) -> dict[str, Topic]:
    topics = {}
    for channel in channels:
        schema = schemas.get(channel.schema_id)
        name, language, data = (
            ("", "", b"") if schema is None else (schema.name, schema.encoding, schema.data)
        )
        text = data.decode(errors="replace") if language in ("ros1msg", "ros2msg", "ros2idl") else ""
        topics[channel.topic] = Topic(
            channel.topic, name, channel.message_encoding, text, language == "ros2idl"
        )
    return topics


def _library(path: Path) -> Any:
    """What is used of mcap, in one place."""
    try:
        from mcap import exceptions, reader, records, stream_reader
    except ImportError:
        raise ImportError(f"{path}: an MCAP file needs the package mcap: {EXTRA}") from None

    class Library:
        make_reader = staticmethod(reader.make_reader)
        StreamReader = stream_reader.StreamReader
        McapError = exceptions.McapError
        Schema, Channel, Message = records.Schema, records.Channel, records.Message

    return Library


def _zstd_error() -> type[Exception]:
    try:
        from zstandard import ZstdError
    except ImportError:
        return ValueError
    error: type[Exception] = ZstdError
    return error
