# SPDX-License-Identifier: MIT
"""A walker in front of a verged stereo pair: overlaps and depth errors."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tricue.arrays import Floats
from tricue.papers import tables
from tricue.papers.curves import MIN_OVERLAP, OcclusionCurve

COLUMNS = (
    *("scene", "tracker", "IoU > 0.5", "depth error m: median", "90 %", "depth error m, signed: median"),
    *("frames with a depth", "started", "runs"),
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "depth_error_m", "iou", "status")


@dataclass(frozen=True, slots=True, eq=False)
class VergenceCurve(OcclusionCurve):
    """One tracker in one scene until the overtaking. If the tracker doesn't start, overlaps are 0."""

    vergence: float
    """Degrees by which the right camera is turned inward."""
    depth_errors: Floats
    """(M,) meters, positive if the target is found too far away; NaN without a position."""
    started: bool


def summarize(curves: Sequence[VergenceCurve]) -> str:
    """Markdown, a line per scene and tracker: COLUMNS."""
    return "\n".join(tables.scene_table(curves, COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[VergenceCurve]) -> None:
    """A line per tracker, scene, seed and frame: CSV_COLUMNS; without a position the error is empty."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: VergenceCurve) -> Iterator[list[object]]:
    for error, overlap, status in zip(curve.depth_errors, curve.overlaps, curve.statuses, strict=True):
        yield [tables.csv_number(error), tables.csv_number(overlap), status]


def _cells(runs: Sequence[VergenceCurve]) -> list[str]:
    overlaps = np.concatenate([run.overlaps[1:] for run in runs])
    errors = np.concatenate([run.depth_errors[1:] for run in runs])
    return [
        tables.percent(overlaps > MIN_OVERLAP),
        *(tables.number(each, 2) for each in tables.percentiles(np.abs(errors), 50, 90)),
        tables.number(tables.percentiles(errors, 50)[0], 2),
        tables.percent(np.isfinite(errors)),
        tables.percent([run.started for run in runs]),
        f"{len(runs)}",
    ]
