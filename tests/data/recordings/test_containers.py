# SPDX-License-Identifier: MIT
import os
import sqlite3
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zstandard
from tricue.data.recordings.bag1 import Bag1
from tricue.data.recordings.container import Chain, Container
from tricue.data.recordings.head import read_head
from tricue.data.recordings.mcap_file import McapFile
from tricue.data.recordings.messages import decoder
from tricue.data.recordings.sqlite_file import SqliteFile

from tests.data.recordings.written import (
    SECOND,
    START,
    Sent,
    raw,
    walk,
    write_bag1,
    write_bag2,
    write_mcap,
)

FAR = (2**63 - 1).to_bytes(8, "little")  # a place in a file
Maker = Callable[[Path, Sequence[Sent]], Container]


def bag1(folder: Path, sent: Sequence[Sent]) -> Container:
    """A ROS 1 bag."""
    return Bag1(write_bag1(folder / "a.bag", sent))


def sqlite(folder: Path, sent: Sequence[Sent]) -> Container:
    """A ROS 2 database."""
    return SqliteFile(next(write_bag2(folder / "b", sent).glob("*.db3")))


def ros2_mcap(folder: Path, sent: Sequence[Sent]) -> Container:
    """An MCAP file as ROS 2 writes it."""
    return McapFile(next(write_bag2(folder / "c", sent, "mcap").glob("*.mcap")))


def mcap(folder: Path, sent: Sequence[Sent]) -> Container:
    """An MCAP file of several small chunks."""
    return McapFile(write_mcap(folder / "d.mcap", sent))


def mcap_without_index(folder: Path, sent: Sequence[Sent]) -> Container:
    """An MCAP file without chunks and summary, which may be."""
    from mcap.writer import IndexType

    return McapFile(
        write_mcap(
            folder / "e.mcap",
            sent,
            use_chunking=False,
            index_types=IndexType.NONE,
            repeat_channels=False,
            repeat_schemas=False,
            use_statistics=False,
            use_summary_offsets=False,
        )
    )


MAKERS = [bag1, sqlite, ros2_mcap, mcap, mcap_without_index]


@pytest.mark.parametrize("make", MAKERS)
def test_all_messages_by_time(tmp_path: Path, make: Maker) -> None:
    """It proves that each container gives types, counts, and the wanted messages alone, in order of time."""
    sent = walk(4)
    container = make(tmp_path, sent)
    assert {topic.name: topic.kind for topic in container.topics.values()} == {
        "/camera/color/camera_info": "CameraInfo",
        "/camera/color/image_raw": "Image",
        "/camera/depth/camera_info": "CameraInfo",
        "/camera/depth/image_rect_raw": "Image",
    }
    assert set(container.counts().values()) == {4}
    wanted = {"/camera/color/image_raw", "/camera/depth/image_rect_raw"}
    found = [(message.topic, message.time) for message in container.messages(wanted)]
    assert sorted(found) == sorted((each.topic, each.time) for each in sent if each.topic in wanted)
    assert [time for _, time in found] == sorted(time for _, time in found)
    assert container.damage == ""


@pytest.mark.parametrize("make", [bag1, sqlite, mcap])
def test_topics_written_one_after_the_other(tmp_path: Path, make: Maker) -> None:
    """It proves that a recording with all of one topic in front of the next is read in order of time."""
    sent = sorted(walk(60, size=(160, 120)), key=lambda each: each.topic)
    times = [message.time for message in make(tmp_path, sent).messages({each.topic for each in sent})]
    assert len(times) == 240
    assert times == sorted(times)


