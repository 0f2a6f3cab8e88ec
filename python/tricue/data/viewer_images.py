# SPDX-License-Identifier: MIT
"""Folders written by cameras' viewers: color and depth images side by side, paired by the numbers in their
names.

Examples are RealSense's ``rs_Color_1.png`` and ``rs_Depth_1.png``, ``frame-000000.color.jpg`` and
``.depth.png``, ``rgb_17.png`` and ``depth_17.png``.
"""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tricue.data.depth_images import DepthReader, is_depth
from tricue.data.files import image_paths
from tricue.data.streams import Images, Stream, timed_images
from tricue.data.tum import match_times

MAX_SAMPLED = 200  # images whose bits are checked
_WORD = r"(?<![a-z])({})(?![a-z])"
_DEPTH, _COLOR = (re.compile(_WORD.format(words), re.IGNORECASE) for words in ("depth", "colou?r|rgb"))
_FIRST_TIME = 1e9  # a larger number is a time since 1970; its size tells the unit: s, ms, us, ns
_PNG_HEADER = b"\x89PNG"


def read_channels(folder: Path, scale: float | None) -> tuple[dict[str, Stream], tuple[str, ...]] | None:
    """Color and depth, paired by equal numbers or the nearest times, and notes; None unless both are there.

    scale: meters per unit of depth; without it, depth is left out, with a note. ValueError if images of both
    kinds can't be paired, because then they aren't one sequence.
    """
    paths = image_paths(folder)
    color, depth = _by_name(paths) or _by_pixels(paths)
    if not (color and depth):
        return None
    pairs, timed = _pairs(folder, color, depth)
    notes = _notes(len(paths), len(color), len(depth), len(pairs))
    first, second = [color[i] for i, _ in pairs], [depth[j] for _, j in pairs]
    channels: dict[str, Stream] = {}
    if timed:
        unit = _seconds_per_unit(_number(first[0]))
        channels["color"] = timed_images([(unit * _number(path), path) for path in first])
    else:
        channels["color"] = Images(first)
    if not is_depth(second[0]):
        return channels, (*notes, f"left out {second[0].name} and others: 8 bits are a picture of depth")
    if scale is None:
        unit_of = "depth_scale gives its meters per unit, 0.001 for millimeters"
        return channels, (*notes, f"left out {second[0].name} and others: {unit_of}")
    channels["depth"] = Images(second, read=DepthReader(scale))
    return channels, notes


def _by_name(paths: Sequence[Path]) -> tuple[list[Path], list[Path]] | None:
    """Color and depth images by the words in their names; None unless there are both."""
    depth = [path for path in paths if _DEPTH.search(path.stem)]
    color = [path for path in _others(paths, depth) if _COLOR.search(path.stem)]
    return (color, depth) if color and depth else None


def _by_pixels(paths: Sequence[Path]) -> tuple[list[Path], list[Path]]:
    """Color and depth images by their bits: depth images are one channel of 16 bits."""
    chosen = np.linspace(0, len(paths) - 1, min(MAX_SAMPLED, len(paths))).round().astype(int)
    if len({_has_16_bits(paths[index]) for index in chosen}) < 2:
        return [], []
    depth = [path for path in paths if _has_16_bits(path)]
    return _others(paths, depth), depth


def _others(paths: Sequence[Path], chosen: Sequence[Path]) -> list[Path]:
    known = set(chosen)
    return [path for path in paths if path not in known]


def _has_16_bits(path: Path) -> bool:
    """Whether an image is one channel of 16 bits; for PNG, by its header alone."""
    with path.open("rb") as file:
        header = file.read(26)
    if header.startswith(_PNG_HEADER):
        return header[24:26] == b"\x10\x00"
    return path.suffix.lower() in (".pgm", ".tif", ".tiff") and is_depth(path)


def _pairs(folder: Path, color: Sequence[Path], depth: Sequence[Path]) -> tuple[list[tuple[int, int]], bool]:
    """Pairs of indices, and whether the numbers are times. ValueError if there are no pairs."""
    first, second = ([_number(path) for path in paths] for paths in (color, depth))
    pairs: list[tuple[int, int]] = []
    timed = min(*first, *second) >= _FIRST_TIME
    if all(len(set(numbers)) == len(numbers) for numbers in (first, second)):
        places = {number: place for place, number in enumerate(second)}
        pairs = [(place, places[number]) for place, number in enumerate(first) if number in places]
        if timed and len(pairs) < min(len(first), len(second)):
            order = [sorted(range(len(numbers)), key=numbers.__getitem__) for numbers in (first, second)]
            step = float(np.median(np.diff(sorted(first)))) if len(first) > 1 else 0.0
            close = match_times(sorted(first), sorted(second), step / 2)
            pairs = [(order[0][i], order[1][j]) for i, j in close]
    if not pairs:
        raise ValueError(
            f"{folder}: expected images of one kind, found {len(color)} of color and {len(depth)} of depth "
            f"whose names don't pair them; put depth in {folder / 'depth'}, color in {folder / 'color'}"
        )
    return pairs, timed


def _number(path: Path) -> float:
    """The last number in the name; -1 without one."""
    numbers = re.findall(r"\d+(?:\.\d+)?", path.stem)
    return float(numbers[-1]) if numbers else -1.0


def _seconds_per_unit(time: float) -> float:
    """Seconds per unit of a time since 1970: seconds have 10 digits, milliseconds 13, and so on."""
    return float(10.0 ** -(3 * min(3, max(0, (len(str(int(time))) - 10) // 3))))


def _notes(found: int, color: int, depth: int, pairs: int) -> tuple[str, ...]:
    alone = {"color": color - pairs, "depth": depth - pairs, "other": found - color - depth}
    total = {"color": color, "depth": depth, "other": found - color - depth}
    counts = [f"{count} of {total[kind]} {kind}" for kind, count in alone.items() if count]
    return (f"left out {' and '.join(counts)} images, which have no partner",) if counts else ()
