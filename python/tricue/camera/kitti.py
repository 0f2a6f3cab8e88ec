# SPDX-License-Identifier: MIT
"""KITTI's folders: color images of the left camera in image_02 (or image_2), of the right one in image_03.

Tracking: image_02/0005/000000.png with calib/0005.txt. Odometry: image_2/000000.png with calib.txt. Raw:
image_02/data/0000000000.png with calib_cam_to_cam.txt one folder up. All are rectified.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.streams import image_paths

SIDES = {"image_02": "image_03", "image_2": "image_3"}
LABEL = 17  # words in a line of a tracking label
IGNORED = "DontCare"


class Label(NamedTuple):
    """A target of a tracking sequence, a row for each of the M frames in which it is labelled.

    frames: (M,) counted from 0, rising. boxes: (M, 4) x, y, width, height, pixels of the left image. nearest:
    (M,) the depth of the nearest side of its cuboid, metres, as the left camera sees it.
    """

    name: str
    frames: NDArray[np.int64]
    boxes: NDArray[np.float64]
    nearest: NDArray[np.float64]


def read_labels(path: Path) -> list[Label]:
    """The targets in a file of KITTI's tracking labels, by their numbers; regions to ignore are left out.

    ValueError names the line that isn't such a label.
    """
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    rows: dict[tuple[int, str], list[tuple[int, list[float]]]] = {}
    for number, line in enumerate(lines, 1):
        words = line.split()
        if not words:
            continue
        try:
            frame, track, kind, values = int(words[0]), int(words[1]), words[2], [*map(float, words[5:17])]
        except (IndexError, ValueError):
            values = []
        if len(values) != LABEL - 5:
            raise ValueError(f"{path}, line {number}: expected a tracking label, got {line!r:.60}")
        if kind != IGNORED:
            rows.setdefault((track, kind), []).append((frame, values))
    return [_label(f"{kind} {track}", sorted(found)) for (track, kind), found in sorted(rows.items())]


def _label(name: str, rows: list[tuple[int, list[float]]]) -> Label:
    frames = np.array([frame for frame, _ in rows])
    # alpha, the box's corners, height, width, length, the cuboid's x, y, z in metres, its turn about y
    _, x0, y0, x1, y1, _, width, length, _, _, z, turn = np.array([values for _, values in rows]).T
    half = (np.abs(np.sin(turn)) * length + np.abs(np.cos(turn)) * width) / 2
    return Label(name, frames, np.stack([x0, y0, x1 - x0, y1 - y0], axis=1), z - half)


class Sequence(NamedTuple):
    """Where a sequence's images are, and its calibration."""

    left: Path
    right: Path | None
    calibration: Path | None

    @property
    def labels(self) -> Path:
        """Where a tracking sequence has its labels, be they there or not."""
        return self.left.parent.parent / "label_02" / f"{self.left.name}.txt"


def find_sequence(folder: Path) -> Sequence | None:
    """The sequence that a folder is or holds, None where it isn't KITTI's; ValueError if it holds several."""
    folder = folder.resolve()
    if folder.parent.name in SIDES or (folder.name in SIDES and image_paths(folder)):
        return _sequence(folder)
    left = next((folder / name for name in SIDES if (folder / name).is_dir()), None)
    if left is None:
        return None
    if image_paths(left):
        return _sequence(left)
    inner = sorted(path for path in left.iterdir() if path.is_dir() and image_paths(path))
    if len(inner) != 1:
        names = ", ".join(path.name for path in inner[:3]) + (", ..." if len(inner) > 3 else "")
        got = f"{len(inner)} ({names}); name one, {inner[0]}" if inner else "none"
        raise ValueError(f"{left}: expected the images of one sequence, got {got}")
    return _sequence(inner[0])


def _sequence(left: Path) -> Sequence | None:
    if not image_paths(left):
        return None
    inside = left.parent.name in SIDES
    side = left.parent if inside else left
    other = side.with_name(SIDES[side.name])
    right = other / left.name if inside else other
    root = side.parent
    places = (root / "calib" / f"{left.name}.txt", root / "calib.txt", root.parent / "calib_cam_to_cam.txt")
    calibration = next((path for path in places if path.is_file()), None)
    return Sequence(left, right if right.is_dir() and image_paths(right) else None, calibration)
