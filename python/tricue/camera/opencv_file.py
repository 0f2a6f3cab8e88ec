# SPDX-License-Identifier: MIT
"""Files of ``cv2.FileStorage`` (YAML, XML, JSON), whose failures are exceptions that name the file."""

import pathlib
from typing import TYPE_CHECKING

import cv2
import numpy as np

from tricue.camera.types import Matrix, PathLike, Size

if TYPE_CHECKING:
    from typing_extensions import Self


class OpenCVFile:
    """A ``cv2.FileStorage`` opened for reading, used in ``with``.

    OSError for a file that isn't there, ValueError for one that FileStorage didn't write.
    """

    def __init__(self, path: PathLike) -> None:
        self.path = path
        with pathlib.Path(path).open("rb"):  # FileStorage says nothing about a missing file
            pass

    def __enter__(self) -> "Self":
        try:
            self.storage = cv2.FileStorage(str(self.path), cv2.FILE_STORAGE_READ)
        except (cv2.error, SystemError):
            raise ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote") from None
        if not self.storage.isOpened():
            raise ValueError(f"{self.path}: expected a file that cv2.FileStorage wrote")
        return self

    def __exit__(self, *_: object) -> None:
        self.storage.release()

    def matrix(self, key: str) -> Matrix | None:
        """The matrix of that name, None where there is none."""
        node = self.storage.getNode(key)
        matrix = None if node.empty() or not node.isMap() else node.mat()
        return None if matrix is None else np.asarray(matrix, np.float64)

    def size(self) -> Size | None:
        """Width and height of the images, None where the file doesn't hold them."""
        for names in (("image_width", "image_height"), ("width", "height"), ("imageWidth", "imageHeight")):
            nodes = [self.storage.getNode(name) for name in names]
            if all(node.isInt() for node in nodes):
                return int(nodes[0].real()), int(nodes[1].real())
        return None
