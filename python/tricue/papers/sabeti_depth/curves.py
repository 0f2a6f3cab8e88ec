# SPDX-License-Identifier: MIT
"""A person in depth: position errors, and the tracker's reports while the person is hidden."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tricue.arrays import Flags, Floats
from tricue.papers import tables
from tricue.papers.curves import HIDDEN_BELOW, MIN_OVERLAP, MIN_VISIBLE, OcclusionCurve
from tricue.track.base.track import Status

MAX_PERSON_OCCLUDED_DELAY = 3
"""Frames within which an occlusion must be reported."""
MAX_PERSON_RECOVERY_DELAY = 5
"""Frames within which the person must be tracked again."""
PERSON_END_FRAMES = 5
"""Last frames of a scene; their mean overlap determines whether the tracker ends on the person."""

COLUMNS = (
    "scene",
    "tracker",
    "IoU",
    "error cm: median",
    "95 %",
    "correct at the end",
    f"OCCLUDED within {MAX_PERSON_OCCLUDED_DELAY}",
    f"recovered within {MAX_PERSON_RECOVERY_DELAY}",
    "frames on others",
    "never LOST",
    "correct start",
    "runs",
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_m", "iou", "visible", "status", "on_other")


@dataclass(frozen=True, slots=True, eq=False)
class DepthCurve(OcclusionCurve):
    """One model in one scene."""

    errors: Floats
    """(M,) distances of the position from the true one, meters; NaN without a position."""
    on_other: Flags
    """(M,) where the status is TRACKED and the tracker is on somebody else."""
    boxes: Floats
    """(M, 4) pixels."""
    starts: bool | None = None
    """Whether the tracker finds the person without a box; None if that wasn't tested."""

    @property
    def correct_at_end(self) -> bool:
        """Whether the mean overlap of the last frames is high enough, and the last one is TRACKED."""
        on_target = self.overlaps[-PERSON_END_FRAMES:].mean() > MIN_OVERLAP
        return bool(on_target and self.statuses[-1] is Status.TRACKED)

    @property
    def occlusion_reported(self) -> list[bool]:
        """For each occlusion, whether OCCLUDED is reported in time."""
        return [
            Status.OCCLUDED in self.statuses[first : first + MAX_PERSON_OCCLUDED_DELAY + 1]
            for first, _ in self._occlusions
        ]

    @property
    def recovered(self) -> list[bool]:
        """For each occlusion that ends, whether the person is tracked again in time."""
        correct, last = self.correct, MAX_PERSON_RECOVERY_DELAY + 1
        return [bool(correct[end : end + last].any()) for _, end in self._occlusions if end]

    @property
    def _occlusions(self) -> list[tuple[int, int | None]]:
        """Per occlusion, the frames in which the person gets hidden and half visible again; None if never."""
        found: list[tuple[int, int | None]] = []
        first = None
        for frame, share in enumerate(self.visible.tolist()):
            if first is None and share < HIDDEN_BELOW:
                first = frame
            elif first is not None and share >= MIN_VISIBLE:
                found.append((first, frame))
                first = None
        return found if first is None else [*found, (first, None)]


def summarize(curves: Sequence[DepthCurve]) -> str:
    """Markdown, a line per scene and model: COLUMNS; IoU and errors in frames with at least half visible."""
    return "\n".join(tables.scene_table(curves, COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[DepthCurve]) -> None:
    """A line per model, scene, seed and frame: CSV_COLUMNS; without a position the error is empty."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: DepthCurve) -> Iterator[list[object]]:
    columns = (curve.errors, curve.overlaps, curve.visible, curve.statuses, curve.on_other)
    for error, overlap, visible, status, on_other in zip(*columns, strict=True):
        numbers = [tables.csv_number(value) for value in (error, overlap, visible)]
        yield [*numbers, status, int(on_other)]


def _cells(runs: Sequence[DepthCurve]) -> list[str]:
    counted = np.concatenate([run.counted for run in runs])
    errors = np.concatenate([run.errors for run in runs])[counted] * 100
    return [
        f"{np.concatenate([run.overlaps for run in runs])[counted].mean():.2f}",
        *(tables.number(value, 1) for value in tables.percentiles(errors, 50, 95)),
        tables.percent([run.correct_at_end for run in runs]),
        tables.percent([all(run.occlusion_reported) for run in runs if run.occlusion_reported]),
        tables.percent([all(run.recovered) for run in runs if run.recovered]),
        f"{sum(int(run.on_other.sum()) for run in runs)}",
        tables.percent([Status.LOST not in run.statuses for run in runs]),
        tables.percent([run.starts for run in runs if run.starts is not None]),
        f"{len(runs)}",
    ]
