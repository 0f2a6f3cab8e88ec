# SPDX-License-Identifier: MIT
"""Writes any recording that tricue reads as a VOT sequence.

Source: the layout is what vot-toolkit 0.7.4 reads, vot/dataset/common.py.
"""

import shutil
from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.data.depth_images import METERS_PER_MILLIMETER, DepthReader
from tricue.data.open_source import Source
from tricue.data.streams import Images, Stream, read_color
from tricue.draw.writable import naming
from tricue.evaluation.dataset import Entry, OpenedSequence
from tricue.evaluation.toolkits.millimeters import to_millimeters

ANCHOR_INTERVAL = 50  # frames between starts of the multistart experiment, as in VOT2020
ABSENT = "nan,nan,nan,nan"
_SUFFIXES = {".jpg": ".jpg", ".jpeg": ".jpg", ".png": ".png"}  # the toolkit's, by the file's
_LINKABLE_READERS = {"color": read_color, "depth": DepthReader(METERS_PER_MILLIMETER)}


def vot_channels(source: Source) -> tuple[tuple[str, ...], str]:
    """The channels, color or depth, that VOT can use, and a note about one that is left out.

    VOT assumes that all channels have the same pixels. If depth isn't registered to color, only the channel
    in whose pixels the true boxes are is used. Depth is left out if its size differs from the color images'.
    """
    there = tuple(name for name in ("color", "depth") if name in source.channels)
    opened = OpenedSequence(Entry(source.name, Path()), source)
    if len(there) == 2 and not opened.registered:
        kept, other = opened.channel, "color" if opened.channel == "depth" else "depth"
        reason = f"depth isn't registered to color, and the true boxes are those of the {kept} image"
        return (kept,), f"left out the {other} of {source.name}: {reason}"
    sizes = [source.channels[name].size for name in there]
    if len(set(sizes)) < 2:
        return there, ""
    color, depth = (f"{width}x{height}" for width, height in sizes)
    return ("color",), f"left out the depth of {source.name}: it is {depth} pixels, not the color's {color}"


def write_sequence(source: Source, folder: Path) -> int:
    """Write the channels of :func:`vot_channels`, true boxes, anchors and tags; return the number of frames.

    Images that the toolkit and tricue read identically are linked, or copied if links aren't possible. Others
    become PNG files, depth in 16-bit millimeters. The folder must not exist; it is removed after an error.
    ValueError for fewer than two frames, and for channels of different length.
    """
    folder.mkdir(parents=True)
    try:
        return _write(source, folder)
    except BaseException:
        shutil.rmtree(folder)
        raise


def _write(source: Source, folder: Path) -> int:
    names, _ = vot_channels(source)
    written = {name: _write_channel(source.channels[name], name, folder / name) for name in names}
    counts = {name: count for name, (_, count) in written.items()}
    count = min(counts.values())
    if count < 2 or count != max(counts.values()):
        raise ValueError(f"{source.name}: expected two frames or more, of each channel as many, got {counts}")
    width, height = source.channels[names[0]].size
    patterns = [f"channels.{name}={name}/%08d{suffix}" for name, (suffix, _) in written.items()]
    about = {
        "name": folder.name,
        "fps": max(1, round(source.fps)),  # the toolkit takes only whole numbers
        "format": "default",
        "channel.default": names[0],
        "width": width,
        "height": height,
        "length": count,
    }
    _write_lines(folder / "sequence", [*(f"{key}={value}" for key, value in about.items()), *patterns])
    boxes = _boxes(source.truth, count)
    visible = np.asarray(np.isfinite(boxes).all(axis=1))
    _write_lines(folder / "groundtruth.txt", map(_line, boxes))
    _write_lines(folder / "anchor.value", anchors(visible))
    _write_lines(folder / "absent.tag", (~visible).astype(int))
    return count


def anchors(visible: NDArray[np.bool_]) -> list[int]:
    """The starts of the multistart experiment, a number per frame: 1 forward, -1 backward, 0 elsewhere.

    In every ANCHOR_INTERVAL frames there is one, in the first with a visible target, toward the longer part.
    """
    values = [0] * len(visible)
    for first in range(0, len(visible), ANCHOR_INTERVAL):
        seen = np.flatnonzero(visible[first : first + ANCHOR_INTERVAL])
        if seen.size:
            frame = first + int(seen[0])
            values[frame] = 1 if len(visible) - 1 - frame > frame else -1
    return values


def _boxes(truth: NDArray[np.float64] | None, count: int) -> NDArray[np.float64]:
    """The true boxes (count, 4), NaN in frames without one."""
    boxes = np.full((count, 4), np.nan)
    if truth is not None:
        boxes[: len(truth)] = truth[:count]
    return boxes


def _line(box: NDArray[np.float64]) -> str:
    """A line of groundtruth.txt, with the protocol's four decimals."""
    return ABSENT if np.isnan(box).any() else ",".join(f"{number:.4f}" for number in box.tolist())


def _write_channel(stream: Stream, name: str, folder: Path) -> tuple[str, int]:
    """Write a channel's images; return their suffix and number."""
    folder.mkdir()
    suffix, count = _linked_suffix(stream, name), 0
    if isinstance(stream, Images) and suffix:
        for count, path in enumerate(stream.paths, 1):
            _link(path, folder / f"{count:08}{suffix}")
        return suffix, count
    for count, (_, image) in enumerate(stream, 1):
        path = folder / f"{count:08}.png"
        if not cv2.imwrite(str(path), to_millimeters(image) if name == "depth" else image):
            raise OSError(f"{path}: can't be written")
    return ".png", count


def _linked_suffix(stream: Stream, name: str) -> str:
    """The suffix of images that can be linked; "" if they must be converted."""
    if not isinstance(stream, Images) or stream.read != _LINKABLE_READERS[name]:
        return ""
    suffixes = {_SUFFIXES.get(path.suffix.lower(), "") for path in stream.paths}
    suffix = suffixes.pop()
    return "" if suffixes or (name == "depth" and suffix != ".png") else suffix


def _link(path: Path, link: Path) -> None:
    if not path.is_file():
        raise FileNotFoundError(f"{path}: there is no such file")
    try:
        link.symlink_to(path.resolve())
    except (NotImplementedError, OSError):  # no links on this file system, or no permission on Windows
        shutil.copyfile(path, link)


def _write_lines(path: Path, lines: Iterable[object]) -> None:
    with naming(path):
        path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
