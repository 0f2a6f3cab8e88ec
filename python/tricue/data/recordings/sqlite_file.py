# SPDX-License-Identifier: MIT
"""ROS 2 databases (.db3): a table of topics, and one of messages in CDR."""

import os
import sqlite3
from collections.abc import Collection, Iterator
from contextlib import closing
from functools import partial
from pathlib import Path
from urllib.parse import quote

from tricue.data.recordings.container import Container, Message, Topic
from tricue.doctor.install import install_extra

_ZSTD = b"\x28\xb5\x2f\xfd"  # how a compressed message begins; CDR begins with 0


class SqliteFile(Container):
    """A ROS 2 database of any version; a truncated one is read up to the damage."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            with closing(self._connect()) as database:
                definitions = _definitions(database)
                columns = ", ".join(map(_text, ("name", "type", "serialization_format")))
                rows = database.execute(f"SELECT id, {columns} FROM topics").fetchall()
        except sqlite3.DatabaseError as error:
            raise ValueError(f"{path}: expected a ROS 2 recording, got another database ({error})") from None
        self._names = {number: name for number, name, _, _ in rows}
        self.topics = {
            name: Topic(name, kind, encoding, *definitions.get(kind, ("", False)))
            for _, name, kind, encoding in rows
        }

    def messages(self, names: Collection[str], start: int = 0) -> Iterator[Message]:
        numbers = [number for number, name in self._names.items() if name in names]
        # a damaged row may hold values of other types
        columns = "topic_id, CAST(IFNULL(timestamp, 0) AS INTEGER), CAST(IFNULL(data, '') AS BLOB)"
        query = f"SELECT {columns} FROM messages WHERE topic_id IN ({_marks(numbers)})"
        query += " AND timestamp >= ?" * (start > 0)  # this uses an index, which may be damaged
        values = [*numbers, *([start] * (start > 0))]
        any_read = False
        with closing(self._connect()) as database:
            for order in ("ORDER BY timestamp", "ORDER BY id"):  # the index of times may be damaged
                try:
                    for number, time, data in database.execute(f"{query} {order}", values):
                        any_read = True
                        yield Message(self._names[number], time, _decompressed(data))
                except sqlite3.DatabaseError as error:
                    self.damage = f"it is cut off or damaged ({error})"
                if any_read or not self.damage:
                    return

    def counts(self) -> dict[str, int]:
        counts = dict.fromkeys(self.topics, 0)
        with closing(self._connect()) as database:
            try:
                for number, count in database.execute("SELECT topic_id, COUNT(*) FROM messages GROUP BY 1"):
                    if number in self._names:  # the topic's row may be lost
                        counts[self._names[number]] += count
            except sqlite3.DatabaseError as error:
                self.damage = f"it is cut off or damaged ({error})"
        return counts

    def _connect(self) -> sqlite3.Connection:
        """Open it read-only, with what a crashed recorder left in a journal beside the file."""
        journal = self.path.with_name(f"{self.path.name}-wal").exists()
        options = "mode=ro" if journal else "mode=ro&immutable=1"
        database = sqlite3.connect(f"file:{quote(os.fsencode(self.path))}?{options}", uri=True)
        database.text_factory = partial(str, encoding="utf-8", errors="replace")
        database.execute("PRAGMA writable_schema = ON")  # else a truncated file can't be opened at all
        return database


def _text(column: str) -> str:
    """A query's expression for the column as text, whatever its type in a damaged row."""
    return f"CAST(IFNULL({column}, '') AS TEXT)"


def _marks(values: Collection[int]) -> str:
    """A query's placeholders, one for each value."""
    return ", ".join("?" * len(values))


def _definitions(database: sqlite3.Connection) -> dict[str, tuple[str, bool]]:
    """The definitions of types, which older databases lack, and whether they are in OMG IDL."""
    try:
        columns = ", ".join(map(_text, ("topic_type", "encoding", "encoded_message_definition")))
        rows = database.execute(f"SELECT {columns} FROM message_definitions").fetchall()
    except sqlite3.OperationalError:
        return {}
    return {kind: (text, language == "ros2idl") for kind, language, text in rows}


def _decompressed(data: bytes) -> bytes:
    """The message, decompressed if ROS 2 compressed it; b"", which no message is, if it is damaged."""
    if not data.startswith(_ZSTD):
        return data
    try:
        import zstandard
    except ImportError:
        raise ImportError(
            f"compressed messages need the package zstandard: {install_extra('recordings')}"
        ) from None
    stream = zstandard.ZstdDecompressor().decompressobj()  # needs no size in the frame's header
    try:
        content: bytes = stream.decompress(data)
    except zstandard.ZstdError:
        return b""
    return content if stream.eof else b""
