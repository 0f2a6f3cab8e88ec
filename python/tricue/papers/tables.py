# SPDX-License-Identifier: MIT
"""Curves as a Markdown table with a line per scene and model, and as a CSV with a line per frame."""

import csv
from collections.abc import Callable, Iterable, Sequence
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.papers.curves import AnyCurve, models_of, runs_of, scenes_of


def scene_table(
    curves: Sequence[AnyCurve], columns: Sequence[str], cells: Callable[[Sequence[AnyCurve]], list[str]]
) -> list[str]:
    """The lines of a table: scene, model, and ``cells`` of their runs.

    columns: all headings, those of scene and model first.
    """
    lines = header(columns)
    for scene, model in product(scenes_of(curves), models_of(curves)):
        lines.append(line([scene, model, *cells(runs_of(curves, scene, model))]))
    return lines


def header(columns: Sequence[str]) -> list[str]:
    """The headings and the rule below them."""
    return [line(columns), "| --- " * len(columns) + "|"]


def line(cells: Iterable[str]) -> str:
    """One line of a table."""
    return f"| {' | '.join(cells)} |"


def write_csv(
    path: Path,
    columns: Sequence[str],
    curves: Iterable[AnyCurve],
    frames: Callable[[AnyCurve], Iterable[Sequence[object]]],
) -> None:
    """A line per model, scene, seed and frame; ``frames`` gives the cells of each frame of a curve.

    columns: all headings, those of model, scene, seed and frame first.
    """
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        for curve in curves:
            for frame, cells in enumerate(frames(curve)):
                writer.writerow([curve.model, curve.scene, curve.seed, frame, *cells])


def csv_number(value: float) -> str:
    """A number for a CSV; empty for NaN."""
    return "" if np.isnan(value) else f"{value:.4f}"


def number(value: float, digits: int) -> str:
    """A number for a table; "-" for NaN."""
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def percent(shares: Sequence[float] | NDArray[np.generic], digits: int = 0) -> str:
    """The mean of shares or booleans as a percentage; "-" if there are none."""
    return f"{np.asarray(shares, np.float64).mean():.{digits}%}" if len(shares) else "-"


def percentiles(values: Floats, *ranks: float) -> list[float]:
    """Percentiles of the values that aren't NaN; NaN if all are."""
    known = values[~np.isnan(values)]
    return [float(np.percentile(known, rank)) if known.size else np.nan for rank in ranks]
