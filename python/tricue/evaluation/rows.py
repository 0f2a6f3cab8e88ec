# SPDX-License-Identifier: MIT
"""Runs in numbers: one row per run, and means over seeds and sequences."""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.evaluation import confidence, long_term, metrics, restarts
from tricue.evaluation.dataset import OpenedSequence
from tricue.evaluation.one_pass import Run
from tricue.evaluation.protocols import ONE_PASS
from tricue.evaluation.record import Record
from tricue.track.base.track import Status

_OF_TRUTH = ("truth", "overlaps", "position_errors")


@dataclass(frozen=True, slots=True, eq=False)
class ScoredRun:
    """A run compared with the truth, over the N frames from its start on; arrays have length N.

    start: the frame, counted from the sequence's first. error: the error that ended the tracker, or "".
    frames: the frames' numbers in the sequence.
    """

    start: int
    boxes: Floats
    truth: Floats
    absent: NDArray[np.bool_]
    overlaps: Floats
    scores: Floats
    statuses: tuple[Status, ...]
    tracked: NDArray[np.bool_]
    position_errors: Floats
    error: str = ""
    frames: NDArray[np.intp] | None = None


@dataclass(frozen=True, slots=True)
class Row:
    """One tracker on one sequence from one seed. Shares are in [0, 1]; NaN where a number is undefined."""

    group: str
    sequence: str
    tracker: str
    seed: int
    frames: int
    auc: float
    precision: float
    norm_precision: float
    success: float
    iou: float
    """Mean overlap."""
    tracked: float
    """Share of the frames with known truth that have status TRACKED, right or wrong."""
    true_positive: float
    true_negative: float
    f_score: float
    """F of VOT long-term, for this sequence alone."""
    auroc: float
    """Probability that a frame on the target scores above one with an overlap under 0.1."""
    ok_while_lost: float
    """Share of the frames that are TRACKED although the overlap is under 0.1 or the target absent."""
    position_error: float
    """Median error, meters."""
    failures: float
    """Number of failures in the run with restarts; NaN without one."""
    accuracy: float
    """Mean overlap of the run with restarts."""
    trouble: str = ""
    run: str = ONE_PASS
    """The kind of run, such as "backward-from-25"."""


@dataclass(frozen=True, slots=True)
class Speed:
    """The update times of a run, without decoding."""

    sequence: str
    tracker: str
    seed: int
    fps: float
    p50_ms: float
    p99_ms: float
    run: str = ONE_PASS


def score_run(record: Record, opened: OpenedSequence) -> ScoredRun:
    """Compare a run with the truth, from its first start on. If no later box is known, the first one, on
    which the tracker started, isn't compared either.
    """
    run, since = record.run, slice(record.starts[0], None)
    numbers = record.numbers[since]
    frames = int(numbers.max()) + 1
    boxes = opened.clip(run.boxes)[since]
    truth, absent = opened.truth(frames)[numbers], opened.absent(frames)[numbers]
    if np.isnan(truth[1:]).any(axis=1).all():
        truth[:1] = np.nan
    return ScoredRun(
        start=int(numbers[0]),
        boxes=boxes,
        truth=truth,
        absent=absent,
        overlaps=metrics.overlaps(boxes, truth),
        scores=run.scores[since],
        statuses=run.statuses[since],
        tracked=np.array([status is Status.TRACKED for status in run.statuses[since]], dtype=np.bool_),
        position_errors=metrics.position_errors(run.positions[since], opened.positions(frames)[numbers]),
        error=record.error,
        frames=numbers,
    )


def without_truth(run: ScoredRun) -> ScoredRun:
    """The same run, with no frame counted."""
    unknown = {name: np.full_like(getattr(run, name), np.nan) for name in _OF_TRUTH}
    return dataclasses.replace(run, absent=np.zeros_like(run.absent), **unknown)


