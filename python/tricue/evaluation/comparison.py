# SPDX-License-Identifier: MIT
"""One tracker's run on one recorded sequence, as a row of numbers."""

import csv
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation import metrics
from tricue.evaluation.one_pass import Contender, Run
from tricue.evaluation.sequences import Sequence

Maker = Callable[[int], Contender]
"""Makes a tracker from a seed."""


@dataclass(frozen=True, slots=True)
class Row:
    """One tracker on one sequence from one seed: metrics.Score's numbers, and what else was measured."""

    tracker: str
    sequence: str
    seed: int
    auc: float
    precision: float
    norm_precision: float
    success: float
    mean_error: float
    iou: float
    """Mean overlap."""
    depth_error: float
    """Median, metres; NaN where the tracker gives no position or the truth none."""
    lost: float
    """Share of the frames."""
    fps: float
    p50_ms: float
    p99_ms: float


def row_of(name: str, seed: int, sequence: Sequence, result: Run, boxes: NDArray[np.float64]) -> Row:
    """The numbers of a run, with its boxes or what was made of them, (M, 4)."""
    score = metrics.score(boxes, sequence.truth)
    overlaps = metrics.overlaps(boxes, sequence.truth)
    known = overlaps[~np.isnan(overlaps)]
    p50, p99 = np.percentile(result.seconds * 1e3, [50, 99])
    return Row(
        name,
        sequence.name,
        seed,
        **asdict(score),
        iou=float(known.mean()) if known.size else float("nan"),
        depth_error=_median(np.abs(result.positions[:, 2] - sequence.depths)),
        lost=result.lost,
        fps=result.frames_per_second,
        p50_ms=float(p50),
        p99_ms=float(p99),
    )


def write_csv(path: Path, rows: Iterable[Row]) -> None:
    """A line per row, the names of Row's fields on top."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Row)])
        writer.writeheader()
        writer.writerows(asdict(each) for each in rows)


def _median(errors: NDArray[np.float64]) -> float:
    known = errors[~np.isnan(errors)]
    return float(np.median(known)) if known.size else float("nan")
