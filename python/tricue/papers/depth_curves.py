# SPDX-License-Identifier: MIT
"""Curves of a target in depth: how far off it is, and what becomes of it while it is hidden."""

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.track import Status

HALF, HIDDEN = 0.5, 0.15  # visible shares: from the first errors count, under the second the target is hidden
HELD = 0.5  # of overlap: on the right person above it
SAID, RETAKEN = 3, 5  # frames within which an occlusion is said, and the target taken up again
LAST = 5  # frames at the end

Floats = NDArray[np.float64]

COLUMNS = (
    "scene",
    "tracker",
    "IoU",
    "error cm: median",
    "95 %",
    "right at the end",
    f"OCCLUDED within {SAID}",
    f"again within {RETAKEN}",
    "frames on others",
    "never LOST",
    "starts right",
    "runs",
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_m", "iou", "visible", "status", "on_other")


@dataclass(frozen=True, slots=True, eq=False)
class DepthCurve:
    """One model in one scene."""

    model: str
    scene: str
    seed: int
    errors: Floats
    """(M,) distances of the position from the true one, metres; NaN without a position."""
    overlaps: Floats
    """(M,) intersection over union with the box round the target's whole body."""
    visible: Floats
    """(M,) share of the target that nothing hides."""
    statuses: tuple[Status, ...]
    astray: NDArray[np.bool_]
    """(M,) where the tracker says TRACKED and is on somebody else."""
    starts: bool | None = None
    """Whether it finds the target without a box; None where that wasn't asked."""

    @property
    def right_at_end(self) -> bool:
        """Whether the last frames overlap with the target in the mean, and the very last is TRACKED."""
        return bool(self.overlaps[-LAST:].mean() > HELD and self.statuses[-1] is Status.TRACKED)

    @property
    def said(self) -> list[bool]:
        """For each time that the target gets hidden, whether OCCLUDED is said soon."""
        return [Status.OCCLUDED in self.statuses[: gone + SAID + 1][gone:] for gone, _ in self._hidings]

    @property
    def retaken(self) -> list[bool]:
        """For each time that the hidden target is half visible again, whether it is soon tracked."""
        held = (self.overlaps > HELD) & [status is Status.TRACKED for status in self.statuses]
        return [bool(held[: back + RETAKEN + 1][back:].any()) for _, back in self._hidings if back]

    @property
    def _hidings(self) -> list[tuple[int, int | None]]:
        """The frames in which the target gets hidden, and is half visible again, None if never."""
        found: list[tuple[int, int | None]] = []
        gone = None
        for frame, share in enumerate(self.visible.tolist()):
            if gone is None and share < HIDDEN:
                gone = frame
            elif gone is not None and share >= HALF:
                found.append((gone, frame))
                gone = None
        return found if gone is None else [*found, (gone, None)]


def summarize(curves: Sequence[DepthCurve]) -> str:
    """Markdown, a line per scene and model: COLUMNS; IoU and errors in the frames at least half visible."""
    lines = [f"| {' | '.join(COLUMNS)} |", "| --- " * len(COLUMNS) + "|"]
    scenes, models = (list(dict.fromkeys(getattr(c, name) for c in curves)) for name in ("scene", "model"))
    for scene, model in product(scenes, models):
        runs = [curve for curve in curves if (curve.scene, curve.model) == (scene, model)]
        lines.append(f"| {scene} | {model} | {' | '.join(_numbers(runs))} |")
    return "\n".join(lines)


def write_csv(path: Path, curves: Iterable[DepthCurve]) -> None:
    """A line per model, scene, seed and frame; without a position the error is empty."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for curve in curves:
            columns = (curve.errors, curve.overlaps, curve.visible, curve.statuses, curve.astray)
            for frame, (error, overlap, visible, status, astray) in enumerate(zip(*columns, strict=True)):
                off = "" if np.isnan(error) else f"{error:.4f}"
                writer.writerow(
                    [curve.model, curve.scene, curve.seed, frame, off, f"{overlap:.4f}", f"{visible:.4f}"]
                    + [status, int(astray)]
                )


def _numbers(runs: Sequence[DepthCurve]) -> list[str]:
    seen = np.concatenate([curve.visible >= HALF for curve in runs])
    errors = np.concatenate([curve.errors for curve in runs])[seen] * 100
    known = errors[~np.isnan(errors)]
    median, high = np.percentile(known, [50, 95]) if known.size else (np.nan, np.nan)
    return [
        f"{np.concatenate([curve.overlaps for curve in runs])[seen].mean():.2f}",
        *("-" if np.isnan(value) else f"{value:.1f}" for value in (median, high)),
        _share([curve.right_at_end for curve in runs]),
        _share([all(curve.said) for curve in runs if curve.said]),
        _share([all(curve.retaken) for curve in runs if curve.retaken]),
        f"{sum(int(curve.astray.sum()) for curve in runs)}",
        _share([Status.LOST not in curve.statuses for curve in runs]),
        _share([curve.starts for curve in runs if curve.starts is not None]),
        f"{len(runs)}",
    ]


def _share(answers: Sequence[bool]) -> str:
    return f"{np.mean(answers):.0%}" if answers else "-"
