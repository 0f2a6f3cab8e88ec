# SPDX-License-Identifier: MIT
"""Overlaps over frames with changing light, their table and their CSV."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tricue.arrays import Floats
from tricue.papers import tables
from tricue.papers.curves import MIN_OVERLAP, Curve

COLUMNS = ("scene", "tracker", "IoU: all frames", "first sixth", "last sixth", "frames IoU > 0.5", "runs")
CSV_COLUMNS = ("model", "scene", "seed", "frame", "light", "iou")


@dataclass(frozen=True, slots=True, eq=False)
class LitCurve(Curve):
    """One model in one scene; overlaps are with the head for color trackers, else with the body."""

    light: Floats
    """(M,) 1 indoors, 0 in darkness, 100 in the sun."""
    boxes: Floats
    """(M, 4) pixels."""


def summarize(curves: Sequence[LitCurve]) -> str:
    """Markdown, a line per scene and model: COLUMNS; means over frames and runs."""
    return "\n".join(tables.scene_table(curves, COLUMNS, _cells))


def write_csv(path: Path, curves: Iterable[LitCurve]) -> None:
    """A line per model, scene, seed and frame: CSV_COLUMNS."""
    tables.write_csv(path, CSV_COLUMNS, curves, _frames)


def _frames(curve: LitCurve) -> Iterator[tuple[str, str]]:
    for light, overlap in zip(curve.light.tolist(), curve.overlaps.tolist(), strict=True):
        yield f"{light:.6g}", tables.csv_number(overlap)


def _cells(runs: Sequence[LitCurve]) -> list[str]:
    overlaps = np.stack([run.overlaps for run in runs])
    sixth = max(1, overlaps.shape[1] // 6)
    parts = overlaps, overlaps[:, :sixth], overlaps[:, -sixth:]
    return [
        *(f"{part.mean():.2f}" for part in parts),
        tables.percent(overlaps.ravel() > MIN_OVERLAP),
        f"{len(runs)}",
    ]
