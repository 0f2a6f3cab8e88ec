# SPDX-License-Identifier: MIT
"""KITTI's folders: color images of the left camera in image_02 (or image_2), of the right one in image_03.

Tracking: image_02/0005/000000.png with calib/0005.txt. Odometry: image_2/000000.png with calib.txt. Raw:
image_02/data/0000000000.png with calib_cam_to_cam.txt one folder up. All are rectified.
"""

from pathlib import Path
from typing import NamedTuple

from tricue.camera.streams import image_paths

SIDES = {"image_02": "image_03", "image_2": "image_3"}


class Sequence(NamedTuple):
    """Where a sequence's images are, and its calibration."""

    left: Path
    right: Path | None
    calibration: Path | None


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
