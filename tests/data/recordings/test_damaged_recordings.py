# SPDX-License-Identifier: MIT
"""Recordings that are damaged, cut off, or without images that can be read."""

import random
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import zstandard
from tricue import open_source
from tricue.app.frames import RecordedFrames
from tricue.cli.program import main
from tricue.data.joint import JointStream
from tricue.doctor.install import install_extra

from tests.data.recordings.recording_files import COLOR, WRITERS, Writer, bag1, blues, mcap, sqlite
from tests.data.recordings.test_containers import rewrite
from tests.data.recordings.written import (
    SECOND,
    START,
    Sent,
    color,
    compressed,
    jpeg,
    raw,
    walk,
    write_bag1,
    write_bag2,
    write_mcap,
)


def test_the_frame_before_stands_in_for_a_damaged_one(tmp_path: Path) -> None:
    """It proves that one image that can't be decoded doesn't end the reading, is told, and that frames have
    the same numbers however they are read.
    """
    images = [jpeg(color(10)), b"no image", jpeg(color(30))]
    sent = [
        compressed("/a/compressed", START + n * SECOND // 10, data, "jpeg") for n, data in enumerate(images)
    ]
    source = open_source(mcap(tmp_path, sent))
    assert blues(source) == pytest.approx([10, 10, 30], abs=2)
    assert source.remarks == ("took the frame before in place of 1 with a damaged image",)
    assert [frame.timestamp for frame in source] == pytest.approx([START / SECOND + n / 10 for n in range(3)])
    (stream,) = source.channels.values()
    assert isinstance(stream, JointStream)
    assert stream.count() == 3
    for numbers, shown in {(0, 2): [10, 30], (1, 2): [10, 30], (2,): [30], (1,): [10]}.items():
        assert blues(source.frames(numbers)) == pytest.approx(shown, abs=2)


@pytest.mark.parametrize(("damaged", "of_frames"), [({0}, 1), ({0, 1, 2, 4}, 3), (set(range(20)), 20)])
def test_a_damaged_first_image(tmp_path: Path, damaged: set[int], of_frames: int) -> None:
    """It proves that damaged images at the beginning don't refuse the recording either: the first whole one
    stands in for them, in all ways of reading, and this is told.
    """
    images = [b"no" if at in damaged else jpeg(color(5 * at + 5)) for at in range(24)]
    sent = [
        compressed("/a/compressed", START + at * SECOND // 30, data, "jpeg") for at, data in enumerate(images)
    ]
    path = mcap(tmp_path, sent)
    source = open_source(path)
    shown = [5 * max({of_frames} | set(range(at + 1)) - damaged) + 5 for at in range(24)]
    assert blues(source) == pytest.approx(shown, abs=2)
    before = f"took the first whole image in place of {of_frames} damaged before it"
    assert source.remarks[0] == before
    assert blues(source.frames([0, 1, 21])) == pytest.approx([shown[at] for at in (0, 1, 21)], abs=2)
    page = RecordedFrames(open_source(path))
    assert (page.size, page.first) == ((32, 24), of_frames)
    with pytest.raises(ValueError, match="can't be decoded"):
        page.frame(0)


def test_images_that_are_all_damaged(tmp_path: Path) -> None:
    """It proves that a topic without any image that can be decoded is an error that names it."""
    sent = [compressed("/a/compressed", START + at * SECOND // 30, b"no", "jpeg") for at in range(5)]
    with pytest.raises(ValueError, match=r"can't be decoded; got color=/a/compressed, choose others"):
        open_source(mcap(tmp_path, sent))


@pytest.mark.parametrize("damaged", [{2}, {3, 5, 6}, set(range(4, 31)), set(range(9, 24)) | {25}])
def test_a_damaged_frame_is_the_same_however_it_is_read(tmp_path: Path, damaged: set[int]) -> None:
    """It proves that a damaged frame alone has the images of the last whole one before it, as in reading all,
    however far back that is, and that only the wanted frames count as damaged.
    """
    sent = [
        compressed(
            "/a/compressed",
            START + at * SECOND // 30,
            b"no" if at in damaged else jpeg(color(7 * at)),
            "jpeg",
        )
        for at in range(35)
    ]
    source = open_source(mcap(tmp_path, sent))
    every = blues(source)
    assert every == pytest.approx([7 * max(set(range(at + 1)) - damaged) for at in range(35)], abs=2)
    for number in (2, 6, 13, 23, 25, 30, 34):
        assert blues(source.frames([number])) == [every[number]]
        assert ("in place of 1 with" in str(source.remarks)) == (number in damaged)
    assert blues(source.frames([1, 8, 29, 33])) == [every[at] for at in (1, 8, 29, 33)]


def test_a_message_that_is_not_decompressed(tmp_path: Path) -> None:
    """It proves that a compressed message that is damaged is left out, which is told, and others are read."""
    folder = sqlite(tmp_path, [each for each in walk(6) if each.topic == COLOR])
    rewrite(next(folder.glob("*.db3")), lambda data: zstandard.compress(data)[:-5], 3)
    source = open_source(folder)
    assert blues(source) == [10, 20, 40, 50, 60]
    assert source.remarks == ("left out 1 unreadable message",)
    RecordedFrames(source).frame(4)  # lists the frames first
    assert source.remarks == ("left out 1 unreadable message",)


@pytest.mark.parametrize("topics", [None, {"color": COLOR}])
def test_a_first_message_that_is_not_decompressed(tmp_path: Path, topics: dict[str, str] | None) -> None:
    """It proves that a topic's first message may be damaged, too, whether or not the topic is named."""
    folder = sqlite(tmp_path, [each for each in walk(6) if each.topic == COLOR])
    rewrite(next(folder.glob("*.db3")), lambda data: zstandard.compress(data)[:-5], 1)
    source = open_source(folder, topics=topics)
    assert blues(source) == [20, 30, 40, 50, 60]
    assert source.remarks == ("left out 1 unreadable message",)


@pytest.mark.parametrize("write", WRITERS)
def test_a_cut_off_recording(tmp_path: Path, write: Writer) -> None:
    """It proves that the frames before the end of a cut off file are read, but for those of the chunk that is
    cut, and that this is told.
    """
    noise = np.random.default_rng(0).integers(0, 255, (60, 120, 160, 3), dtype=np.uint8)
    sent = [raw("/a", START + index * SECOND // 30, image, "bgr8") for index, image in enumerate(noise)]
    path = write(tmp_path, sent)
    file = path if path.is_file() else next(each for each in path.iterdir() if each.suffix != ".yaml")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    source = open_source(path)
    frames = list(source)
    assert 30 - 18 <= len(frames) <= 31  # a chunk of 1 MiB has 18 images
    assert all(np.array_equal(frame.color, image) for frame, image in zip(frames, noise, strict=False))
    (remark,) = source.remarks
    assert "it is cut off" in remark
    assert remark.endswith("; what is before that was read")


@pytest.mark.filterwarnings("ignore:depth")  # which may be damaged, too
@pytest.mark.parametrize("write", WRITERS)
def test_damaged_bytes(tmp_path: Path, write: Writer) -> None:
    """It proves that whatever bytes of a recording are wrong, it's read, or an error that names it."""
    path = write(tmp_path, walk(3))
    file = path if path.is_file() else next(each for each in path.iterdir() if each.suffix != ".yaml")
    content, rng = file.read_bytes(), random.Random(0)
    errors = []
    for _ in range(40):
        damaged = bytearray(content)
        for _ in range(rng.choice((1, 4, 20))):
            place = rng.randrange(len(damaged))
            damaged[place : place + rng.choice((1, 4))] = rng.choice((b"\xff" * 4, b"", rng.randbytes(1)))
        file.write_bytes(damaged)
        try:
            list(open_source(file))
        except ValueError as error:
            errors.append(str(error))
    assert 0 < len(errors) < 40
    assert all(file.name in error for error in errors)


def no_images(folder: Path) -> Path:
    """A bag of other things."""
    return write_bag1(folder / "x.bag", [Sent("/n", START, "std_msgs/msg/UInt32", {"data": 1})])


def no_messages(folder: Path) -> Path:
    """A bag of nothing."""
    return write_bag1(folder / "x.bag", [])


def several(folder: Path) -> Path:
    """A folder of two recordings."""
    for name in ("1.mcap", "2.mcap"):
        write_mcap(folder / name, walk(1))
    return folder


def packed(folder: Path) -> Path:
    """A ROS 2 folder whose database is compressed as a whole."""
    path = next(write_bag2(folder / "b", walk(1)).glob("*.db3"))
    path.rename(path.with_name(f"{path.name}.zstd"))
    return path.parent


def unknown_encoding(folder: Path) -> Path:
    """A bag of images that nobody knows."""
    return write_bag1(folder / "x.bag", [raw("/a", START, color(1), "secret")])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (no_images, "x.bag: expected images in the recording, found only std_msgs/msg/UInt32"),
        (no_messages, "x.bag: expected images in the recording, found no messages"),
        (packed, "b.db3.zstd: expected unpacked files; zstd -d --rm "),
        (several, "expected one recording, found 2; name one of them"),
        (
            unknown_encoding,
            "the encoding 'secret' of color isn't known; got color=/a, choose others by --top",
        ),
    ],
)
def test_unusable_recordings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], make: Callable[[Path], Path], message: str
) -> None:
    """It proves that a recording without images that can be read is an error of one line."""
    assert main(["info", str(make(tmp_path))]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1


@pytest.mark.parametrize(("write", "package"), [(bag1, "rosbags"), (mcap, "mcap")])
def test_a_missing_package_is_named(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    write: Writer,
    package: str,
) -> None:
    """It proves that without the extra the one line says what to install."""
    path = write(tmp_path, walk(1))
    for name in [name for name in sys.modules if name.split(".")[0] == package]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setitem(sys.modules, package, None)
    assert main(["info", str(path)]) == 2
    assert f"the package {package}: {install_extra('recordings')}" in capsys.readouterr().err
