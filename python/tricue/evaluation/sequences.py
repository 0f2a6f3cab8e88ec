# SPDX-License-Identifier: MIT
"""Recorded sequences with true boxes, in the layout of OTB: a folder with ``groundtruth_rect.txt`` and ``img/`` or one video."""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame

TRUTH = "groundtruth_rect.txt"


@dataclass(frozen=True, slots=True, eq=False)
class Sequence:
    """Decoded frames, and a true box for each, (M, 4) pixels counted from 0; NaN in frames without truth."""

    name: str
    frames: tuple[Frame, ...]
    truth: NDArray[np.float64]


def data_folder() -> Path:
    """Where recorded data is looked for: the environment's TRICUE_DATA, else ../shared/data."""
    return Path(os.environ.get("TRICUE_DATA", "../shared/data"))


def find(root: Path) -> list[Path]:
    """The sequence folders directly under ``root``, by name."""
    return sorted(path.parent for path in root.glob(f"*/{TRUTH}"))


def load(folder: Path) -> Sequence:
    """Decode a whole sequence into memory."""
    frames = tuple(Frame(color=image) for image in _images(folder))
    known = read_truth(folder / TRUTH)[: len(frames)]
    truth = np.full((len(frames), 4), np.nan)
    truth[: len(known)] = known
    return Sequence(folder.name, frames, truth)


def read_truth(path: Path) -> NDArray[np.float64]:
    """A row ``x, y, width, height`` a line, counted from 1 in the file and from 0 in the result."""
    rows = [re.split(r"[,\s]+", line.strip()) for line in path.read_text().splitlines() if line.strip()]
    if not rows or any(len(row) != 4 for row in rows):
        raise ValueError(f"{path}: expected four numbers x, y, width, height in every line")
    return np.array(rows, dtype=np.float64) - [1, 1, 0, 0]


def _images(folder: Path) -> Iterator[NDArray[np.uint8]]:
    paths = sorted((folder / "img").iterdir()) if (folder / "img").is_dir() else []
    for path in paths:
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if image is None:
            raise ValueError(f"{path}: expected an image")
        yield np.asarray(image, dtype=np.uint8)
    if not paths:
        yield from _video(folder)


def _video(folder: Path) -> Iterator[NDArray[np.uint8]]:
    paths = [path for path in sorted(folder.iterdir()) if path.name != TRUTH]
    capture = cv2.VideoCapture(str(paths[0])) if len(paths) == 1 else None
    if capture is None or not capture.isOpened():
        raise ValueError(f"{folder}: expected a folder img or one video that opens")
    while True:
        there, image = capture.read()
        if not there:
            break
        yield np.asarray(image, dtype=np.uint8)
    capture.release()
