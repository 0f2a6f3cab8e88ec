# SPDX-License-Identifier: MIT
"""Curves of a head in metres: how far off it is, how honest its covariance, how late, and where time goes."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.track import Status

Floats = NDArray[np.float64]

FUSED, UNFUSED, PAPERS_FILTER = "fused (default)", "unfused", "the paper's filter"
MODULES = ("search", "disparity", "filter", "rest")

HALF, HIDDEN = 0.5, 0.15  # visible shares: from the first errors count, under the second the head is hidden
HELD = 0.5  # of overlap: on the head above it
RETAKEN = 15  # frames within which a head is taken up again
LAST = 5  # frames at the end
SHIFTS: Floats = np.arange(-300, 301) / 100  # frames, from which the lag is chosen

COLUMNS = (
    "scene",
    "tracker",
    "error %: median",
    "95 %",
    "IoU > 0.5",
    "NEES",
    "lag",
    "hidden, not TRACKED",
    f"again within {RETAKEN}",
    "right at the end",
    "runs",
)
CSV_COLUMNS = (
    *("model", "scene", "seed", "frame", "x", "y", "z", "true_x", "true_y", "true_z"),
    *("deviation_m", "nees", "iou", "visible", "status"),
)


@dataclass(frozen=True, slots=True, eq=False)
class StereoCurve:
    """One model in one scene."""

    model: str
    scene: str
    seed: int
    positions: Floats
    """(M, 3) said, metres; NaN without a position."""
    truth: Floats
    """(M, 3) metres."""
    covariances: Floats
    """(M, 3, 3) of the positions, square metres; NaN without one."""
    overlaps: Floats
    """(M,) intersection over union with the box round the whole head."""
    visible: Floats
    """(M,) share of the head that nothing hides."""
    statuses: tuple[Status, ...]
    seconds: Mapping[str, float]
    """Of an update, per module."""

    @property
    def errors(self) -> Floats:
        """(M,) distances from the true positions, as a share of the distance from the camera."""
        off, far = (np.linalg.norm(each, axis=1) for each in (self.positions - self.truth, self.truth))
        return np.asarray(off / far)

    @property
    def deviations(self) -> Floats:
        """(M,) metres: what the covariances say of the distance from the truth, the root of their trace."""
        return np.asarray(np.sqrt(np.trace(self.covariances, axis1=1, axis2=2)))

    @property
    def nees(self) -> Floats:
        """(M,) errors squared, normalised by their covariance: 3 in the mean, if that is honest."""
        off = self.positions - self.truth
        weighed = np.full((*off.shape, 1), np.nan)
        known = np.isfinite(self.covariances).all(axis=(1, 2))
        weighed[known] = np.linalg.solve(self.covariances[known], off[known, :, None])
        return np.asarray((off * weighed[..., 0]).sum(axis=1))

    @property
    def tracked(self) -> NDArray[np.bool_]:
        """(M,) where the tracker says TRACKED."""
        return np.array([status is Status.TRACKED for status in self.statuses])

    @property
    def held(self) -> NDArray[np.bool_]:
        """(M,) where it says so and is on the head."""
        return self.tracked & (self.overlaps > HELD)

    @property
    def right_at_end(self) -> bool:
        """Whether it is on the head in all of the last frames."""
        return bool(self.held[-LAST:].all())

    @property
    def retaken(self) -> bool | None:
        """Whether a head that was hidden is soon on track after half of it is seen; None if none was."""
        hidden = np.flatnonzero(self.visible < HIDDEN)
        if not hidden.size:
            return None
        seen = np.flatnonzero(self.visible[hidden[-1] :] >= HALF)
        back = hidden[-1] + seen[0] if seen.size else len(self.visible)
        return bool(self.held[back : back + RETAKEN + 1].any())


def lag(runs: Sequence[StereoCurve]) -> float:
    """Frames by which tracks are late: shifted by them against the truth they are nearest to it.

    Nearest by the squares of errors as shares of the distance, in frames in which the head is held; the truth
    between two frames lies on the line from one to the other. NaN where none is held.
    """
    costs = np.zeros(len(SHIFTS))
    count = 0
    for curve in runs:
        frames = np.arange(len(curve.truth), dtype=np.float64)
        inner = (frames >= SHIFTS[-1]) & (frames <= frames[-1] + SHIFTS[0])
        chosen = curve.held & inner & np.isfinite(curve.positions).all(axis=1)
        moments = frames[chosen, None] - SHIFTS
        truth = np.stack([np.interp(moments, frames, axis) for axis in curve.truth.T], axis=-1)
        off = (curve.positions[chosen, None] - truth) / np.linalg.norm(truth, axis=-1, keepdims=True)
        costs += (off**2).sum(axis=(0, 2))
        count += int(chosen.sum())
    return float(SHIFTS[np.argmin(costs)]) if count else float("nan")


def summarize(curves: Sequence[StereoCurve]) -> str:
    """Markdown, a line per scene and model: COLUMNS; then the time per module of the default."""
    lines = [f"| {' | '.join(COLUMNS)} |", "| --- " * len(COLUMNS) + "|"]
    scenes, models = (list(dict.fromkeys(getattr(c, name) for c in curves)) for name in ("scene", "model"))
    for scene, model in product(scenes, models):
        runs = [curve for curve in curves if (curve.scene, curve.model) == (scene, model)]
        lines.append(f"| {scene} | {model} | {' | '.join(_numbers(runs))} |")
    lines += ["", f"| us per frame, {models[0]} | {' | '.join((*MODULES, 'whole'))} |"]
    lines.append("| --- " * (len(MODULES) + 2) + "|")
    for scene in scenes:
        times = [1e6 * each for each in module_seconds(curves, scene, models[0]).values()]
        lines.append(f"| {scene} | {' | '.join(f'{each:.0f}' for each in (*times, sum(times)))} |")
    return "\n".join(lines)


def module_seconds(curves: Sequence[StereoCurve], scene: str, model: str) -> dict[str, float]:
    """Of an update, per module of MODULES: medians over the runs of a model in a scene."""
    runs = [curve for curve in curves if (curve.scene, curve.model) == (scene, model)]
    return {name: float(np.median([curve.seconds.get(name, 0.0) for curve in runs])) for name in MODULES}


def write_csv(path: Path, curves: Iterable[StereoCurve]) -> None:
    """A line per model, scene, seed and frame; what the tracker doesn't say is empty."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for curve in curves:
            numbers = np.column_stack(
                [curve.positions, curve.truth, curve.deviations, curve.nees, curve.overlaps, curve.visible]
            )
            for frame, (row, status) in enumerate(zip(numbers.tolist(), curve.statuses, strict=True)):
                cells = ["" if np.isnan(value) else f"{value:.4f}" for value in row]
                writer.writerow([curve.model, curve.scene, curve.seed, frame, *cells, status])


