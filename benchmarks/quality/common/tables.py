# SPDX-License-Identifier: MIT
"""Measured numbers as Markdown and as CSV, and their means."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

Cell = str | float


def markdown(head: Sequence[str], rows: Iterable[Sequence[Cell]], digits: int = 3) -> str:
    """A table; digits: after the decimal point. NaN is "-"."""
    lines = [list(head), ["---"] * len(head), *([_text(cell, digits) for cell in row] for row in rows)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def write_csv(path: Path | None, head: Sequence[str], rows: Iterable[Sequence[Cell]]) -> None:
    """Write a CSV with all digits of the numbers, and NaN as an empty cell; without a path, do nothing."""
    if path is None:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows([["" if _unknown(cell) else cell for cell in row] for row in rows])


def mean(values: ArrayLike) -> float:
    """The mean of the values that aren't NaN; NaN if all are."""
    known = np.asarray(values, np.float64)
    known = known[~np.isnan(known)]
    return float(known.mean()) if known.size else float("nan")


def _text(cell: Cell, digits: int) -> str:
    if isinstance(cell, str):
        return cell
    return "-" if _unknown(cell) else str(cell) if isinstance(cell, int) else f"{cell:.{digits}f}"


def _unknown(cell: Cell) -> bool:
    return isinstance(cell, float) and bool(np.isnan(cell))
