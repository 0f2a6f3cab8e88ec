# SPDX-License-Identifier: MIT
"""The files that a source is read from, which must not be overwritten."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from tricue.data.box_table import find_box_table, find_video_box_table
from tricue.data.joint import JointStream
from tricue.data.layouts import layout_files
from tricue.data.source import Source
from tricue.data.streams import Images, Stream, Video
from tricue.data.truth import truth_files


def input_files(source: Source, *places: Path) -> Iterator[Path]:
    """The source's images, videos, recordings and calibration, and the true boxes and lists at its places."""
    for stream in source.channels.values():
        yield from stream_files(stream)
    if source.calibration is not None:
        yield source.calibration
    color = source.channels.get("color")
    video = color.path if isinstance(color, Video) else None  # in a folder, a table may be beside it
    for place in places:
        if place.is_dir():
            yield from truth_files(place)
            yield from layout_files(place)
        table = find_box_table(place, video) if place.is_dir() else find_video_box_table(place)
        if table is not None:
            yield table


def stream_files(stream: Stream) -> Sequence[Path]:
    """The files of a stream; none for a camera."""
    if isinstance(stream, Images):
        return stream.paths
    if isinstance(stream, JointStream):
        return stream.joint.paths
    return [stream.path] if isinstance(stream, Video) else []
