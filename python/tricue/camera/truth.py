# SPDX-License-Identifier: MIT
"""Files of true boxes: OTB's groundtruth_rect.txt counts pixels from 1, VOT's groundtruth.txt from 0.

Princeton's are <sequence>.txt, which is public for few sequences, and init.txt, the first box alone.
"""

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

OTB, VOT, PTB_FIRST = "groundtruth_rect.txt", "groundtruth.txt", "init.txt"


def find_truth(folder: Path) -> NDArray[np.float64] | None:
    """The true boxes of a sequence folder, or None where it has no such file."""
    path = next((folder / name for name in (OTB, VOT) if (folder / name).is_file()), None)
    return None if path is None else read_truth(path)


def find_ptb_truth(folder: Path) -> NDArray[np.float64] | None:
    """The same for a sequence of the Princeton Tracking Benchmark, whose lines go on behind the box."""
    names = (f"{folder.resolve().name}.txt", PTB_FIRST)
    path = next((folder / name for name in names if (folder / name).is_file()), None)
    return None if path is None else read_truth(path, count=4)


def read_truth(path: Path, count: int | None = None) -> NDArray[np.float64]:
    """A row (x, y, width, height) a line, pixels counted from 0; NaN where the target is absent or unknown.

    Commas, tabs, semicolons or blanks part the numbers. VOT's polygons become the boxes round them, its masks
    their box. count: how many numbers of a line are read, by default all. ValueError names a line that holds
    anything else.
    """
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    while lines and not lines[-1].strip():
        lines.pop()
    boxes = np.array([_box(line, f"{path}, line {i}", count) for i, line in enumerate(lines, 1)]).reshape(
        -1, 4
    )
    boxes[~(boxes[:, 2:] > 0).all(axis=1)] = np.nan
    return boxes - [1, 1, 0, 0] if path.name == OTB else boxes


def _box(line: str, place: str, count: int | None) -> tuple[float, ...]:
    words = re.split(r"[,;\s]+", line.strip().removeprefix("m"))
    words = words[: 4 if line.strip().startswith("m") else count]
    try:
        numbers = tuple(map(float, words))
    except ValueError:
        numbers = ()
    if len(numbers) == 4:
        return numbers
    if len(numbers) >= 6 and len(numbers) % 2 == 0:
        xs, ys = numbers[::2], numbers[1::2]
        return min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)
    if numbers and not np.isfinite(numbers).all():
        return (np.nan,) * 4
    raise ValueError(f"{place}: expected four numbers x, y, width, height, got {line.strip()!r:.60}")
