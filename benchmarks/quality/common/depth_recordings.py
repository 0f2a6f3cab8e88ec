# SPDX-License-Identifier: MIT
"""Recorded color and depth: all targets of a sequence, color registered to depth, true depths."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from tricue.camera.frame import Frame
from tricue.data.truth import OTB_TRUTH, VOT_TRUTH, read_truth_file
from tricue.evaluation.dataset import Entry, OpenedSequence, find_entries
from tricue.evaluation.tracker_spec import SequenceInfo

from benchmarks.quality.common.frame_results import Array
from benchmarks.quality.common.recordings import Recording
from benchmarks.quality.common.registered_frames import color_camera, registered
from benchmarks.quality.common.variants import Inputs

FURTHER_TRUTH = "groundtruth_*.txt"
"""Files with the true boxes of another target, beside VOT_TRUTH; the star stands for the target's name."""


@dataclass(frozen=True)
class FurtherTarget(Entry):
    """Another target of a sequence, whose true boxes are in a separate file."""

    truth_file: Path = Path(VOT_TRUTH)

    def open(self) -> OpenedSequence:
        """The sequence with the boxes in that file. ValueError or OSError names a file that can't be read."""
        opened, truth = super().open(), read_truth_file(self.truth_file)
        source = replace(opened.source, truth=truth.boxes, absent=truth.absent, positions=truth.positions)
        return OpenedSequence(self, source)


def find_targets(root: Path) -> list[Entry]:
    """The sequences at or under a folder, as from ``find_entries``, and their other targets.

    "mug chair", for example, is from mug/groundtruth_chair.txt. ValueError if there is no sequence.
    """
    return [each for entry in find_entries(root) for each in (entry, *_further_targets(entry))]


def _further_targets(entry: Entry) -> list[FurtherTarget]:
    prefix = len(Path(VOT_TRUTH).stem) + 1
    return [
        FurtherTarget(f"{entry.name} {path.stem[prefix:]}", entry.place, truth_file=path)
        for path in sorted(entry.place.glob(FURTHER_TRUTH))
        if path.name != OTB_TRUTH
    ]


@dataclass(frozen=True)
class DepthRecording(Recording):
    """A sequence with color and depth in the same pixels.

    shift: meters to the right from the color to the depth camera. It is used if the two aren't registered:
    then color is registered to depth, in whose pixels the true boxes are.
    """

    shift: float = 0.0

    @cached_property
    def inputs(self) -> SequenceInfo:
        """Channels and cameras after the registration."""
        opened = self.opened
        return Inputs(opened.channels, opened.intrinsics) if self._unregistered else opened

    @cached_property
    def frames(self) -> Sequence[Frame]:
        """All frames, in memory."""
        opened = self.opened
        if self._unregistered:
            return registered(opened, color_camera(opened), self.shift)
        return list(opened.source)

    @cached_property
    def depths(self) -> Array:
        """(N,) meters: the recorded true depths, or else the depths measured in the true boxes."""
        opened, count = self.opened, len(self.frames)
        known = opened.positions(count)[:, 2]
        return measured_depths(self.frames, opened.truth(count)) if np.isnan(known).all() else known

    @property
    def _unregistered(self) -> bool:
        opened = self.opened
        return opened.channel == "depth" and "color" in opened.channels and not opened.registered


def measured_depths(frames: Sequence[Frame], boxes: Array) -> Array:
    """(N,) the median depth in the inner half of each box (N, 4) along both sides, meters.

    NaN if the box is unknown or nothing in it was measured. This is the depth of whatever is visible there,
    also of an occluder.
    """
    return np.array([_inner_depth(frame, box) for frame, box in zip(frames, boxes, strict=True)])


def _inner_depth(frame: Frame, box: Array) -> float:
    if frame.depth is None or np.isnan(box).any():
        return float("nan")
    x, y, width, height = box.tolist()
    columns, rows = _inner_pixels(x, width), _inner_pixels(y, height)
    inside = frame.depth[rows, columns]
    measured = inside[~np.isnan(inside)]
    return float(np.median(measured)) if measured.size else float("nan")


def _inner_pixels(start: float, length: float) -> slice:
    """The inner half of a side, at least one pixel."""
    first = max(round(start + length / 4), 0)
    return slice(first, max(round(start + length * 3 / 4), first + 1))
