# SPDX-License-Identifier: MIT
"""True boxes in a table, CSV: boxes.csv in a folder, or clip.csv beside the video clip.mp4.

With a header the columns are known by their names, as ``tricue track --csv`` writes them; without one they
are x, y, width, height, or these behind the frame's number.
"""

import csv
import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.data.truth import Truth, text_lines, truth_of

TABLE = "boxes.csv"
LONGEST = 10_000_000  # frames, a day at 100 a second; a number above isn't meant as a frame's
_BOX = ("x", "y", "width", "height")
_TRACK = ("status", "score")  # columns of tricue track --csv
_METRES = ("x_m", "y_m", "z_m")
_SHORT = {"w": "width", "h": "height"}
_PLAIN = {4: _BOX, 5: ("frame", *_BOX)}


class _Row(NamedTuple):
    """A line's values by the columns' names, and what names the line in an error."""

    cells: Mapping[str, str]
    place: str

    def number(self, column: str) -> float:
        """The value, NaN for an empty cell."""
        text = self.cells.get(column, "")
        try:
            value = float(text) if text else math.nan
        except ValueError:
            value = math.inf
        if math.isinf(value):
            raise ValueError(f"{self.place}: expected a number {column}, got {text!r:.60}")
        return value

    def box(self) -> list[float]:
        """x, y, width, height; all are there or none is, which tells a row that is cut off."""
        empty = [name for name in _BOX if not self.cells[name]]
        if 0 < len(empty) < len(_BOX):
            raise ValueError(f"{self.place}: expected all of x, y, width, height or none, got no {empty[0]}")
        return [self.number(name) for name in _BOX]


def read_table(path: Path) -> Truth:
    """The boxes of a table, pixels from 0, and the target's positions where there are X_m, Y_m or Z_m.

    A row a frame, in order, unless there is a column ``frame`` that counts them from 0; frames that have no
    row are unknown. Empty cells, NaN, and a width or height of 0 say that the target is absent. Other columns
    are left out. ValueError names the file and the line.
    """
    rows = _rows(path)
    frames = _frames(rows)
    length = max(frames, default=-1) + 1
    given = truth_of([row.box() for row in rows])
    boxes, absent = np.full((length, 4), np.nan), np.zeros(length, np.bool_)
    boxes[frames], absent[frames] = given.boxes, given.absent
    return Truth(boxes, absent, _positions(rows, frames, length))


def find_table(folder: Path, video: Path | None = None) -> Path | None:
    """boxes.csv in the folder, or the table of its one video."""
    path = folder / TABLE
    return path if path.is_file() else None if video is None else video_table(video)


def video_table(video: Path) -> Path | None:
    """The table beside a video, of its name; None too where its header says that it is about other things, or
    that a tracker wrote it, whose boxes aren't true.
    """
    path = video.with_suffix(".csv")
    if not path.is_file():
        return None
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        names = _names(_cells(file.readline(10_000)))
    if names is None:
        return path
    return path if {"x", "y"} <= set(names) and not set(_TRACK) <= set(names) else None


def _rows(path: Path) -> list[_Row]:
    lines = text_lines(path)
    first = _cells(lines[0]) if lines else []
    names = _names(first)
    start = 0 if names is None else 1
    columns = names or _PLAIN.get(len(first), ())
    if lines and (not set(_BOX) <= set(columns) or len(set(columns)) < len(columns)):
        raise ValueError(
            f"{path}, line 1: expected columns x, y, width, height, each once, got {lines[0].strip()!r:.60}"
        )
    rows = []
    for number, line in enumerate(lines[start:], start + 1):
        cells, place = _cells(line), f"{path}, line {number}"
        if len(cells) != len(columns):
            raise ValueError(f"{place}: expected {len(columns)} values, got {line.strip()!r:.60}")
        rows.append(_Row(dict(zip(columns, cells, strict=True)), place))
    return rows


def _cells(line: str) -> list[str]:
    """The values of a line, parted by commas, or else semicolons or tabs."""
    parting = next((mark for mark in ",;\t" if mark in line), ",")
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=parting), [])]
    except csv.Error:  # a cell of more than csv's limit
        return []


def _names(cells: list[str]) -> tuple[str, ...] | None:
    """The columns' names in small letters, None where the line holds values."""
    if all(not cell or _is_number(cell) for cell in cells):
        return None
    small = (cell.lstrip("# ").lower() for cell in cells)
    return tuple(_SHORT.get(name, name) for name in small)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _frames(rows: list[_Row]) -> list[int]:
    """The frame of each row."""
    if not rows or "frame" not in rows[0].cells:
        return list(range(len(rows)))
    frames: dict[int, str] = {}
    for row in rows:
        number = row.number("frame")
        if not (0 <= number < LONGEST and number.is_integer()):
            raise ValueError(
                f"{row.place}: expected a frame's whole number from 0, got {row.cells['frame']!r:.60}"
            )
        if int(number) in frames:
            raise ValueError(f"{row.place}: expected each frame once, got {int(number)} again")
        frames[int(number)] = row.place
    return list(frames)


def _positions(rows: list[_Row], frames: list[int], length: int) -> NDArray[np.float64] | None:
    """The positions in metres; None without any, as in the columns of a tracker that knows none."""
    given = np.array([[row.number(name) for name in _METRES] for row in rows]).reshape(-1, 3)
    if np.isnan(given).all():
        return None
    positions = np.full((length, 3), np.nan)
    positions[frames] = given
    return positions
