# SPDX-License-Identifier: MIT
"""TUM's RGB-D folders: rgb.txt and depth.txt list times and files; groundtruth.txt has the camera's poses.

Source: Sturm, Engelhard, Endres, Burgard, Cremers, "A Benchmark for the Evaluation of RGB-D SLAM Systems",
IROS 2012, and the file formats on its page.
"""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tricue.camera.text import lines_of
from tricue.data.depth_images import DepthReader
from tricue.data.files import listed_path
from tricue.data.streams import Stream, TimedPaths, timed_images

TUM_METERS_PER_UNIT = 1 / 5000  # by the format's definition
MAX_TIME_DIFFERENCE = 0.02  # seconds between a frame's color and depth images
LIST_FILES = {"color": "rgb.txt", "depth": "depth.txt"}


def is_tum(folder: Path) -> bool:
    """Whether the folder has rgb.txt or depth.txt."""
    return any((folder / name).is_file() for name in LIST_FILES.values())


def read_channels(folder: Path, scale: float | None) -> tuple[dict[str, Stream], tuple[str, ...]]:
    """Color and depth images paired by time, or those of the only list, and notes on what was left out.

    scale: meters per unit of depth, if the files deviate from the format.
    """
    color, depth = (_read_list(folder / name) for name in LIST_FILES.values())
    reader = DepthReader(TUM_METERS_PER_UNIT if scale is None else scale)
    if not (color and depth):
        return {"color": timed_images(color)} if color else {"depth": timed_images(depth, reader)}, ()
    matches = match_times([time for time, _ in color], [time for time, _ in depth], MAX_TIME_DIFFERENCE)
    if not matches:
        raise ValueError(
            f"{folder}: expected color and depth images within {MAX_TIME_DIFFERENCE} s of each other, "
            "found none"
        )
    paired: dict[str, Stream] = {
        "color": timed_images([color[i] for i, _ in matches]),
        "depth": timed_images([depth[j] for _, j in matches], reader),
    }
    alone = len(color) - len(matches)
    note = (
        f"left out {alone} of {len(color)} color images, with no depth image within {MAX_TIME_DIFFERENCE} s"
    )
    return paired, (note,) if alone else ()


def _read_list(path: Path) -> TimedPaths:
    """The times and images of a list, sorted by time; empty if there is no such file."""
    if not path.is_file():
        return []
    images = [
        _entry(line, path, number)
        for number, line in enumerate(lines_of(path), 1)
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
    return seconds, listed_path(path.parent, name[0], path)


def match_times(
    first: Sequence[float], second: Sequence[float], max_difference: float
) -> list[tuple[int, int]]:
    """Pairs of indices into two sorted lists of times, in order; each index is used at most once.

    Closest times are paired first. max_difference: seconds.
    """
    times = np.array(second)
    low = np.searchsorted(times, np.subtract(first, max_difference), "left").tolist()
    high = np.searchsorted(times, np.add(first, max_difference), "right").tolist()
    close = sorted(
        (abs(first[i] - second[j]), i, j) for i in range(len(first)) for j in range(low[i], high[i])
    )
    matches: dict[int, int] = {}
    taken: set[int] = set()
    for _, i, j in close:
        if i not in matches and j not in taken:
            matches[i] = j
            taken.add(j)
    return sorted(matches.items())
