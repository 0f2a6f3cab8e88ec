# SPDX-License-Identifier: MIT
"""A head in stereo: position errors, consistency of covariances, lag, recovery, and time per module."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.papers import tables
from tricue.papers.curves import HIDDEN_BELOW, MIN_OVERLAP, MIN_VISIBLE, OcclusionCurve, runs_of, scenes_of

FUSED, UNFUSED = "fused (default)", "unfused"
PRINTED, PRINTED_UNFUSED = "as printed", "as printed, unfused"
PAPERS_FILTER = "default with the paper's filter"
TIMED_MODULES = ("search", "disparity", "filter", "rest")

MAX_HEAD_RECOVERY_DELAY = 15
"""Frames within which a head must be tracked again."""
HEAD_END_FRAMES = 5
"""Last frames of a scene, in all of which the tracker must be on the head."""
LAGS: Floats = np.arange(-300, 301) / 100
"""Candidate lags, frames."""

COLUMNS = (
    "scene",
    "tracker",
    "error %: median",
    "95 %",
    "IoU > 0.5",
    "NEES",
    "lag",
    "hidden, not TRACKED",
    f"recovered within {MAX_HEAD_RECOVERY_DELAY}",
    "correct at the end",
    "runs",
)
CSV_COLUMNS = (
    *("model", "scene", "seed", "frame", "x", "y", "z", "true_x", "true_y", "true_z"),
    *("box_x", "box_y", "box_width", "box_height", "deviation_m", "nees", "iou", "visible", "status"),
)


@dataclass(frozen=True, slots=True, eq=False)
class StereoCurve(OcclusionCurve):
    """One model in one scene."""

    boxes: Floats
    """(M, 4) estimated x, y, width, height, pixels."""
    positions: Floats
    """(M, 3) estimated, meters; NaN without a position."""
    truth: Floats
    """(M, 3) meters."""
    covariances: Floats
    """(M, 3, 3) of the positions, square meters; NaN without one."""
    seconds: Mapping[str, float]
    """Seconds of an update, per module."""

    @property
    def errors(self) -> Floats:
        """Distances (M,) from the true positions, as a share of the distance from the camera."""
        off, far = (np.linalg.norm(each, axis=1) for each in (self.positions - self.truth, self.truth))
        return np.asarray(off / far)

    @property
    def deviations(self) -> Floats:
        """The root of the covariances' trace (M,), meters: the expected distance from the truth."""
        return np.asarray(np.sqrt(np.trace(self.covariances, axis1=1, axis2=2)))

    @property
    def nees(self) -> Floats:
        """The normalized estimation error squared (M,); its mean is 3 if the covariances are consistent."""
        off = self.positions - self.truth
        weighted = np.full((*off.shape, 1), np.nan)
        known = np.isfinite(self.covariances).all(axis=(1, 2))
        weighted[known] = np.linalg.solve(self.covariances[known], off[known, :, None])
        return np.asarray((off * weighted[..., 0]).sum(axis=1))

    @property
    def correct_at_end(self) -> bool:
        """Whether the tracker is on the head in all of the last frames."""
        return bool(self.correct[-HEAD_END_FRAMES:].all())

    @property
    def recovered(self) -> bool | None:
        """Whether a hidden head is tracked again in time once half of it is visible; None if never hidden."""
        hidden = np.flatnonzero(self.visible < HIDDEN_BELOW)
        if not hidden.size:
            return None
        visible = np.flatnonzero(self.visible[hidden[-1] :] >= MIN_VISIBLE)
        end = hidden[-1] + visible[0] if visible.size else len(self.visible)
        return bool(self.correct[end : end + MAX_HEAD_RECOVERY_DELAY + 1].any())


def lag(runs: Sequence[StereoCurve]) -> float:
    """Frames by which tracks lag: the shift with which they fit the truth best.

    Best means the smallest sum of squared relative errors, over the frames in which the tracker is on the
    head; the truth is interpolated linearly between frames. NaN if there is no such frame.
    """
    costs = np.zeros(len(LAGS))
    count = 0
    for run in runs:
        frames = np.arange(len(run.truth), dtype=np.float64)
        inner = (frames >= LAGS[-1]) & (frames <= frames[-1] + LAGS[0])
        chosen = run.correct & inner & np.isfinite(run.positions).all(axis=1)
        times = frames[chosen, None] - LAGS
        truth = np.stack([np.interp(times, frames, axis) for axis in run.truth.T], axis=-1)
        off = (run.positions[chosen, None] - truth) / np.linalg.norm(truth, axis=-1, keepdims=True)
        costs += (off**2).sum(axis=(0, 2))
        count += int(chosen.sum())
    return float(LAGS[np.argmin(costs)]) if count else float("nan")


def module_seconds(curves: Sequence[StereoCurve], scene: str, model: str) -> dict[str, float]:
    """Seconds of an update, per module of TIMED_MODULES: medians over the runs of a model in a scene."""
    runs = runs_of(curves, scene, model)
    return {name: float(np.median([run.seconds.get(name, 0.0) for run in runs])) for name in TIMED_MODULES}


def summarize(curves: Sequence[StereoCurve]) -> str:
    """Markdown, a line per scene and model: COLUMNS; then the time per module of the first model."""
    model = curves[0].model
    lines = [*tables.scene_table(curves, COLUMNS, _cells), ""]
    lines += tables.header([f"us per frame, {model}", *TIMED_MODULES, "whole"])
    for scene in scenes_of(curves):
        times = [1e6 * seconds for seconds in module_seconds(curves, scene, model).values()]
        lines.append(tables.line([scene, *(f"{time:.0f}" for time in (*times, sum(times)))]))
    return "\n".join(lines)


def write_csv(path: Path, curves: Iterable[StereoCurve]) -> None:
    """A line per model, scene, seed and frame: CSV_COLUMNS; values that aren't estimated are empty."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: StereoCurve) -> Iterator[list[object]]:
    numbers = np.column_stack(
        [
            *(curve.positions, curve.truth, curve.boxes),
            *(curve.deviations, curve.nees, curve.overlaps, curve.visible),
        ]
    )
    for row, status in zip(numbers.tolist(), curve.statuses, strict=True):
        yield [*map(tables.csv_number, row), status]


def _cells(runs: Sequence[StereoCurve]) -> list[str]:
    counted = _joined(run.counted for run in runs)
    errors = np.concatenate([run.errors for run in runs])[counted] * 100
    median, high = tables.percentiles(errors, 50, 95)
    nees = _joined(run.nees[run.tracked & run.counted] for run in runs)
    return [
        tables.number(median, 2),
        tables.number(high, 1),
        tables.percent(_joined(run.overlaps > MIN_OVERLAP for run in runs)[counted], 1),
        tables.number(float(nees.mean()) if nees.size else np.nan, 1),
        tables.number(lag(runs), 2),
        tables.percent(_joined(~run.tracked[run.visible < HIDDEN_BELOW] for run in runs), 1),
        tables.percent([run.recovered for run in runs if run.recovered is not None], 1),
        tables.percent([run.correct_at_end for run in runs], 1),
        f"{len(runs)}",
    ]


def _joined(arrays: Iterable[NDArray[np.generic]]) -> NDArray[np.generic]:
    return np.concatenate(list(arrays))
