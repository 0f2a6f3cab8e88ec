# SPDX-License-Identifier: MIT
"""KITTI's folders: image_02 (or image_2) holds the left color images, image_03 (or image_3) the right ones.
Without them the gray images are read: image_00 (or image_0) and image_01 (or image_1).

Tracking: image_02/0005/000000.png with calib/0005.txt. Odometry: image_2/000000.png with calib.txt. Raw:
image_02/data/0000000000.png with calib_cam_to_cam.txt one folder up. All are rectified.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.calibration_formats import read_kitti_offset
from tricue.camera.text import lines_of
from tricue.data.files import image_paths
from tricue.data.streams import Images, Stream
from tricue.data.truth import MAX_FRAME_NUMBER, MAX_VALUE, Truth, truth_from_rows

RIGHT_FOLDERS = {
    "image_02": "image_03",
    "image_2": "image_3",
    "image_00": "image_01",
    "image_0": "image_1",
}
"""The right images' folder by the left images'; if a folder has several of these, the first is read."""
LABEL_WORDS = 17  # in a line of a tracking label
IGNORED_TYPE = "DontCare"


class LabeledTarget(NamedTuple):
    """A target of a tracking sequence, with a row for each of the M frames in which it is labeled.

    frames: (M,) numbers from 0, increasing. boxes: (M, 4) x, y, width, height, pixels of the left image.
    front_depths: (M,) the smallest depth of its cuboid, meters. positions: (M, 3) the cuboid's center X, Y,
    Z, meters. Depths and positions are in the frame of camera 0.
    """

    name: str
    frames: NDArray[np.int64]
    boxes: NDArray[np.float64]
    front_depths: NDArray[np.float64]
    positions: NDArray[np.float64]

    def truth(self, offset: NDArray[np.float64]) -> Truth:
        """One row per frame from the first label to the last; frames without a label are unknown.

        offset: (3,) meters, the translation from camera 0's frame to the left color camera's.
        """
        rows = self.frames - self.frames[0]
        known = truth_from_rows(self.boxes)
        boxes, positions = (np.full((rows[-1] + 1, columns), np.nan) for columns in (4, 3))
        absent = np.zeros(len(boxes), np.bool_)
        boxes[rows], absent[rows], positions[rows] = known.boxes, known.absent, self.positions + offset
        return Truth(boxes, absent, positions)


class _Line(NamedTuple):
    frame: int
    track: int
    kind: str
    values: list[float]


def read_labels(path: Path) -> list[LabeledTarget]:
    """The targets in a file of KITTI's tracking labels, by track number; DontCare regions are left out.

    ValueError names a line that isn't a label, or a target's second label in one frame.
    """
    rows: dict[tuple[int, str], dict[int, list[float]]] = {}
    for number, line in enumerate(lines_of(path), 1):
        if not line.strip():
            continue
        label = _line(line)
        if label is None:
            raise ValueError(f"{path}, line {number}: expected a tracking label, got {line!r:.60}")
        if label.kind == IGNORED_TYPE:
            continue
        target = rows.setdefault((label.track, label.kind), {})
        if label.frame in target:
            name = f"{label.kind} {label.track}"
            raise ValueError(
                f"{path}, line {number}: expected {name} once in frame {label.frame}, got it again"
            )
        target[label.frame] = label.values
    return [_label(f"{kind} {track}", found) for (track, kind), found in sorted(rows.items())]


def _line(line: str) -> _Line | None:
    words = line.split()
    try:
        frame, track, kind, values = (
            int(words[0]),
            int(words[1]),
            words[2],
            [*map(float, words[5:LABEL_WORDS])],
        )
    except (IndexError, ValueError):
        return None
    if len(values) != LABEL_WORDS - 5 or not 0 <= frame < MAX_FRAME_NUMBER:
        return None
    return _Line(frame, track, kind, values) if all(abs(value) < MAX_VALUE for value in values) else None


def _label(name: str, rows: dict[int, list[float]]) -> LabeledTarget:
    frames = np.array(sorted(rows), np.int64)
    # alpha, the box's corners, height, width, length, the cuboid's x, y, z in meters, its rotation about y
    columns = np.array([rows[frame] for frame in sorted(rows)]).T
    _, x0, y0, x1, y1, height, width, length, x, y, z, yaw = columns
    half = (np.abs(np.sin(yaw)) * length + np.abs(np.cos(yaw)) * width) / 2
    boxes = np.stack([x0, y0, x1 - x0, y1 - y0], axis=1)
    # the location is the center of the bottom face
    return LabeledTarget(name, frames, boxes, z - half, np.stack([x, y - height / 2, z], axis=1))


class KittiSequence(NamedTuple):
    """Where the images of a sequence are, and its calibration file."""

    left: Path
    right: Path | None
    calibration: Path | None

    @property
    def cameras(self) -> tuple[int, int]:
        """KITTI's numbers of the left and of the right camera."""
        names = (self.left.name, self.left.parent.name)
        left = next(int(name.removeprefix("image_")) for name in names if name in RIGHT_FOLDERS)
        return left, left + 1

    @property
    def labels(self) -> Path:
        """The file of a tracking sequence's labels, which may be missing."""
        return self.left.parent.parent / "label_02" / f"{self.left.name}.txt"

    @property
    def tracking(self) -> bool:
        """Whether the sequence belongs to the tracking benchmark."""
        named = self.calibration is not None and self.calibration.parent.name == "calib"
        return named or self.labels.is_file()


