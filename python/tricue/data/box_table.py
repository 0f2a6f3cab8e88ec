# SPDX-License-Identifier: MIT
"""True boxes in a CSV table: boxes.csv in a folder, or clip.csv beside the video clip.mp4.

A header names the columns, as in the tables of ``tricue track --csv``, or the boxes' centers or corners.
Without a header they are x, y, width, height, or the frame number followed by these.
"""

import csv
import math
import re
from array import array
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.text import lines_of, open_text
from tricue.data.files import is_video
from tricue.data.truth import (
    MAX_FRAME_NUMBER,
    MAX_VALUE,
    Truth,
    check_sizes,
    refuse_shares,
    truth_from_rows,
)

BOX_TABLE = "boxes.csv"
_BOX_COLUMNS = ("x", "y", "width", "height")
_CENTER_COLUMNS = ("cx", "cy", "width", "height")
_CORNER_COLUMNS = (
    ("x1", "y1", "x2", "y2"),
    ("xmin", "ymin", "xmax", "ymax"),
    ("left", "top", "right", "bottom"),
)
"""Names of a box's left, top, right and bottom edge, pixels."""
_TRACKER_COLUMNS = ("status", "score")  # columns that tricue track --csv writes
_POSITION_COLUMNS = ("x_m", "y_m", "z_m")
_OTHER_NAMES = {"w": "width", "h": "height"}
_OTHER_NAMES |= {f"{axis}_{end}": f"{axis}{end}" for axis in "xy" for end in ("min", "max")}
_OTHER_NAMES |= {
    name: f"c{axis}"
    for axis in "xy"
    for name in (f"{axis}_center", f"{axis}center", f"center_{axis}", f"center{axis}", f"{axis}c")
}
_FRAME_NAMES = ("frame", *(f"frame_{end}" for end in ("number", "index", "idx", "no", "id")))
"""Names of the column of frame numbers; if a table has several, the first counts."""
_FILE_NAMES = ("filename", "file_name", "file", "image", "image_name", "image_file", "image_path")
"""Names of the column of the images' files; it counts if its first cell is one of the images."""
_DECIMAL_COMMA = re.compile(r"([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)")
_HEADERLESS_COLUMNS = {4: _BOX_COLUMNS, 5: ("frame", *_BOX_COLUMNS)}


class _Row(NamedTuple):
    """One line of a table: its values by column name, the columns of the box, and its file and line for
    errors.
    """

    cells: Mapping[str, str]
    box_columns: Sequence[str]
    place: str

    def number(self, column: str) -> float:
        """The number in a column, NaN for an empty cell."""
        text = self.cells.get(column, "")
        try:
            value = float(text) if text else math.nan
        except ValueError:
            value = math.inf
        if math.isinf(value) or (column in _POSITION_COLUMNS and abs(value) > MAX_VALUE):
            raise ValueError(f"{self.place}: expected a number {column}, got {text!r:.60}")
        return value

    def box(self) -> list[float]:
        """Left and top edge, width, height. ValueError if only some are there, as in a truncated row."""
        names = self.box_columns
        empty = [name for name in names if not self.cells[name]]
        if 0 < len(empty) < len(names):
            raise ValueError(f"{self.place}: expected all of {', '.join(names)} or none, got no {empty[0]}")
        left, top, width, height = map(self.number, names)
        if names in _CORNER_COLUMNS:
            width, height = width - left, height - top
        elif names == _CENTER_COLUMNS:
            left, top = left - width / 2, top - height / 2
        return check_sizes([left, top, width, height], self.place, ",".join(self.cells.values()))


def read_box_table(path: str | Path, images: Sequence[str] = ()) -> Truth:
    """The boxes in a table, pixels from 0, and the target's positions if there are columns x_m, y_m or z_m.

    Each row is one frame, in order, unless a column ``frame`` (or ``frame_number``, and the like) gives its
    number from 0, or a column ``filename`` or ``image`` its image's name; frames without a row are unknown.
    Empty cells, NaN, or a width or height of 0 mean that the target is absent. Other columns are ignored.
    images: the names of the frames' files, in order. ValueError names the file and the line, also for shares
    of the image in place of pixels.
    """
    frames, numbers, places = (
        _Frames(images),
        array("d"),
        array("d"),
    )  # millions of lists would take gigabytes
    first = ""
    for row in _rows(Path(path)):
        first = first or row.place
        frames.add(row)
        numbers.extend(row.box())
        places.extend(map(row.number, _POSITION_COLUMNS))
    given = truth_from_rows(numbers)
    refuse_shares(given, first)
    boxes, absent = np.full((frames.length, 4), np.nan), np.zeros(frames.length, np.bool_)
    boxes[frames.numbers], absent[frames.numbers] = given.boxes, given.absent
    return Truth(boxes, absent, _positions(places, frames))


def find_box_table(folder: Path, video: Path | None = None) -> Path | None:
    """boxes.csv in the folder, or the table beside its only video; None without either.

    A boxes.csv that begins with a video's name isn't the folder's: it lists boxes of several videos.
    """
    path = folder / BOX_TABLE
    if path.is_file() and not _lists_videos(path):
        return path
    return None if video is None else find_video_box_table(video)


def find_video_box_table(video: Path) -> Path | None:
    """The table with a video's name beside it.

    None if there is none, if its header names no x and y, centers or corners of boxes, or if a tracker wrote
    it, whose boxes aren't true ones.
    """
    path = video.with_suffix(".csv")
    if not path.is_file():
        return None
    names = _names(_first_cells(path))
    if names is None:
        return path
    lists_boxes = {"x", "y"} <= set(names) or _box_columns(names)
    return path if lists_boxes and not set(_TRACKER_COLUMNS) <= set(names) else None