@pytest.mark.parametrize("options", [{"chunk": 1 << 17}, {"use_chunking": False}])
@pytest.mark.parametrize("is_cut", [False, True])
def test_an_mcap_file_without_an_index_is_read_by_time(
    tmp_path: Path, options: dict[str, Any], is_cut: bool
) -> None:
    """It proves that messages that were written late come in order of time in a file that wasn't closed, too,
    from any time on, and those of the same time in the file's order.
    """
    sent = walk(60, size=(160, 120))
    late = sorted(sent, key=lambda each: each.time + SECOND * ("depth" in each.topic))
    path = write_mcap(tmp_path / "a.mcap", late, **options)
    if is_cut:
        content = path.read_bytes()
        path.write_bytes(content[: int(0.8 * len(content))])
    container = McapFile(path)
    found = list(container.messages(container.topics))
    assert len(found) == sum(container.counts().values()) > 100
    assert [each.time for each in found] == sorted(each.time for each in found)
    assert [each for each in found if "depth" not in each.topic] == list(
        container.messages({name for name in container.topics if "depth" not in name})
    )
    middle = found[len(found) // 2].time
    assert list(container.messages(container.topics, middle)) == [e for e in found if e.time >= middle]


@pytest.mark.parametrize("compression", ["LZ4", "BZ2"])
def test_compressed_bags(tmp_path: Path, compression: str) -> None:
    """It proves that both compressions of ROS 1 give the same messages as none."""
    plain = Bag1(write_bag1(tmp_path / "a.bag", walk()))
    packed = Bag1(write_bag1(tmp_path / "b.bag", walk(), compression))
    assert packed.path.stat().st_size < plain.path.stat().st_size
    assert list(packed.messages(plain.topics)) == list(plain.messages(plain.topics))


@pytest.mark.parametrize("name", [b"100% a#b?c=d", b"caf\xe9"])
def test_any_name_of_a_database(tmp_path: Path, name: bytes) -> None:
    """It proves that a database is opened whatever its folder is called, also in bytes that aren't UTF-8."""
    folder = sqlite(tmp_path, walk(3)).path.parent.rename(tmp_path / os.fsdecode(name))
    assert sum(SqliteFile(folder / "b.db3").counts().values()) == 12


def test_compressed_messages_of_ros_2(tmp_path: Path) -> None:
    """It proves that messages that ROS 2 compressed one by one are read."""
    path = next(write_bag2(tmp_path / "b", walk()).glob("*.db3"))
    before = list(SqliteFile(path).messages(SqliteFile(path).topics))
    rewrite(path, zstandard.compress)
    assert list(SqliteFile(path).messages(SqliteFile(path).topics)) == before


def rewrite(path: Path, pack: Callable[[bytes], object], *numbers: int) -> None:
    """Put other data in place of a database's messages with these numbers, of all without any."""
    with sqlite3.connect(path) as database:
        for number, data in database.execute("SELECT id, data FROM messages").fetchall():
            if number in numbers or not numbers:
                database.execute("UPDATE messages SET data = ? WHERE id = ?", (pack(data), number))
    database.close()


def test_compressed_messages_without_their_size(tmp_path: Path) -> None:
    """It proves that a compressed message needs no size in its frame, which zstd leaves out where data
    comes bit by bit.
    """
    path = next(write_bag2(tmp_path / "b", walk()).glob("*.db3"))
    before = list(SqliteFile(path).messages(SqliteFile(path).topics))
    rewrite(path, zstandard.ZstdCompressor(write_content_size=False).compress)
    assert list(SqliteFile(path).messages(SqliteFile(path).topics)) == before


def cut(data: bytes) -> bytes:
    """A compressed message without its end."""
    return zstandard.compress(data)[:-5]


def flipped(data: bytes) -> bytes:
    """A compressed message with a damaged header."""
    return zstandard.compress(data)[:4] + b"\xff" * 20


@pytest.mark.parametrize("pack", [cut, flipped, lambda _: "a text", lambda _: 5])
def test_a_damaged_message_among_others(tmp_path: Path, pack: Callable[[bytes], object]) -> None:
    """It proves that a message that can't be decompressed, or is no bytes at all, leaves the others as they
    are: it comes with data that no decoder takes.
    """
    path = next(write_bag2(tmp_path / "b", walk(3)).glob("*.db3"))
    before = list(SqliteFile(path).messages(SqliteFile(path).topics))
    rewrite(path, zstandard.compress)
    rewrite(path, lambda data: pack(zstandard.decompress(data)), 6)
    container = SqliteFile(path)
    found = list(container.messages(container.topics))
    assert [each[:2] for each in found] == [each[:2] for each in before]
    (different,) = [each for each, other in zip(found, before, strict=True) if each.data != other.data]
    with pytest.raises(ValueError, match="a message that isn't"):
        decoder(container.topics[different.topic])(different.data)


def test_a_lost_topic(tmp_path: Path) -> None:
    """It proves that messages whose topic's row is lost aren't counted, and that the other topics are."""
    path = next(write_bag2(tmp_path / "b", walk(4)).glob("*.db3"))
    with sqlite3.connect(path) as database:
        database.execute("DELETE FROM topics WHERE id = 1")
    database.close()
    counts = SqliteFile(path).counts()
    assert len(counts) == 3
    assert set(counts.values()) == {4}


@pytest.mark.parametrize("name", ["CAST('/\xff' AS BLOB)", "x'2fff'", "CAST(x'2fff' AS TEXT)", "NULL", "5"])
@pytest.mark.parametrize("column", ["name", "type"])
def test_a_damaged_topic(tmp_path: Path, name: str, column: str) -> None:
    """It proves that a topic whose name or type is no text leaves the others as they are."""
    path = next(write_bag2(tmp_path / "b", walk(4)).glob("*.db3"))
    before = SqliteFile(path).topics
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE t AS SELECT * FROM topics")
        database.execute("DROP TABLE topics")
        database.execute("ALTER TABLE t RENAME TO topics")
        database.execute(f"UPDATE topics SET {column} = {name} WHERE id = 1")
    database.close()
    container = SqliteFile(path)
    assert all(isinstance(each, str) for topic in container.topics.values() for each in topic[:4])
    assert len(before.items() & container.topics.items()) == len(before) - 1
    assert set(container.counts().values()) == {4}
    assert sorted(container.topics) == sorted(
        {message.topic for message in container.messages(container.topics)}
    )
    read_head(container)


def many(count: int = 120) -> list[Sent]:
    """Noise, which nothing compresses, in several chunks and pages."""
    period, rng = SECOND // 30, np.random.default_rng(0)
    noise = rng.integers(0, 255, (count, 120, 160, 3), dtype=np.uint8)
    return [raw("/a", START + index * period, image, "bgr8") for index, image in enumerate(noise)]


@pytest.mark.parametrize("make", [bag1, sqlite, ros2_mcap, mcap])
@pytest.mark.parametrize("share", [0.4, 0.9])
def test_a_cut_off_file_is_read_to_the_cut(tmp_path: Path, make: Maker, share: float) -> None:
    """It proves that what stands before the end of a cut off file is read, in order, and that it's told."""
    whole = make(tmp_path, many())
    content = whole.path.read_bytes()
    whole.path.write_bytes(content[: int(share * len(content))])
    container = type(whole)(whole.path)  # type: ignore[call-arg]
    found = list(container.messages({"/a"}))
    assert container.damage.startswith("it is cut off")
    assert [message.time for message in found] == [each.time for each in many()[: len(found)]]
    assert 0.5 * share * 120 < len(found) <= share * 120 + 1


@pytest.mark.parametrize("make", [bag1, mcap])
def test_damage_in_the_middle(tmp_path: Path, make: Maker) -> None:
    """It proves that messages before a damaged chunk are read, though the index is whole, and that it's
    told.
    """
    whole = make(tmp_path, many())
    content = bytearray(whole.path.read_bytes())
    middle = len(content) // 2
    content[middle : middle + 200_000] = bytes(200_000)
    whole.path.write_bytes(content)
    container = type(whole)(whole.path)  # type: ignore[call-arg]
    found = list(container.messages({"/a"}))
    assert container.damage.startswith("it is damaged")
    assert 30 < len(found) < 70


def test_an_index_that_is_nowhere(tmp_path: Path) -> None:
    """It proves that a file whose index is said to be where no file reaches is read without it."""
    bag, packed = bag1(tmp_path, many()).path, mcap(tmp_path, many()).path
    content = bytearray(bag.read_bytes())
    at = content.index(b"index_pos=") + len(b"index_pos=")
    content[at : at + 8] = FAR
    bag.write_bytes(content)
    content = bytearray(packed.read_bytes())
    content[-28:-20] = FAR  # in the footer, before another place, a checksum and the magic
    packed.write_bytes(content)
    assert [sum(read(path).counts().values()) for read, path in ((Bag1, bag), (McapFile, packed))] == [
        len(many())
    ] * 2


def test_a_chain_of_files(tmp_path: Path) -> None:
    """It proves that the files of one recording follow each other, and that counts add up."""
    sent = walk(6)
    parts = [McapFile(write_mcap(tmp_path / f"{n}.mcap", sent[12 * n : 12 * n + 12])) for n in range(2)]
    chain = Chain(tmp_path, list(parts))
    assert [message.time for message in chain.messages(chain.topics)] == [each.time for each in sent]
    assert set(chain.counts().values()) == {6}


@pytest.mark.parametrize(
    ("reader", "content", "message"),
    [
        (Bag1, b"not a bag", "expected a ROS 1 bag, this file isn't one"),
        (Bag1, b"", "expected a ROS 1 bag, this file isn't one"),
        (Bag1, b"#ROSBAG V1.2\nold", r"expected a ROS 1 bag of version 2.0, got 1.2; rosbag fix"),
        (Bag1, b"#ROSBAG V2.0\n\x45\x00", "cut off in its first record"),
        (McapFile, b"not an mcap file", "expected an MCAP file, this file isn't one"),
        (McapFile, b"", "expected an MCAP file, this file isn't one"),
        (SqliteFile, b"no database", "expected a ROS 2 recording, got another database"),
    ],
)
def test_other_files_are_refused(
    tmp_path: Path, reader: Callable[[Path], Container], content: bytes, message: str
) -> None:
    """It proves that a file that is none of the kind is an error that names it."""
    path = tmp_path / "x.bag"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=rf"x\.bag: .*{message}"):
        reader(path)
