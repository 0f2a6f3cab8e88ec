# SPDX-License-Identifier: MIT
"""Trackers beside their peers over recorded sequences: ``python -m tricue.evaluation.compare [FOLDER]``.

With ``--depth`` the sequences are those with depth, see tricue.evaluation.compare_depth.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

import tricue
from tricue.camera.box import Box
from tricue.evaluation import compare_depth, peers, sequences
from tricue.evaluation.comparison import Maker, Row, row_of, write_csv
from tricue.evaluation.one_pass import run

OURS = ("color-particle",)
RANDOM = (*OURS, *compare_depth.OURS, "script-pf")  # trackers that draw random numbers


class Kind(NamedTuple):
    """A comparison: its folder under TRICUE_DATA, who takes part, how each is measured, the table."""

    folder: str
    makers: Callable[[], dict[str, Maker]]
    measure: Callable[[str, Maker, int, sequences.Sequence], Row]
    table: Callable[[Sequence[Row]], str]


def measure(name: str, make: Maker, seed: int, sequence: sequences.Sequence) -> Row:
    """Run one tracker over the color of one sequence."""
    result = run(make(seed), sequence.frames, Box(*sequence.truth[0].tolist()))
    return row_of(name, seed, sequence, result, result.boxes)


def compare(
    kind: Kind, makers: dict[str, Maker], seeds: int, found: Iterable[sequences.Sequence]
) -> Iterator[Row]:
    """Every tracker over every sequence; those that draw random numbers once per seed, the others once."""
    for sequence in found:
        for name, make in makers.items():
            for seed in range(seeds if name in RANDOM else 1):
                yield kind.measure(name, make, seed, sequence)


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


def makers() -> dict[str, Maker]:
    """Tricue's trackers with their default parameters, and the peers."""

    def maker(name: str) -> Maker:
        return lambda seed: tricue.create(name, seed=seed)

    return {name: maker(name) for name in OURS} | peers.available()


def _mean(rows: Sequence[Row]) -> tuple[float, float, float]:
    auc, precision, fps = np.mean([(row.auc, row.precision, row.fps) for row in rows], axis=0)
    return float(auc), float(precision), float(fps)


COLOR = Kind("color", makers, measure, table)
DEPTH = Kind("rgbd", compare_depth.makers, compare_depth.measure, compare_depth.table)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, tell each run on stderr, print the table; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tricue.evaluation.compare", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", help="of sequences; found through TRICUE_DATA")
    parser.add_argument("--depth", action="store_true", help="trackers in depth, on sequences with depth")
    parser.add_argument("--seeds", type=int, default=5, help="runs of the trackers that draw random numbers")
    parser.add_argument("--trackers", help="names, separated by commas; all when left out")
    parser.add_argument("--csv", type=Path, help="also write every run to this file")
    options = parser.parse_args(arguments)
    kind = DEPTH if options.depth else COLOR
    folder = options.folder or sequences.data_folder() / kind.folder
    chosen = kind.makers()
    names = options.trackers.split(",") if options.trackers else list(chosen)
    if unknown := [name for name in names if name not in chosen]:
        parser.error(f"--trackers: expected some of {', '.join(chosen)}, got {unknown[0]!r}")
    folders = sequences.find(folder)
    if not folders:
        parser.error(f"folder: expected sequences with true boxes under {folder}")
    rows = []
    runs = compare(kind, {name: chosen[name] for name in names}, options.seeds, map(sequences.load, folders))
    for each in runs:
        print(f"{each.sequence} {each.tracker} seed {each.seed}: {each.auc:.3f}", file=sys.stderr)
        rows.append(each)
    if options.csv:
        write_csv(options.csv, rows)
    print(kind.table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
