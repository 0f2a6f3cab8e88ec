# SPDX-License-Identifier: MIT
"""Files of true boxes.

OTB's groundtruth_rect.txt counts pixels from 1. The groundtruth.txt of VOT, GOT-10k and LaSOT is assumed to
count from 0. Princeton has <sequence>.txt, which is public for few sequences, and init.txt with the first box
alone. Folders without these files may have a table, boxes.csv; see :mod:`tricue.data.box_table`.
"""

import math
import re
from array import array
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.box import MAX_COORDINATE
from tricue.camera.text import lines_of, read_lines

OTB_TRUTH, VOT_TRUTH, PRINCETON_FIRST_BOX = "groundtruth_rect.txt", "groundtruth.txt", "init.txt"
ABSENT_TAGS = ("absent.tag", "absence.label", "full_occlusion.txt", "out_of_view.txt")
"""Files of VOT, GOT-10k and LaSOT (the last two): a number per frame, 1 where the target can't be seen."""
_WHOLE_TAGS = ABSENT_TAGS[1:]  # have a number per box; in VOT's, a missing number means 0
MAX_FRAME_NUMBER = 10_000_000  # a day at 100 frames per second; larger numbers are refused
MAX_VALUE = 1e9  # pixels, meters or millimeters; larger values are refused
DEPTHS_FILE = (
    "position_z_mm.txt"  # one line per frame: the target's median depth in millimeters, 0 or NaN if unknown
)
Box = TypeVar("Box", bound=Sequence[float])
_OTB_TARGET_TRUTH = re.compile(r"groundtruth_rect\.(\d+)\.txt")  # in folders with several targets


class Truth(NamedTuple):
    """What is known about the target, one row per frame; after the last row nothing is known.

    boxes: (M, 4) x, y, width, height, pixels from 0, NaN where absent or unknown. absent: (M,) whether the
    target is known to be out of sight. positions: (K, 3) X, Y, Z in meters in the camera's frame, NaN where
    unknown; None without any.
    """

    boxes: NDArray[np.float64]
    absent: NDArray[np.bool_]
    positions: NDArray[np.float64] | None = None


def truth_from_rows(boxes: ArrayLike) -> Truth:
    """The truth from the rows (M, 4) of a file; NaN, or a width or height of 0, means that it is absent."""
    rows = np.array(boxes, np.float64).reshape(-1, 4)
    there = np.isfinite(rows).all(axis=1) & (rows[:, 2:] > 0).all(axis=1)
    absent: NDArray[np.bool_] = np.logical_not(there)
    rows[absent] = np.nan
    return Truth(rows, absent)


def find_truth(folder: Path, target: str | None = None) -> Truth | None:
    """The truth of a sequence folder in OTB's or VOT's format, with the tags and depths beside it.

    target: one of :func:`otb_targets`; by default the file without a number is read, or else the first
    target's. None without a file. ValueError names the file and its line, or the targets of the folder.
    """
    path = _truth_path(folder, target)
    if path is None:
        return None
    truth = read_truth_file(path)
    return add_tags_and_depths(truth, folder, len(truth.boxes))


def find_princeton_truth(folder: Path) -> Truth | None:
    """The truth of a sequence of the Princeton Tracking Benchmark, whose lines have more than the box."""
    names = (f"{folder.resolve().name}.txt", PRINCETON_FIRST_BOX)
    path = next((folder / name for name in names if (folder / name).is_file()), None)
    return None if path is None else add_tags_and_depths(read_truth_file(path, count=4), folder)


def otb_targets(folder: Path) -> tuple[str, ...]:
    """The numbers in the file names groundtruth_rect.1.txt and so on, in OTB's folders of several targets."""
    names = (_OTB_TARGET_TRUTH.fullmatch(path.name) for path in folder.iterdir())
    return tuple(sorted((name[1] for name in names if name), key=int))


def truth_files(folder: Path) -> list[Path]:
    """All files that this module reads in a folder."""
    names = [OTB_TRUTH, VOT_TRUTH, *ABSENT_TAGS, DEPTHS_FILE]
    names += [PRINCETON_FIRST_BOX, f"{folder.resolve().name}.txt"]
    names += [f"groundtruth_rect.{target}.txt" for target in otb_targets(folder)]
    return [folder / name for name in names if (folder / name).is_file()]


def add_tags_and_depths(truth: Truth, folder: Path, rows: int = 0) -> Truth:
    """The truth with the tags of absent frames and the depths, if the folder has files of these.

    rows: the number of boxes in the benchmark's file. LaSOT and GOT-10k must have as many tags, else
    ValueError names the file of tags; except if there is only the first box, as in test sets.
    """
    for path in (folder / name for name in ABSENT_TAGS):
        if path.is_file():
            tag = _read_tag(path)
            if path.name in _WHOLE_TAGS and 1 < rows != len(tag):
                raise ValueError(f"{path}: expected {rows} numbers, one for each true box, got {len(tag)}")
            truth = _apply_tag(truth, tag)
    if truth.positions is None and (folder / DEPTHS_FILE).is_file():
        depths = _read_depths(folder / DEPTHS_FILE)
        unknown = np.full(len(depths), np.nan)
        truth = truth._replace(positions=np.stack([unknown, unknown, depths], axis=1))
    return truth