def _numbers(runs: Sequence[StereoCurve]) -> list[str]:
    seen = _joined(curve.visible >= HALF for curve in runs)
    errors = _joined(curve.errors for curve in runs)[seen] * 100
    known = errors[~np.isnan(errors)]
    median, high = np.percentile(known, [50, 95]) if known.size else (np.nan, np.nan)
    nees = _joined(curve.nees[curve.tracked & (curve.visible >= HALF)] for curve in runs)
    hidden = _joined(~curve.tracked[curve.visible < HIDDEN] for curve in runs)
    retaken = [curve.retaken for curve in runs if curve.retaken is not None]
    return [
        _number(median, 2),
        _number(high, 1),
        _share(_joined(curve.overlaps > HELD for curve in runs)[seen]),
        _number(float(nees.mean()) if nees.size else np.nan, 1),
        _number(lag(runs), 2),
        _share(hidden),
        _share(np.array(retaken)),
        _share(np.array([curve.right_at_end for curve in runs])),
        f"{len(runs)}",
    ]


def _joined(arrays: Iterable[NDArray[np.generic]]) -> NDArray[np.generic]:
    return np.concatenate(list(arrays))


def _number(value: float, digits: int) -> str:
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def _share(answers: NDArray[np.generic]) -> str:
    return f"{answers.astype(float).mean():.1%}" if answers.size else "-"