def _lists_videos(path: Path) -> bool:
    """Whether a table's first line begins with a video's name; False if it can't be read."""
    try:
        return is_video(Path(next(iter(_first_cells(path)), "")))
    except OSError:
        return False


def _rows(path: Path) -> Iterator[_Row]:
    delimiter: str | None = None
    columns: tuple[str, ...] = ()
    of_box: tuple[str, ...] = ()
    for number, line in enumerate(lines_of(path), 1):
        if number == 1:
            delimiter = _delimiter(line)
        cells, place = _cells(line, delimiter), f"{path}, line {number}"
        if number == 1:
            names = _names(cells)
            columns = names or _HEADERLESS_COLUMNS.get(len(cells), ())
            of_box = _box_columns(columns)
            if not of_box or len(set(columns)) < len(columns):
                raise ValueError(
                    f"{place}: expected columns x, y, width, height or cx, cy, width, height "
                    f"or x1, y1, x2, y2, each once, got {line.strip()!r:.60}"
                )
            if names:
                continue
        if len(cells) != len(columns):
            raise ValueError(f"{place}: expected {len(columns)} values, got {line.strip()!r:.60}")
        yield _Row(dict(zip(columns, cells, strict=True)), of_box, place)


def _first_cells(path: Path) -> list[str]:
    """The values of a table's first line."""
    with open_text(path) as file:
        line = file.readline(10_000)
    return _cells(line, _delimiter(line))


def _delimiter(line: str) -> str | None:
    """What separates the values of a table with this first line: semicolons, beside which commas are of
    decimals, tabs or commas; None for blanks.
    """
    return next((mark for mark in ";\t," if mark in line), None)


def _cells(line: str, delimiter: str | None) -> list[str]:
    """The values of a line."""
    if delimiter is None:
        return line.split()
    try:
        cells = [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    except csv.Error:  # a cell longer than csv's limit
        return []
    return cells if delimiter == "," else list(map(_with_decimal_point, cells))


def _with_decimal_point(cell: str) -> str:
    """A number with a point in place of a decimal comma, as spreadsheets of many countries write it."""
    number = _DECIMAL_COMMA.fullmatch(cell)
    return f"{number[1]}.{number[2]}" if number else cell


def _names(cells: list[str]) -> tuple[str, ...] | None:
    """The column names in lower case; None if the line holds values."""
    if all(not cell or _is_number(cell) for cell in cells):
        return None
    lower = [cell.lstrip("# ").lower() for cell in cells]
    frame = next((name for name in _FRAME_NAMES if name in lower), "")
    return tuple("frame" if name == frame else _OTHER_NAMES.get(name, name) for name in lower)


def _box_columns(columns: Sequence[str]) -> tuple[str, ...]:
    """The columns of the box: x, y, width, height, or those of its corners or its center; () without these.

    Beside fx, cx and cy are a camera's.
    """
    known = (_BOX_COLUMNS, *_CORNER_COLUMNS, *(() if "fx" in columns else (_CENTER_COLUMNS,)))
    return next((names for names in known if set(names) <= set(columns)), ())


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


class _Frames:
    """The frame number of each row: from its column ``frame`` or the name of its image, or its index."""

    def __init__(self, images: Sequence[str]) -> None:
        self._by_name = {Path(name).stem: index for index, name in enumerate(images)}
        self._by_name |= {name: index for index, name in enumerate(images)}  # before stems
        self._column: str | None = None  # that names images; "" for none
        self._numbers = array("q")
        self._seen = bytearray()  # by frame

    @property
    def numbers(self) -> NDArray[np.int64]:
        """The numbers in the order of the rows."""
        return np.array(self._numbers, np.int64)

    @property
    def length(self) -> int:
        """The number of frames up to the last with a row."""
        return len(self._seen)

    def add(self, row: _Row) -> None:
        """Add a row's number. ValueError for one that is no frame's, or that another row has."""
        frame = _frame_of(row) if "frame" in row.cells else self._frame_by_name(row)
        self._seen.extend(bytes(max(0, frame + 1 - len(self._seen))))
        if self._seen[frame]:
            raise ValueError(f"{row.place}: expected each frame once, got {frame} again")
        self._seen[frame] = True
        self._numbers.append(frame)

    def _frame_by_name(self, row: _Row) -> int:
        """The frame of the image that the row names; ValueError for another; without names the row's index.

        The images may have another suffix, or another folder, than those that were labeled.
        """
        if self._column is None:
            found = (name for name in _FILE_NAMES if self._index(row.cells.get(name, "")) is not None)
            self._column = next(found, "")
        if not self._column:
            return len(self._numbers)
        name = row.cells[self._column]
        if (index := self._index(name)) is None:
            raise ValueError(f"{row.place}: expected the name of an image, got {name!r:.60}")
        return index

    def _index(self, name: str) -> int | None:
        file = PureWindowsPath(name)  # which takes both kinds of slashes
        return self._by_name.get(file.name, self._by_name.get(file.stem))


def _frame_of(row: _Row) -> int:
    number = row.number("frame")
    if not (0 <= number < MAX_FRAME_NUMBER and number.is_integer()):
        raise ValueError(
            f"{row.place}: expected a frame's whole number from 0, got {row.cells['frame']!r:.60}"
        )
    return int(number)


def _positions(places: "array[float]", frames: _Frames) -> NDArray[np.float64] | None:
    """The positions (length, 3) in meters; None if no row has one."""
    given = np.array(places, np.float64).reshape(-1, 3)
    if np.isnan(given).all():
        return None
    positions = np.full((frames.length, 3), np.nan)
    positions[frames.numbers] = given
    return positions
