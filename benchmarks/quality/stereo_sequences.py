# SPDX-License-Identifier: MIT
"""Recorded rectified pairs with true boxes: a target's pairs, its rig, and how far away it is.

KITTI's tracking sequences have many targets; each labelled one is a sequence of its own. Any other folder is
left/ and right/ with the target's true boxes in both, and calibration.yml.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.frame import Frame
from tricue.camera.read_calibration import read_rig
from tricue.camera.rig import StereoRig
from tricue.data import kitti
from tricue.data.open_source import Source, open_source
from tricue.data.truth import read_true_boxes

RIGHT, CALIBRATION = "groundtruth_right.txt", "calibration.yml"
KITTI_RATE = 10.0  # frames/s of its cameras (Geiger et al. 2013), which its folders don't tell
SHORTEST = 10  # frames
LEAST_SIDE = 20.0  # pixels of a labelled target in its first frame
Array = NDArray[np.float64]


class StereoSequence(NamedTuple):
    """M pairs, a true box for each in the left image, (M, 4) pixels, and true disparities (M,), pixels."""

    name: str
    frames: tuple[Frame, ...]
    truth: Array
    disparities: Array
    rig: StereoRig


def find(root: Path) -> list[Path]:
    """The folders that hold such sequences, by name: ``root`` itself, and those directly under it."""
    folders = [root, *sorted(path for path in root.glob("*") if path.is_dir())]
    return [folder for folder in folders if (folder / RIGHT).is_file() or _labels(folder) is not None]


def load(folder: Path, unit: float = 1.0) -> Iterator[StereoSequence]:
    """Decode a folder's sequences. unit: metres, in which OpenCV's calibration of it counts its baseline.

    ValueError where the right images, boxes or the calibration aren't there or don't fit.
    """
    labels = _labels(folder)
    source = open_source(folder, fps=None if labels is None else KITTI_RATE)
    if "right" not in source.channels:
        raise ValueError(f"{folder}: expected a stereo pair, got {', '.join(source.channels)}")
    if labels is None:
        yield _pair(source, folder, unit)
    else:
        yield from _targets(source, labels)


def _labels(folder: Path) -> Path | None:
    sequence = kitti.find_sequence(folder)
    return sequence.labels if sequence is not None and sequence.labels.is_file() else None


def _pair(source: Source, folder: Path, unit: float) -> StereoSequence:
    frames = tuple(source)
    if source.truth is None:
        raise ValueError(f"{folder}: expected true boxes of the left images")
    left, right = source.truth, read_true_boxes(folder / RIGHT)
    if len(left) != len(frames) or len(right) != len(frames):
        raise ValueError(f"{folder}: expected {len(frames)} true boxes, got {len(left)} and {len(right)}")
    disparities = (left[:, 0] + left[:, 2] / 2) - (right[:, 0] + right[:, 2] / 2)
    rig = read_rig(folder / CALIBRATION, source.size, unit)
    return StereoSequence(source.name, frames, left, disparities, rig)


def _targets(source: Source, labels: Path) -> Iterator[StereoSequence]:
    """The targets that are labelled in enough frames on end and large enough in the first of them."""
    if source.calibration is None:
        raise ValueError(f"{labels}: expected calibration beside the images")
    frames, rig = tuple(source), read_rig(source.calibration, source.size)
    for label in kitti.read_labels(labels):
        first, last = int(label.frames[0]), int(label.frames[-1])
        gaps = len(label.frames) <= last - first
        if gaps or len(label.frames) < SHORTEST or label.boxes[0, 2:].min() < LEAST_SIDE:
            continue
        disparities = rig.intrinsics.fx * rig.baseline / label.front_depths
        name = f"{source.name} {label.name}"
        yield StereoSequence(name, frames[first : last + 1], label.boxes, disparities, rig)
