# SPDX-License-Identifier: MIT
"""Center errors and overlaps over time, their tables and their CSV."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tricue.arrays import Floats
from tricue.papers import tables
from tricue.papers.curves import HIDDEN_BELOW, MIN_OVERLAP, MIN_VISIBLE, VisibilityCurve, models_of

MAX_CENTER_ERROR = 25.0
"""Pixels; beyond this a face counts as lost."""
MIN_FAST_STEP = 10.0
"""Pixels; the target is fast in frames in which it moves more."""
MAX_RECOVERY_DELAY = 15
"""Frames within which a hidden target must be recovered."""
END_FRAMES = 5
"""Last frames of a scene; their mean overlap determines whether the tracker ends on the target."""

COLUMNS = ("model", "mean error px", "frames > 25 px off", "frames IoU > 0.5", "runs")
SCENE_COLUMNS = (
    "scene",
    "model",
    "error px: median",
    "IoU > 0.5",
    f"IoU > 0.5 in steps > {MIN_FAST_STEP:.0f} px",
    f"held within {MAX_RECOVERY_DELAY} after hidden",
    "correct at the end",
    "runs",
)
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_px", "iou", "visible")


@dataclass(frozen=True, slots=True, eq=False)
class ColorCurve(VisibilityCurve):
    """One observation model in one scene."""

    errors: Floats
    """(M,) center errors in pixels."""
    boxes: Floats
    """(M, 4)"""
    steps: Floats
    """(M,) pixels by which the target moved since the last frame; 0 in the first."""

    @property
    def recovered(self) -> list[bool]:
        """For each reappearance after being hidden, whether the target is recovered in time."""
        answers, hidden = [], False
        for frame, share in enumerate(self.visible.tolist()):
            if share < HIDDEN_BELOW:
                hidden = True
            elif hidden and share >= MIN_VISIBLE:
                hidden = False
                window = self.overlaps[frame : frame + MAX_RECOVERY_DELAY + 1]
                answers.append(bool((window > MIN_OVERLAP).any()))
        return answers

    @property
    def correct_at_end(self) -> bool:
        """Whether the mean overlap of the last frames is high enough."""
        return bool(self.overlaps[-END_FRAMES:].mean() > MIN_OVERLAP)


def summarize(curves: Sequence[ColorCurve]) -> str:
    """Markdown, a line per model over all scenes: COLUMNS; the error ± its standard deviation over runs."""
    lines = tables.header(COLUMNS)
    for model in models_of(curves):
        runs = [curve for curve in curves if curve.model == model]
        errors, overlaps = (np.stack([getattr(run, name) for run in runs]) for name in ("errors", "overlaps"))
        error = f"{errors.mean():.1f} ± {errors.mean(axis=1).std():.1f}"
        shares = [f"{np.mean(flags):.1%}" for flags in (errors > MAX_CENTER_ERROR, overlaps > MIN_OVERLAP)]
        lines.append(tables.line([model, error, *shares, f"{len(runs)}"]))
    return "\n".join(lines)


def summarize_scenes(curves: Sequence[ColorCurve]) -> str:
    """Markdown, a line per scene and model: SCENE_COLUMNS, of the frames with half of the target visible."""
    return "\n".join(tables.scene_table(curves, SCENE_COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[ColorCurve]) -> None:
    """A line per model, scene, seed and frame: CSV_COLUMNS."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _cells(runs: Sequence[ColorCurve]) -> list[str]:
    counted = np.concatenate([run.counted for run in runs])
    errors, overlaps, steps = (
        np.concatenate([getattr(run, name) for run in runs])[counted]
        for name in ("errors", "overlaps", "steps")
    )
    return [
        f"{np.median(errors):.1f}",
        tables.percent(overlaps > MIN_OVERLAP, 1),
        tables.percent(overlaps[steps > MIN_FAST_STEP] > MIN_OVERLAP, 1),
        tables.percent([answer for run in runs for answer in run.recovered]),
        tables.percent([run.correct_at_end for run in runs]),
        f"{len(runs)}",
    ]


def _frames(curve: ColorCurve) -> Iterator[tuple[str, str, str]]:
    for error, overlap, visible in zip(curve.errors, curve.overlaps, curve.visible, strict=True):
        yield f"{error:.3f}", f"{overlap:.4f}", f"{visible:.4f}"