def make_row(
    opened: OpenedSequence,
    tracker: str,
    seed: int,
    run: ScoredRun,
    robustness: restarts.Robustness | None = None,
    kind: str = ONE_PASS,
) -> Row:
    """The numbers of a run; for one pass also those of the run with restarts, if there is one."""
    score = metrics.score(run.boxes, run.truth)
    rates = long_term.rates(run.boxes, run.truth, run.tracked, run.absent)
    return Row(
        group=opened.group,
        sequence=opened.entry.name,
        tracker=tracker,
        seed=seed,
        frames=len(run.scores),
        auc=score.auc,
        precision=score.precision,
        norm_precision=score.norm_precision,
        success=score.success,
        iou=_mean(run.overlaps),
        tracked=confidence.tracked(run.overlaps, run.tracked, run.absent),
        true_positive=rates.true_positive,
        true_negative=rates.true_negative,
        f_score=best_f([run]),
        auroc=confidence.auroc(run.overlaps, run.scores, run.absent),
        ok_while_lost=confidence.tracked_while_lost(run.overlaps, run.tracked, run.absent).of_all,
        position_error=_median(run.position_errors),
        failures=float(robustness.failures) if robustness and robustness.frames else float("nan"),
        accuracy=float("nan") if robustness is None else robustness.accuracy,
        trouble=run.error,
        run=kind,
    )


def best_f(runs: Sequence[ScoredRun]) -> float:
    """VOT long-term's F of several sequences; NaN without any visible frame after the first."""
    frames = [long_term.vot_frames(run.boxes, run.truth, run.scores, run.absent) for run in runs]
    known = [each for each in frames if each.visible.any()]
    return long_term.precision_recall(known).best.f if known else float("nan")


def pooled_auroc(runs: Sequence[ScoredRun]) -> float:
    """The AUROC over the frames of several runs, with one threshold on the score for all."""
    overlaps, scores, absent = (
        np.concatenate([getattr(run, name) for run in runs]) for name in ("overlaps", "scores", "absent")
    )
    return confidence.auroc(overlaps, scores, absent)


def measure_speed(opened: OpenedSequence, tracker: str, seed: int, run: Run, kind: str = ONE_PASS) -> Speed:
    """The update times of a run; NaN where none are known."""
    if not run.seconds.size:
        return Speed(opened.entry.name, tracker, seed, math.nan, math.nan, math.nan, kind)
    p50, p99 = np.percentile(run.seconds * 1e3, [50, 99])
    return Speed(opened.entry.name, tracker, seed, run.frames_per_second, float(p50), float(p99), kind)


def by_sequence(rows: Iterable[Row], name: str) -> dict[str, float]:
    """The mean of a number over seeds and starts, for each sequence; NaN where it is undefined."""
    found: dict[str, list[float]] = {}
    for row in rows:
        found.setdefault(row.sequence, []).append(getattr(row, name))
    return {sequence: _mean(np.array(values)) for sequence, values in found.items()}


def mean_row(rows: Sequence[Row]) -> dict[str, float]:
    """The means of the rows' numbers by name, each over the rows in which it is defined."""
    names = [field.name for field in dataclasses.fields(Row) if field.type in (float, "float")]
    return {name: _mean(np.array([getattr(row, name) for row in rows])) for name in names}


def over_sequences(rows: Iterable[Row]) -> dict[str, float]:
    """Means over sequences of the means over seeds and starts, so that every sequence counts once."""
    rows_by_sequence: dict[str, list[Row]] = {}
    for row in rows:
        rows_by_sequence.setdefault(row.sequence, []).append(row)
    means = [mean_row(each) for each in rows_by_sequence.values()]
    return {name: _mean(np.array([mean[name] for mean in means])) for name in means[0]}


def measure_robustness(record: Record, opened: OpenedSequence) -> restarts.Robustness:
    """The numbers of a run with restarts."""
    boxes = opened.clip(record.run.boxes)
    overlaps = metrics.overlaps(boxes, opened.truth(len(boxes)))
    return restarts.robustness(record, overlaps)


def _mean(values: Floats) -> float:
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else float("nan")


def _median(values: Floats) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else float("nan")
