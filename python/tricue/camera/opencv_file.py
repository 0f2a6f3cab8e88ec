# SPDX-License-Identifier: MIT
"""Files of ``cv2.FileStorage`` (YAML, XML, JSON), read with exceptions that name the file.

ROS's camera_info in YAML, as camera_calibration writes it, is read, too: it has no header, and its matrices
don't tell the type of their numbers.

cv2 gets the text instead of the path, because it can't open every path. Text that is nested more deeply than
a calibration is refused, because cv2's parser crashes on some thousand levels.
"""

import pathlib
import re
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from tricue.camera.text import encoding_of
from tricue.camera.types import Matrix, PathLike, Size

if TYPE_CHECKING:
    from typing_extensions import Self

MAX_BYTES = 1 << 20
MAX_LEVELS = 64
MAX_NUMBERS = 64  # in a list; calibrations have at most 16, and cv2's time per list grows quadratically
_HEADS = ("%", "<", "{")  # of YAML, XML and JSON as cv2 writes them
_NAME = re.compile(r"^camera_name:.*$", re.MULTILINE)
"""Free text in a camera_info, on which cv2's parser may fail: 00b09d0100990bb2 begins like a number."""
_BRACKETS = re.compile(r"(?P<opening>[\[{]|<[^/?!])|[\]}]|</")
_DASHES = re.compile(rf"(?:[-?]\s+){{{MAX_LEVELS}}}")
"""Nested lists on one line of YAML; on several lines their indentation would exceed MAX_BYTES."""


class OpenCVFile:
    """A ``cv2.FileStorage`` opened for reading, used in ``with``.

    OSError for a missing file, ValueError for one that FileStorage can't read.
    """

    def __init__(self, path: PathLike) -> None:
        self.path = path
        content = pathlib.Path(path).read_bytes()
        if len(content) > MAX_BYTES:
            raise ValueError(f"{path}: expected a calibration of at most 1 MB, got {len(content):,} bytes")
        self._text = _with_head(content.decode(encoding_of(content), "replace").replace("\0", " "))
        if _levels(self._text) > MAX_LEVELS or _DASHES.search(self._text):
            raise ValueError(f"{path}: expected a calibration, its values are nested too deeply")

    def __enter__(self) -> "Self":
        if not self._text.strip():
            raise self._foreign()
        try:
            self.storage = cv2.FileStorage(self._text, cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)
        except (cv2.error, SystemError):
            raise self._foreign() from None
        if not self.storage.isOpened():
            raise self._foreign()
        return self

    def __exit__(self, *_: object) -> None:
        self.storage.release()

    def matrix(self, key: str) -> Matrix | None:
        """The matrix with that name, or None; ValueError for a wrong count of numbers."""
        node = self.storage.getNode(key)
        try:
            matrix = _matrix(node) if node.isMap() else None
        except (cv2.error, ValueError):
            raise ValueError(
                f"{self.path}: {key}: expected a matrix with as many numbers as rows and cols say"
            ) from None
        return None if matrix is None else np.asarray(matrix, np.float64)

    def numbers(self, key: str) -> Matrix | None:
        """The numbers (n,) of a list or a matrix, or None; ValueError as from ``matrix``."""
        node = self.storage.getNode(key)
        if not node.isSeq():
            matrix = self.matrix(key)
            return None if matrix is None else matrix.ravel()
        try:
            return np.array(_listed(node), np.float64)
        except ValueError:
            raise ValueError(f"{self.path}: {key}: expected at most {MAX_NUMBERS} numbers") from None

    def size(self) -> Size | None:
        """Width and height of the images, or None if the file doesn't hold them."""
        for names in (("image_width", "image_height"), ("width", "height"), ("imageWidth", "imageHeight")):
            nodes = [self.storage.getNode(name) for name in names]
            if all(node.isInt() for node in nodes):
                return int(nodes[0].real()), int(nodes[1].real())
        return None

    def _foreign(self) -> ValueError:
        return ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote, or ROS's camera_info")


def _with_head(text: str) -> str:
    """The text with the first line by which cv2 recognizes YAML."""
    if not text.strip() or text.lstrip().startswith(_HEADS):
        return text
    return "%YAML:1.0\n" + _NAME.sub("", text)


def _matrix(node: cv2.FileNode) -> Any:
    """A map as a matrix; ValueError or cv2.error if it isn't a complete one."""
    shape = _shape(node)
    if not node.getNode("dt").empty():
        return node.mat()
    return np.reshape(np.array(_listed(node.getNode("data")), np.float64), shape)


def _shape(node: cv2.FileNode) -> list[int]:
    """Rows and columns, or the one number that cv2 5 writes for a vector.

    ValueError for anything else: cv2 writes out of bounds for a matrix without cols or of many dimensions.
    """
    rows, cols, sizes = (node.getNode(name) for name in ("rows", "cols", "sizes"))
    listed = sizes.isSeq()  # in XML, a list of one number is a number
    vector = [sizes.at(index) for index in range(sizes.size())] if listed else [sizes]
    shape = vector if rows.empty() else [rows, cols]
    if len(shape) > 2 or not all(size.isInt() and 0 <= size.real() <= MAX_NUMBERS for size in shape):
        raise ValueError
    return [int(size.real()) for size in shape]


def _listed(node: cv2.FileNode) -> list[float]:
    """The numbers of a list; ValueError or cv2.error for anything else."""
    if node.size() > MAX_NUMBERS:
        raise ValueError
    items = [node.at(index) for index in range(node.size())]
    if not all(item.isInt() or item.isReal() for item in items):
        raise ValueError
    return [item.real() for item in items]


def _levels(text: str) -> int:
    """How deep brackets or tags are nested."""
    deepest = level = 0
    for bracket in _BRACKETS.finditer(text):
        level = level + 1 if bracket["opening"] else max(level - 1, 0)
        deepest = max(deepest, level)
    return deepest
