# SPDX-License-Identifier: MIT
"""MCAP files, read with the library mcap: by the file's index, or, without one, by one made from the file."""

import heapq
import struct
from array import array
from collections import Counter
from collections.abc import Collection, Iterator
from inspect import signature
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from tricue.data.recordings.container import Container, Message, Topic
from tricue.doctor.install import install_extra


class McapFile(Container):
    """An MCAP file; one without an index, such as a truncated one, is read once to find topics and parts."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._broken = _errors(path)
        self._summary = self._read_summary()
        self._counts: Counter[str] = Counter()
        self._names: dict[int, str] = {}  # of channels
        self._parts = array("Q")  # without an index: of each part first and last time, and its offset
        self._is_indexed = self._summary is not None and bool(self._summary.chunk_indexes)
        if not self._is_indexed:
            self._scan()
            return
        self.topics = _topics(self._summary.channels.values(), self._summary.schemas)
        for number, count in self._summary.statistics.channel_message_counts.items():
            self._counts[self._summary.channels[number].topic] += count

    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        try:
            yield from self._indexed(names, start) if self._is_indexed else self._by_parts(names, start)
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

    def _by_parts(self, names: Collection[str], start: int) -> Iterator[Message]:
        """The messages in order of time, as the library gives them by an index.

        A part is a chunk, or a message outside of chunks. Parts may overlap in time; only the messages of
        those that do are in memory.
        """
        waiting: list[tuple[int, int, int, Message]] = []
        firsts, lasts, offsets = np.array(self._parts).reshape(-1, 3).T
        with self.path.open("rb") as file:
            for part in np.lexsort((offsets, firsts)):
                if lasts[part] < start:
                    continue
                while waiting and waiting[0][0] < firsts[part]:
                    yield heapq.heappop(waiting)[-1]
                offset = int(offsets[part])
                for number, record in enumerate(_messages_at(file, offset)):
                    name = self._names.get(record.channel_id, "")
                    if name in names and record.log_time >= start:
                        message = Message(name, record.log_time, record.data)
                        heapq.heappush(waiting, (message.time, offset, number, message))
        while waiting:
            yield heapq.heappop(waiting)[-1]

    def _scan(self) -> None:
        """Find topics, counts and parts by reading the whole file."""
        from mcap import records
        from mcap.stream_reader import StreamReader

        schemas: dict[int, Any] = {}
        channels: dict[int, Any] = {}
        counts: Counter[int] = Counter()
        try:
            with self.path.open("rb") as file:
                offset = 0
                for record in StreamReader(file, emit_chunks=True, validate_crcs=True).records:
                    within = _within(record)
                    times = [each.log_time for each in within if isinstance(each, records.Message)]
                    if times:
                        self._parts.extend((min(times), max(times), offset))
                    offset = file.tell()
                    for each in within:
                        if isinstance(each, records.Schema):
                            schemas[each.id] = each
                        elif isinstance(each, records.Channel):
                            channels[each.id] = each
                        elif isinstance(each, records.Message):
                            counts[each.channel_id] += 1
        except self._broken:
            self.damage = "it is cut off or wasn't closed"
        self.topics = _topics(channels.values(), schemas)
        self._names = {number: channel.topic for number, channel in channels.items()}
        for number, count in counts.items():
            self._counts[self._names.get(number, "")] += count


def _messages_at(file: BinaryIO, offset: int) -> Iterator[Any]:
    """The messages of the part at this place in the file."""
    from mcap import records
    from mcap.stream_reader import StreamReader

    file.seek(offset)
    part = next(iter(StreamReader(file, skip_magic=offset > 0, emit_chunks=True).records))
    return (each for each in _within(part) if isinstance(each, records.Message))


def _within(record: Any) -> list[Any]:
    """The records of a chunk; of any other record, itself."""
    from mcap.records import Chunk
    from mcap.stream_reader import breakup_chunk

    return breakup_chunk(record, validate_crc=True) if isinstance(record, Chunk) else [record]


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
