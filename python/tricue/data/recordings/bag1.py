# SPDX-License-Identifier: MIT
"""ROS 1 bags, version 2.0: chunks of messages, then an index, which a truncated bag lacks.

Source: the ROS wiki, "Bags/Format/2.0".
"""

import bz2
import heapq
import re
import struct
from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from tricue.data.recordings.container import Container, Message, Topic
from tricue.doctor.install import install_extra

_MESSAGE, _HEADER, _CHUNK, _CHUNK_INFO, _CONNECTION = 2, 3, 5, 6, 7  # kinds of records
_MAX_HELD = 200  # messages held back to sort them by time; chunks overlap a little
_BROKEN = (EOFError, IndexError, KeyError, OSError, ValueError, struct.error)
"""What reading damaged records raises; OSError if they give an impossible position."""
_MAX_FIELDS = 1 << 20  # bytes in a record's header; a longer one can't be a header


class _ChunkPlace(NamedTuple):
    """A chunk's position, the times of its first and last messages, and its message counts by connection."""

    start: int
    end: int
    position: int
    counts: dict[int, int]


class Bag1(Container):
    """A ROS 1 bag. If it lacks the index at its end, it is read once from start to end to build one."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.topics: dict[str, Topic] = {}
        self._names: dict[int, str] = {}  # of connections
        self._chunks: list[_ChunkPlace] = []
        with path.open("rb") as file:
            index, connections, chunks = _read_start(file, path)
            try:
                self._read_index(file, index, connections, chunks)
            except _BROKEN:
                self.topics, self._names, self._chunks = {}, {}, []
                self._scan(file)

    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        wanted = {connection for connection, name in self._names.items() if name in names}
        found = (chunk for chunk in self._chunks if wanted & chunk.counts.keys() and chunk.end >= start)
        chunks = sorted(found, key=lambda chunk: (chunk.start, chunk.position))
        held: list[tuple[int, int, Message]] = []
        number = 0
        with self.path.open("rb") as file:
            for chunk in chunks:
                while held and (held[0][0] <= chunk.start or len(held) > _MAX_HELD):
                    yield heapq.heappop(held)[2]
                try:
                    for message in self._messages_of(_read_chunk(file, chunk.position), wanted):
                        if message.time < start:
                            continue
                        heapq.heappush(held, (message.time, number, message))
                        number += 1
                except _BROKEN:
                    self.damage = "it is damaged in the middle"
                    break
        while held:
            yield heapq.heappop(held)[2]

    def counts(self) -> dict[str, int]:
        total: Counter[str] = Counter(dict.fromkeys(self.topics, 0))
        for chunk in self._chunks:
            for connection, count in chunk.counts.items():
                total[self._names[connection]] += count
        return dict(total)

    def _read_index(self, file: BinaryIO, position: int, connections: int, chunks: int) -> None:
        """ValueError or EOFError if the bag wasn't closed or is truncated."""
        if position == 0:
            raise ValueError("no index")
        file.seek(position)
        for _ in range(connections):
            self._add_connection(*_read_record(file, _CONNECTION))
        for _ in range(chunks):
            fields, data = _read_record(file, _CHUNK_INFO)
            pairs = struct.iter_unpack("<II", data)
            if data:
                place = int.from_bytes(fields["chunk_pos"], "little")
                first, last = (_time(fields[name]) for name in ("start_time", "end_time"))
                self._chunks.append(_ChunkPlace(first, last, place, dict(pairs)))

    def _scan(self, file: BinaryIO) -> None:
        """Find topics and chunks by reading the whole file."""
        self.damage = "it is cut off or wasn't closed"
        file.seek(0)
        file.readline()
        try:
            while True:
                position = file.tell()
                fields, data = _read_record(file)
                if fields["op"][0] == _CHUNK:
                    self._scan_chunk(position, _decompressed(fields, data))
        except _BROKEN:
            return

    def _scan_chunk(self, position: int, content: bytes) -> None:
        counts: Counter[int] = Counter()
        times = []
        for fields, data in _records(content):
            if fields["op"][0] == _CONNECTION:
                self._add_connection(fields, data)
            elif fields["op"][0] == _MESSAGE:
                counts[int.from_bytes(fields["conn"], "little")] += 1
                times.append(_time(fields["time"]))
        if times:
            self._chunks.append(_ChunkPlace(min(times), max(times), position, dict(counts)))

    def _add_connection(self, fields: dict[str, bytes], data: bytes) -> None:
        name, about = fields["topic"].decode(), _fields(data)
        self._names[int.from_bytes(fields["conn"], "little")] = name
        definition = about["message_definition"].decode(errors="replace")
        kind = about["type"].decode().replace("/", "/msg/", 1)
        self.topics[name] = Topic(name, kind, "ros1", definition)

    def _messages_of(self, content: bytes, wanted: Collection[int]) -> Iterator[Message]:
        for fields, data in _records(content):
            if fields["op"][0] == _MESSAGE:
                connection = int.from_bytes(fields["conn"], "little")
                if connection in wanted:
                    yield Message(self._names[connection], _time(fields["time"]), data)


