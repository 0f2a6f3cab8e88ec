# SPDX-License-Identifier: MIT
"""Recordings in each of the formats, and what is read from them."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from tricue import Frame
from tricue.data.source import Source

from tests.data.recordings.written import (
    Sent,
    write_bag1,
    write_bag2,
    write_mcap,
)

Writer = Callable[[Path, Sequence[Sent]], Path]
COLOR, DEPTH = "/camera/color/image_raw", "/camera/depth/image_rect_raw"


def bag1(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 1 bag."""
    return write_bag1(folder / "a.bag", sent)


def sqlite(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 2 folder with a database."""
    return write_bag2(folder / "b", sent)


def ros2_mcap(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 2 folder with an MCAP file."""
    return write_bag2(folder / "c", sent, "mcap")


def mcap(folder: Path, sent: Sequence[Sent]) -> Path:
    """An MCAP file alone."""
    return write_mcap(folder / "d.mcap", sent)


WRITERS = [bag1, sqlite, ros2_mcap, mcap]


def blues(frames: Iterable[Frame]) -> list[int]:
    """The blue of each frame's color."""
    return [int(frame.color[0, 0, 0]) for frame in frames if frame.color is not None]


def meters(source: Source) -> list[float]:
    """The depth in the middle of each frame."""
    return [float(frame.depth[12, 16]) for frame in source if frame.depth is not None]
