# SPDX-License-Identifier: MIT
"""Center errors and overlaps over time, their table and their CSV."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tricue.papers import tables
from tricue.papers.curves import MIN_OVERLAP, Curve, Floats, models_of

MAX_CENTER_ERROR = 25.0
"""Pixels; a face farther off counts as lost."""
COLUMNS = ("model", "mean error px", "frames > 25 px off", "frames IoU > 0.5", "runs")
CSV_COLUMNS = ("model", "scene", "seed", "frame", "error_px", "iou")


@dataclass(frozen=True, slots=True, eq=False)
class ColorCurve(Curve):
    """One observation model in one scene."""

    errors: Floats
    """(M,) center errors in pixels."""
    boxes: Floats
    """(M, 4)"""


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


def write_csv(path: Path, curves: Iterable[ColorCurve]) -> None:
    """A line per model, scene, seed and frame: CSV_COLUMNS."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: ColorCurve) -> Iterator[tuple[str, str]]:
    for error, overlap in zip(curve.errors, curve.overlaps, strict=True):
        yield f"{error:.3f}", f"{overlap:.4f}"
