# SPDX-License-Identifier: MIT
"""Files of ``cv2.FileStorage`` (YAML, XML, JSON), whose failures are exceptions that name the file.

cv2 gets the text, not the path, as it can't open every path, and only text that is nested no deeper than a
calibration, as its parser crashes on some thousand levels.
"""

import pathlib
import re
from typing import TYPE_CHECKING

import cv2
import numpy as np

from tricue.camera.types import Matrix, PathLike, Size

if TYPE_CHECKING:
    from typing_extensions import Self

MAX_BYTES = 1 << 20
MAX_LEVELS = 64
_BRACKETS = re.compile(r"(?P<opening>[\[{]|<[^/?!])|[\]}]|</")
_DASHES = re.compile(rf"(?:[-?]\s+){{{MAX_LEVELS}}}")
"""Lists of lists on one line of YAML; on more lines they need more indentation than MAX_BYTES holds."""


class OpenCVFile:
    """A ``cv2.FileStorage`` opened for reading, used in ``with``.

    OSError for a file that isn't there, ValueError for one that FileStorage didn't write.
    """

    def __init__(self, path: PathLike) -> None:
        self.path = path
        content = pathlib.Path(path).read_bytes()
        if len(content) > MAX_BYTES:
            raise ValueError(f"{path}: expected a calibration of at most 1 MB, got {len(content):,} bytes")
        self._text = content.decode("utf-8", "replace").replace("\0", " ")
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
        """The matrix of that name, None where there is none; ValueError for a wrong count of numbers."""
        node = self.storage.getNode(key)
        try:
            matrix = None if node.empty() or not node.isMap() else node.mat()
        except cv2.error:
            raise ValueError(
                f"{self.path}: {key}: expected a matrix with as many numbers as rows and cols say"
            ) from None
        return None if matrix is None else np.asarray(matrix, np.float64)

    def size(self) -> Size | None:
        """Width and height of the images, None where the file doesn't hold them."""
        for names in (("image_width", "image_height"), ("width", "height"), ("imageWidth", "imageHeight")):
            nodes = [self.storage.getNode(name) for name in names]
            if all(node.isInt() for node in nodes):
                return int(nodes[0].real()), int(nodes[1].real())
        return None

    def _foreign(self) -> ValueError:
        return ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote")


def _levels(text: str) -> int:
    """How deep brackets or tags are nested."""
    deepest = level = 0
    for bracket in _BRACKETS.finditer(text):
        level = level + 1 if bracket["opening"] else max(level - 1, 0)
        deepest = max(deepest, level)
    return deepest
