# SPDX-License-Identifier: MIT
"""Any frame of a robot's recording is the one that reading from the start gives, with little in memory."""

import random
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from tricue.app.frames import RecordedFrames
from tricue.data.open_source import open_source
from tricue.data.recordings import seekable

from tests.data.recordings.test_containers import mcap_without_index
from tests.data.recordings.written import (
    SECOND,
    START,
    Sent,
    color,
    depth,
    raw,
    walk,
    write_bag1,
    write_bag2,
    write_mcap,
)

Writer = Callable[[Path, Sequence[Sent]], Path]


def bag1(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 1 bag."""
    return write_bag1(folder / "a.bag", sent)


def bz2(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 1 bag with compressed chunks."""
    return write_bag1(folder / "z.bag", sent, "BZ2")


def sqlite(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 2 folder with a database."""
    return write_bag2(folder / "b", sent)


def mcap(folder: Path, sent: Sequence[Sent]) -> Path:
    """An MCAP file of several chunks."""
    return write_mcap(folder / "d.mcap", sent)


def unindexed(folder: Path, sent: Sequence[Sent]) -> Path:
    """An MCAP file without chunks and summary."""
    return mcap_without_index(folder, sent).path


def cut_off(folder: Path, sent: Sequence[Sent]) -> Path:
    """An MCAP file of several chunks that was cut off, and lost its summary."""
    path = write_mcap(folder / "f.mcap", sent)
    path.write_bytes(path.read_bytes()[: int(0.8 * path.stat().st_size)])
    return path


def cut_bag(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 1 bag that was cut off, and lost its index."""
    path = write_bag1(folder / "g.bag", sent)
    path.write_bytes(path.read_bytes()[: int(0.8 * path.stat().st_size)])
    return path


WRITERS = [bag1, bz2, sqlite, mcap, unindexed, cut_off, cut_bag]


def apart(count: int, size: tuple[int, int] = (160, 120)) -> list[Sent]:
    """Color at 30 a second, depth at 15, so that every other color image has a partner."""
    return [
        each
        for index in range(count)
        for each in walk(1, size=size)
        if index % 2 == 0 or "depth" not in each.topic
        for each in [shifted(each, index * SECOND // 30, index)]
    ]


def shifted(sent: Sent, by: int, index: int) -> Sent:
    """The message later, with pixels that tell its number."""
    fields = {**sent.fields, "header": {**sent.fields["header"], "stamp": sent.time + by}}
    if "data" in fields:
        size = fields["width"], fields["height"]
        image = depth(1000 + index, size) if "depth" in sent.topic else color(index % 250, size)
        fields["data"] = image.reshape(-1).view(np.uint8)
    return sent._replace(time=sent.time + by, fields=fields)


@pytest.mark.parametrize("write", WRITERS)
def test_any_frame_is_that_of_reading_on(
    tmp_path: Path, write: Writer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that frames in any order, backwards, and of another thread are those of reading them all."""
    monkeypatch.setattr(seekable, "KEPT_BYTES", 1 << 20)
    monkeypatch.setattr(seekable, "MAX_SKIPPED", SECOND // 3)
    place = write(tmp_path, apart(120))
    expected = list(open_source(place))
    recording = RecordedFrames(open_source(place))
    assert (recording.length, recording.size) == (len(expected), (160, 120))
    assert len(expected) > 40
    order = random.Random(0).sample(range(len(expected)), len(expected))
    for number in [*order, *reversed(range(len(expected))), *range(len(expected))]:
        frame = recording.frame(number)
        assert np.array_equal(frame.color, expected[number].color)
        assert np.array_equal(frame.depth, expected[number].depth, equal_nan=True)
        assert frame.timestamp == expected[number].timestamp == recording.seconds(number)
    assert np.array_equal(recording.again().frame(7).color, expected[7].color)
    assert [number for number, _ in recording.frames(20, 9)] == list(range(20, 9, -1))


def test_frames_are_sought(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a far frame is read from where it is: most of the file is left alone."""
    from tricue.data.recordings.recording import Recording as Topics

    recording = RecordedFrames(open_source(bag1(tmp_path, apart(400))))
    read: list[int] = []
    images = Topics.images
    monkeypatch.setattr(
        Topics,
        "images",
        lambda self, start=0: (read.append(each.time) or each for each in images(self, start)),
    )
    for number in (190, 20, 21, 22, 19, 18):
        recording.frame(number)
    assert len(read) < 100
    assert np.array_equal(recording.frame(150).color[0, 0], [50, 51, 52])


def test_images_of_one_time(tmp_path: Path) -> None:
    """It proves that images that were recorded at one time are told apart."""
    sent = [
        raw("/a", START + at * SECOND // 30, color(at), "bgr8", recorded=START + at // 5 * SECOND // 6)
        for at in range(30)
    ]
    recording = RecordedFrames(open_source(bag1(tmp_path, sent)))
    for number in (17, 3, 29, 16, 0):
        image = recording.frame(number).color
        assert image is not None
        assert image[0, 0, 0] == number


def test_a_damaged_image_is_named(tmp_path: Path) -> None:
    """It proves that a frame that can't be decoded is an error of one line, and that others are there."""
    from tests.data.recordings.written import compressed, jpeg

    sent = [
        compressed(
            "/a/compressed", START + at * SECOND // 30, jpeg(color(9 * at)) if at != 4 else b"no", "jpeg"
        )
        for at in range(8)
    ]
    recording = RecordedFrames(open_source(bag1(tmp_path, sent)))
    with pytest.raises(ValueError, match="can't be decoded"):
        recording.frame(4)
    assert [number for number, _ in recording.frames(0, 8)] == [0, 1, 2, 3, 5, 6, 7]


PEAK = """
import sys, tracemalloc
from pathlib import Path
from tricue.app.frames import RecordedFrames
from tricue.data.open_source import open_source
from tricue.data.recordings import seekable
seekable.KEPT_BYTES = 2 << 20
tracemalloc.start()
recording = RecordedFrames(open_source(Path(sys.argv[1])))
for number in [*range(recording.length), *reversed(range(recording.length))]:
    recording.frame(number)
print(tracemalloc.get_traced_memory()[1])
"""


def test_memory_is_bounded(tmp_path: Path) -> None:
    """It proves that looking at all frames of a recording of four times the length takes no more memory.

    It is measured in a process of its own, as other tests' threads allocate, too.
    """
    peaks = []
    for count in (60, 240):
        folder = tmp_path / str(count)
        folder.mkdir()
        command = [sys.executable, "-c", PEAK, bag1(folder, apart(count))]
        peaks.append(int(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
    assert peaks[1] < 1.3 * peaks[0] + 1e6