def read_channels(
    sequence: KittiSequence, target: str | None = None
) -> tuple[dict[str, Stream], Truth | None]:
    """The stereo pair, or the left images alone, and the truth of one target.

    target: the name of a labeled target; without it there is no truth. With a target, the images are those
    from its first to its last frame, by the numbers in the file names. Its positions are in the left camera's
    frame if there is a calibration, else in camera 0's.
    """
    folders = {"color": sequence.left, "right": sequence.right}
    paths = {name: image_paths(folder) for name, folder in folders.items() if folder is not None}
    if target is None:
        return {name: Images(found) for name, found in paths.items()}, None
    label = next(label for label in read_labels(sequence.labels) if label.name == target)
    frames = range(int(label.frames[0]), int(label.frames[-1]) + 1)
    offset = np.zeros(3)
    if sequence.calibration is not None:
        offset = read_kitti_offset(sequence.calibration, camera=sequence.cameras[0])
    cut: dict[str, Stream] = {name: Images(_numbered(found, frames)) for name, found in paths.items()}
    return cut, label.truth(offset)


def _numbered(paths: list[Path], frames: range) -> list[Path]:
    """The images with these numbers; ValueError names the folder in which one is missing."""
    by_number = {int(path.stem): path for path in paths if path.stem.isdecimal()}
    for frame in (frames[0], frames[-1], *frames):
        if frame not in by_number:
            is_end = frame in (frames[0], frames[-1])
            why = "which is labeled" if is_end else "between the first and last label"
            raise ValueError(f"{paths[0].parent}: expected the image of frame {frame}, {why}")
    return [by_number[frame] for frame in frames]


def find_labels(folder: Path) -> Path | None:
    """The file of tracking labels of the sequence that a folder is or holds; None if there is none."""
    sequence = find_sequence(folder)
    return sequence.labels if sequence is not None and sequence.labels.is_file() else None


def find_sequence(folder: Path) -> KittiSequence | None:
    """The sequence that a folder is or holds; None if it isn't KITTI's. ValueError if it holds several."""
    folder = folder.resolve()
    if folder.parent.name in RIGHT_FOLDERS or (folder.name in RIGHT_FOLDERS and image_paths(folder)):
        return _sequence(folder)
    left = next((folder / name for name in RIGHT_FOLDERS if (folder / name).is_dir()), None)
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


def _sequence(left: Path) -> KittiSequence | None:
    if not image_paths(left):
        return None
    inside = left.parent.name in RIGHT_FOLDERS
    side = left.parent if inside else left
    other = side.with_name(RIGHT_FOLDERS[side.name])
    right = other / left.name if inside else other
    root = side.parent
    places = (root / "calib" / f"{left.name}.txt", root / "calib.txt", root.parent / "calib_cam_to_cam.txt")
    calibration = next((path for path in places if path.is_file()), None)
    return KittiSequence(left, right if right.is_dir() and image_paths(right) else None, calibration)
