# SPDX-License-Identifier: MIT
"""Recorded rectified stereo pairs with a target's true boxes and disparities, and their rig.

A KITTI tracking sequence has many targets; each labeled one is a sequence of its own. Any other folder has
left/ and right/, the target's true boxes in both, and calibration.yml.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.calibration_formats import read_kitti_offset
from tricue.camera.frame import Frame
from tricue.camera.read_calibration import read_rig
from tricue.camera.rig import StereoRig
from tricue.data import kitti
from tricue.data.open_source import Source, open_source
from tricue.data.truth import read_truth_file

RIGHT, CALIBRATION = "groundtruth_right.txt", "calibration.yml"
MIN_KITTI_FRAMES = 10
MIN_KITTI_SIDE = 20.0  # pixels of a labeled target in its first frame
Array = NDArray[np.float64]


class StereoSequence(NamedTuple):
    """M stereo pairs, true boxes in the left images, (M, 4), and true disparities (M,), all in pixels."""

    name: str
    frames: tuple[Frame, ...]
    truth: Array
    disparities: Array
    rig: StereoRig


def find(root: Path) -> list[Path]:
    """The folders that hold such sequences, by name: ``root`` itself, and folders directly under it."""
    folders = [root, *sorted(path for path in root.glob("*") if path.is_dir())]
    return [folder for folder in folders if (folder / RIGHT).is_file() or _labels(folder) is not None]


def load(folder: Path, unit: float = 1.0) -> Iterator[StereoSequence]:
    """Decode a folder's sequences. unit: meters, of the baseline in its OpenCV calibration.

    ValueError if right images, boxes or calibration are missing or don't match.
    """
    labels = _labels(folder)
    source = open_source(folder)
    if "right" not in source.channels:
        raise ValueError(f"{folder}: expected a stereo pair, got {', '.join(source.channels)}")
    if labels is None:
        yield _single_target(source, folder, unit)
    else:
        yield from _targets(source, labels)


def _labels(folder: Path) -> Path | None:
    sequence = kitti.find_sequence(folder)
    return sequence.labels if sequence is not None and sequence.labels.is_file() else None


def _single_target(source: Source, folder: Path, unit: float) -> StereoSequence:
    frames = tuple(source)
    if source.truth is None:
        raise ValueError(f"{folder}: expected true boxes of the left images")
    left, right = source.truth, read_truth_file(folder / RIGHT).boxes
    if len(left) != len(frames) or len(right) != len(frames):
        raise ValueError(f"{folder}: expected {len(frames)} true boxes, got {len(left)} and {len(right)}")
    disparities = (left[:, 0] + left[:, 2] / 2) - (right[:, 0] + right[:, 2] / 2)
    rig = read_rig(folder / CALIBRATION, source.size, unit)
    return StereoSequence(source.name, frames, left, disparities, rig)


def _targets(source: Source, labels: Path) -> Iterator[StereoSequence]:
    """The targets that are labeled in enough frames in a row and large enough in the first of them."""
    if source.calibration is None:
        raise ValueError(f"{labels}: expected calibration beside the images")
    frames, cameras = tuple(source), source.kitti_cameras
    rig = read_rig(source.calibration, source.size, kitti_cameras=cameras)
    offset = read_kitti_offset(source.calibration, camera=cameras[0])
    for label in kitti.read_labels(labels):
        first, last = int(label.frames[0]), int(label.frames[-1])
        gaps = len(label.frames) <= last - first
        if gaps or len(label.frames) < MIN_KITTI_FRAMES or label.boxes[0, 2:].min() < MIN_KITTI_SIDE:
            continue
        # labels are in camera 0's frame
        disparities = rig.intrinsics.fx * rig.baseline / (label.front_depths + offset[2])
        name = f"{source.name} {label.name}"
        yield StereoSequence(name, frames[first : last + 1], label.boxes, disparities, rig)
