# SPDX-License-Identifier: MIT
"""Trackers beside their peers over recorded sequences: ``python -m tricue.evaluation.compare [FOLDER]``."""

import argparse
import csv
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

import tricue
from tricue.camera.box import Box
from tricue.evaluation import metrics, peers, sequences
from tricue.evaluation.one_pass import Contender, Run, run

Maker = Callable[[int], Contender]

OURS = ("color-particle",)


@dataclass(frozen=True, slots=True)
class Row:
    """One tracker on one sequence from one seed: metrics.Score's numbers, the share of lost frames, speed."""

    tracker: str
    sequence: str
    seed: int
    auc: float
    precision: float
    success: float
    mean_error: float
    lost: float
    fps: float
    p50_ms: float
    p99_ms: float


def measure(name: str, make: Maker, seed: int, sequence: sequences.Sequence) -> Row:
    """Run one tracker over one sequence."""
    result = run(make(seed), sequence.frames, Box(*sequence.truth[0].tolist()))
    score = metrics.score(result.boxes, sequence.truth)
    return Row(name, sequence.name, seed, **asdict(score), lost=result.lost, **_speed(result))


def compare(makers: dict[str, Maker], seeds: int, found: Iterable[sequences.Sequence]) -> Iterator[Row]:
    """Every tracker over every sequence; those that draw random numbers once per seed, the others once."""
    for sequence in found:
        for name, make in makers.items():
            for seed in range(seeds if name in (*OURS, "script-pf") else 1):
                yield measure(name, make, seed, sequence)


def table(rows: Sequence[Row]) -> str:
    """Markdown, a line per tracker: ``AUC/precision frames/s`` a sequence, over seeds, and the means."""
    names = list(dict.fromkeys(row.sequence for row in rows))
    lines = [["tracker", *names, "mean AUC", "mean P20"], ["---"] * (len(names) + 3)]
    for tracker in dict.fromkeys(row.tracker for row in rows):
        cells = [
            _mean([row for row in rows if (row.tracker, row.sequence) == (tracker, name)]) for name in names
        ]
        text = [f"{auc:.2f}/{precision:.2f} {fps:.0f}" for auc, precision, fps in cells]
        lines.append([tracker, *text, *(f"{value:.2f}" for value in np.mean(cells, axis=0)[:2])])
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def write_csv(path: Path, rows: Iterable[Row]) -> None:
    """A line per row, the names of Row's fields on top."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Row)])
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)


def ours() -> dict[str, Maker]:
    """Tricue's trackers with their default parameters."""

    def maker(name: str) -> Maker:
        return lambda seed: tricue.create(name, seed=seed)

    return {name: maker(name) for name in OURS}


def _mean(rows: Sequence[Row]) -> tuple[float, float, float]:
    auc, precision, fps = np.mean([(row.auc, row.precision, row.fps) for row in rows], axis=0)
    return float(auc), float(precision), float(fps)


def _speed(result: Run) -> dict[str, float]:
    p50, p99 = np.percentile(result.seconds * 1e3, [50, 99])
    return {"fps": result.frames_per_second, "p50_ms": float(p50), "p99_ms": float(p99)}


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, tell each run on stderr, print the table; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tricue.evaluation.compare", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=sequences.data_folder() / "color")
    parser.add_argument("--seeds", type=int, default=5, help="runs of the trackers that draw random numbers")
    parser.add_argument("--trackers", help="names, separated by commas; all when left out")
    parser.add_argument("--csv", type=Path, help="also write every run to this file")
    options = parser.parse_args(arguments)
    makers = ours() | peers.available()
    if options.trackers:
        makers = {name: makers[name] for name in options.trackers.split(",")}
    folders = sequences.find(options.folder)
    if not folders:
        parser.error(f"folder: expected sequences with true boxes under {options.folder}")
    rows = []
    for row in compare(makers, options.seeds, map(sequences.load, folders)):
        print(f"{row.sequence} {row.tracker} seed {row.seed}: {row.auc:.3f}", file=sys.stderr)
        rows.append(row)
    if options.csv:
        write_csv(options.csv, rows)
    print(table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