def _read_start(file: BinaryIO, path: Path) -> tuple[int, int, int]:
    """The position of the index, and its numbers of connections and chunks; ValueError if it isn't a bag."""
    magic = re.match(rb"#ROSBAG V(\d+\.\d+)\n", file.readline(64))
    if magic is None:
        raise ValueError(f"{path}: expected a ROS 1 bag, this file isn't one")
    if magic[1] != b"2.0":
        raise ValueError(f"{path}: expected a ROS 1 bag of version 2.0, got {magic[1].decode()}; rosbag fix")
    try:
        fields, _ = _read_record(file, _HEADER)
        place, connections, chunks = (
            int.from_bytes(fields[name], "little") for name in ("index_pos", "conn_count", "chunk_count")
        )
    except _BROKEN:
        raise ValueError(f"{path}: expected a ROS 1 bag, this one is cut off in its first record") from None
    return place, connections, chunks


def _read_chunk(file: BinaryIO, position: int) -> bytes:
    file.seek(position)
    return _decompressed(*_read_record(file, _CHUNK))


def _decompressed(fields: dict[str, bytes], data: bytes) -> bytes:
    compression = fields["compression"].decode()
    if compression == "none":
        return data
    try:
        if compression == "bz2":
            return bz2.decompress(data)
        if compression == "lz4":
            return _lz4(data)
    except (OSError, RuntimeError) as error:
        raise ValueError(f"a chunk can't be decompressed ({error})") from None
    raise ValueError(f"the compression {compression!r} isn't known")


def _lz4(data: bytes) -> bytes:
    try:
        import lz4.frame
    except ImportError:
        raise ImportError(f"a compressed bag needs the package lz4: {install_extra('recordings')}") from None
    content: bytes = lz4.frame.decompress(data)
    return content


def _read_record(file: BinaryIO, kind: int | None = None) -> tuple[dict[str, bytes], bytes]:
    """A record's fields and data; EOFError at the end of the file, ValueError for another kind of record."""
    fields = _fields(_read(file, _read_length(file, _MAX_FIELDS)))
    if "op" not in fields or (kind is not None and fields["op"][0] != kind):
        raise ValueError("a record isn't where it has to be")
    return fields, _read(file, _read_length(file))


def _read_length(file: BinaryIO, most: int = 1 << 32) -> int:
    length = int.from_bytes(_read(file, 4), "little")
    if length > most:
        raise ValueError("a record has an impossible length")
    return length


def _read(file: BinaryIO, size: int) -> bytes:
    data = file.read(size)
    if len(data) < size:
        raise EOFError("the file ends in a record")
    return data


def _records(content: bytes) -> Iterator[tuple[dict[str, bytes], bytes]]:
    """The records in a chunk."""
    at = 0
    while at + 8 <= len(content):
        fields, at = _part(content, at)
        data, at = _part(content, at)
        yield _fields(fields), data


def _part(content: bytes, at: int) -> tuple[bytes, int]:
    """The bytes of a length-prefixed field, and the offset after it."""
    (length,) = struct.unpack_from("<I", content, at)
    return content[at + 4 : at + 4 + length], at + 4 + length


def _fields(header: bytes) -> dict[str, bytes]:
    fields, at = {}, 0
    while at + 4 <= len(header):
        field, at = _part(header, at)
        name, _, value = field.partition(b"=")
        fields[name.decode(errors="replace")] = value
    return fields


def _time(value: bytes) -> int:
    seconds, nanoseconds = struct.unpack("<II", value)
    return int(seconds) * 10**9 + int(nanoseconds)
