# SPDX-License-Identifier: MIT
"""MCAP files, read with the library mcap: by the index, or, without one, from start to end."""

import struct
from bisect import bisect_left
from collections import Counter
from collections.abc import Collection, Iterator
from inspect import signature
from pathlib import Path
from typing import Any, NamedTuple

from tricue.data.recordings.container import Container, Message, Topic
from tricue.doctor.install import install_extra


class _ChunkEnd(NamedTuple):
    """Where a chunk ends in the file, and the time of the latest message so far."""

    latest: int
    offset: int


class McapFile(Container):
    """An MCAP file; one without a summary, such as a truncated one, is read once to find its topics."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._broken = _errors(path)
        self._summary = self._read_summary()
        self._counts: Counter[str] = Counter()
        self._names: dict[int, str] = {}  # of channels
        self._chunk_ends: list[_ChunkEnd] = []
        if self._summary is None:
            self._scan()
            return
        self.topics = _topics(self._summary.channels.values(), self._summary.schemas)
        for number, count in self._summary.statistics.channel_message_counts.items():
            self._counts[self._summary.channels[number].topic] += count

    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        indexed = self._summary is not None and self._summary.chunk_indexes
        try:
            yield from self._indexed(names, start) if indexed else self._in_order(names, start)
        except self._broken as error:
            self.damage = self.damage or f"it is damaged: {error or type(error).__name__}"

    def counts(self) -> dict[str, int]:
        return {name: self._counts[name] for name in self.topics}

    def _read_summary(self) -> Any:
        """The summary at the file's end; None if it is missing, incomplete or damaged."""
        from mcap.exceptions import McapError
        from mcap.reader import make_reader

        with self.path.open("rb") as file:
            try:
                reader = make_reader(file)
            except (McapError, struct.error):
                raise ValueError(f"{self.path}: expected an MCAP file, this file isn't one") from None
            try:
                summary = reader.get_summary()
            except self._broken:
                return None
        if summary is None or summary.statistics is None or not summary.channels:
            return None
        counted = summary.statistics.channel_message_counts.keys()
        return summary if counted <= summary.channels.keys() else None

    def _indexed(self, names: Collection[str], start: int) -> Iterator[Message]:
        from mcap.reader import make_reader

        with self.path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True)
            found = reader.iter_messages(list(names), **_since(reader, start))
            for _, channel, message in found:
                yield Message(channel.topic, message.log_time, message.data)

    def _in_order(self, names: Collection[str], start: int) -> Iterator[Message]:
        from mcap import records

        channels = dict(self._names)
        for record in self._records(self._offset(start)):
            if isinstance(record, records.Channel):
                channels[record.id] = record.topic
            if not isinstance(record, records.Message) or record.log_time < start:
                continue
            if channels.get(record.channel_id) in names:
                yield Message(channels[record.channel_id], record.log_time, record.data)

    def _offset(self, start: int) -> int:
        """The file offset from which to read to get all messages from this time on."""
        return self._chunk_ends[at - 1].offset if (at := bisect_left(self._chunk_ends, (start,))) else 0

    def _records(self, offset: int = 0) -> Iterator[Any]:
        """The records, including those in chunks. offset: where in the file one begins, 0 for the first."""
        from mcap.records import Chunk
        from mcap.stream_reader import StreamReader, breakup_chunk

        latest = 0
        with self.path.open("rb") as file:
            file.seek(offset)
            reader = StreamReader(file, skip_magic=offset > 0, emit_chunks=True, validate_crcs=True)
            for record in reader.records:
                if not isinstance(record, Chunk):
                    yield record
                    continue
                yield from breakup_chunk(record, validate_crc=True)
                latest = max(latest, record.message_end_time)
                if offset == 0 and file.tell() > (self._chunk_ends[-1].offset if self._chunk_ends else 0):
                    self._chunk_ends.append(_ChunkEnd(latest, file.tell()))

    def _scan(self) -> None:
        """Find topics and counts by reading the whole file."""
        from mcap import records

        schemas: dict[int, Any] = {}
        channels: dict[int, Any] = {}
        try:
            for record in self._records():
                if isinstance(record, records.Schema):
                    schemas[record.id] = record
                elif isinstance(record, records.Channel):
                    channels[record.id] = record
                elif isinstance(record, records.Message):
                    self._counts[channels[record.channel_id].topic] += 1
        except self._broken:
            self.damage = "it is cut off or wasn't closed"
        self.topics = _topics(channels.values(), schemas)
        self._names = {number: channel.topic for number, channel in channels.items()}


def _since(reader: Any, start: int) -> dict[str, Any]:
    """The keyword argument for the start time, which has different names in different versions of mcap."""
    known = signature(reader.iter_messages).parameters
    return {"starting_at" if "starting_at" in known else "start_time": start} if start else {}


def _topics(channels: Collection[Any], schemas: dict[int, Any]) -> dict[str, Topic]:
    topics = {}
    for channel in channels:
        schema = schemas.get(channel.schema_id)
        kind, language, data = (
            ("", "", b"") if schema is None else (schema.name, schema.encoding, schema.data)
        )
        text = data.decode(errors="replace") if language in ("ros1msg", "ros2msg", "ros2idl") else ""
        topics[channel.topic] = Topic(
            channel.topic, kind, channel.message_encoding, text, language == "ros2idl"
        )
    return topics


def _errors(path: Path) -> tuple[type[Exception], ...]:
    """What mcap raises for truncated or damaged files; ImportError if it isn't installed."""
    try:
        from mcap.exceptions import McapError
        from zstandard import ZstdError
    except ImportError:
        raise ImportError(
            f"{path}: an MCAP file needs the package mcap: {install_extra('recordings')}"
        ) from None
    return (
        *(McapError, ZstdError, struct.error, EOFError, RuntimeError, ValueError),
        *(KeyError, MemoryError, OverflowError, OSError),  # impossible numbers, lengths and offsets
    )
