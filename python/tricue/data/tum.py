# SPDX-License-Identifier: MIT
"""TUM's RGB-D folders: rgb.txt and depth.txt list times and files; groundtruth.txt is the camera's path.

Source: Sturm, Engelhard, Endres, Burgard, Cremers, "A Benchmark for the Evaluation of RGB-D SLAM Systems",
IROS 2012, and the file formats on its page.
"""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tricue.data.depth_images import DepthReader
from tricue.data.streams import Stream, Timed, timed_images

SCALE = 1 / 5000  # metres per unit; the format's definition, as the next
APART = 0.02  # seconds, within which a color and a depth image belong together
LISTS = {"color": "rgb.txt", "depth": "depth.txt"}


def is_tum(folder: Path) -> bool:
    """Whether one of the lists lies in the folder."""
    return any((folder / name).is_file() for name in LISTS.values())


def channels(folder: Path, scale: float | None) -> tuple[dict[str, Stream], tuple[str, ...]]:
    """The images that belong together, or those of the only list; with notes on what was left out.

    scale: metres per unit of depth, where the files don't keep to the format's.
    """
    color, depth = (_read_list(folder / name) for name in LISTS.values())
    reader = DepthReader(SCALE if scale is None else scale)
    if not (color and depth):
        return {"color": timed_images(color)} if color else {"depth": timed_images(depth, reader)}, ()
    pairs = _closest_pairs([time for time, _ in color], [time for time, _ in depth], APART)
    if not pairs:
        raise ValueError(
            f"{folder}: expected color and depth images within {APART} s of each other, found none"
        )
    paired: dict[str, Stream] = {
        "color": timed_images([color[i] for i, _ in pairs]),
        "depth": timed_images([depth[j] for _, j in pairs], reader),
    }
    alone = len(color) - len(pairs)
    note = f"left out {alone} of {len(color)} color images, with no depth image within {APART} s"
    return paired, (note,) if alone else ()


def _read_list(path: Path) -> Timed:
    """The times and images of a list, in the order of time; empty where there is no such file."""
    if not path.is_file():
        return []
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    images = [
        _entry(line, path, number)
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not images:
        raise ValueError(f"{path}: expected a line of timestamp and file name an image, found none")
    return sorted(images)


def _entry(line: str, path: Path, number: int) -> tuple[float, Path]:
    time, *name = re.split(r"[\s,]+", line.strip(), maxsplit=1)  # as the benchmark's own reader does
    try:
        seconds = float(time)
    except ValueError:
        seconds = np.nan
    if not (name and np.isfinite(seconds)):
        raise ValueError(f"{path}, line {number}: expected a timestamp and a file name, got {line!r:.60}")
    return seconds, path.parent / name[0]


def _closest_pairs(first: Sequence[float], second: Sequence[float], apart: float) -> list[tuple[int, int]]:
    """Indices of times that belong together, each once, the closest first served; both are sorted."""
    times = np.array(second)
    low = np.searchsorted(times, np.subtract(first, apart), "left").tolist()
    high = np.searchsorted(times, np.add(first, apart), "right").tolist()
    close = sorted(
        (abs(first[i] - second[j]), i, j) for i in range(len(first)) for j in range(low[i], high[i])
    )
    pairs: dict[int, int] = {}
    taken: set[int] = set()
    for _, i, j in close:
        if i not in pairs and j not in taken:
            pairs[i] = j
            taken.add(j)
    return sorted(pairs.items())