def read_truth_file(path: str | Path, count: int | None = None) -> Truth:
    """Read a file with one box per line: x, y, width, height; the result counts pixels from 0.

    Commas, tabs, semicolons or blanks separate the numbers. VOT's polygons and masks become their bounding
    boxes. count: how many numbers of a line to read; by default all. ValueError names a line with anything
    else, and the first for shares of the image in place of pixels.
    """
    path, numbers = Path(path), array("d")  # millions of tuples would take gigabytes
    for number, line in enumerate(lines_of(path), 1):
        numbers.extend(_true_box(line, f"{path}, line {number}", count))
    truth = truth_from_rows(numbers)
    refuse_shares(truth, f"{path}, line 1")
    if path.name == OTB_TRUTH or _OTB_TARGET_TRUTH.fullmatch(path.name):
        return truth._replace(boxes=truth.boxes - [1, 1, 0, 0])
    return truth


def _truth_path(folder: Path, target: str | None) -> Path | None:
    names, several = [OTB_TRUTH, VOT_TRUTH], otb_targets(folder)
    if target is not None:
        check_target(target, several, folder)
        names = [f"groundtruth_rect.{target}.txt"]
    elif several:
        names.append(f"groundtruth_rect.{several[0]}.txt")
    return next((folder / name for name in names if (folder / name).is_file()), None)


def check_target(target: str, known: Sequence[str], place: str | Path) -> None:
    """Raise ValueError, which lists the known targets, if a place (a folder, a file, a camera) lacks one."""
    if target not in known:
        if not known:
            raise ValueError(f"{place}: expected no target, as it has only one, got {target!r}; leave it out")
        listed = ", ".join(map(repr, known))
        raise ValueError(f"{place}: expected target to be one of {listed}, got {target!r}")


def read_box(line: str, place: str, count: int | None = None) -> tuple[float, ...]:
    """The box x, y, width, height around a line's region, NaN for none; see :func:`read_truth_file`."""
    words = re.split(r"[,;\s]+", line.strip().removeprefix("m"))
    words = words[: 4 if line.strip().startswith("m") else count]
    try:
        numbers = tuple(map(float, words))
    except ValueError:
        numbers = ()
    if not any(map(math.isinf, numbers)):
        if any(map(math.isnan, numbers)):
            return (math.nan,) * 4
        if len(numbers) == 4:
            return numbers
        if len(numbers) >= 6 and len(numbers) % 2 == 0:
            xs, ys = numbers[::2], numbers[1::2]
            return min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)
    raise ValueError(f"{place}: expected four numbers x, y, width, height, got {line.strip()!r:.60}")


def _true_box(line: str, place: str, count: int | None) -> tuple[float, ...]:
    """As :func:`read_box`; ValueError, too, for a negative width or height, as in a file of corners."""
    return check_sizes(read_box(line, place, count), place, line)


def check_sizes(box: Box, place: str, line: str) -> Box:
    """The box x, y, width, height of a line; unless it has NaN, ValueError for a negative width or height and
    for numbers beyond a million pixels.
    """
    if any(map(math.isnan, box)):
        return box
    if min(box[2:]) < 0:
        raise ValueError(f"{place}: expected a width and height of 0 or more, got {line.strip()!r:.60}")
    if max(map(abs, box)) > MAX_COORDINATE:
        raise ValueError(f"{place}: expected at most a million pixels, got {line.strip()!r:.60}")
    return box


def refuse_shares(truth: Truth, place: str) -> None:
    """ValueError names the place if boxes, not moved yet, are shares of the image: no number is above 1, and
    one is narrower or lower than a pixel. Those of a target of one pixel in the image's corner aren't.
    """
    boxes = truth.boxes[~truth.absent]
    if boxes.size and np.abs(boxes).max() <= 1 and boxes[:, 2:].min() < 1:
        raise ValueError(
            f"{place}: expected boxes in pixels, got no number above 1, as in shares of the image; multiply "
            "them by its width and height"
        )


def _apply_tag(truth: Truth, tag: NDArray[np.bool_]) -> Truth:
    """The truth with tagged frames absent, too; tags after the last box extend it."""
    count = max(len(truth.boxes), len(tag))
    boxes, absent = np.full((count, 4), np.nan), np.zeros(count, np.bool_)
    boxes[: len(truth.boxes)], absent[: len(truth.absent)] = truth.boxes, truth.absent
    absent[: len(tag)] |= tag
    boxes[absent] = np.nan
    return Truth(boxes, absent, truth.positions)


def _read_tag(path: Path) -> NDArray[np.bool_]:
    """The tags (M,), one per line, or, as in LaSOT, all on one line."""
    tags = []
    for number, line in enumerate(read_lines(path), 1):
        for word in re.split(r"\s*,\s*|\s+", line.strip()):
            if word not in ("0", "1"):
                raise ValueError(
                    f"{path}, line {number}: expected 0, or 1 for an absent target, got {word!r:.60}"
                )
            tags.append(word == "1")
    return np.array(tags, np.bool_)


def _read_depths(path: Path) -> NDArray[np.float64]:
    """Depths (M,) in meters, NaN where unknown."""
    depths = []
    for number, line in enumerate(read_lines(path), 1):
        try:
            depth = float(line)
        except ValueError:
            depth = -1.0
        if depth < 0 or depth > MAX_VALUE:
            raise ValueError(
                f"{path}, line {number}: expected a depth in millimeters, 0 if unknown, got {line!r:.60}"
            )
        depths.append(depth / 1000 if depth > 0 else np.nan)
    return np.array(depths, np.float64)
