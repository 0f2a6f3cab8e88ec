# SPDX-License-Identifier: MIT
"""What the commands of this package share: options, processes, tables."""

import argparse
import csv
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike
from tricue.cli.arguments import count
from tricue.evaluation import baselines
from tricue.evaluation.schedule import NEEDED
from tricue.track.base.registry import names

Job = TypeVar("Job")
Result = TypeVar("Result")
Cell = str | float


def parser(name: str, about: str | None, trackers: Sequence[str]) -> argparse.ArgumentParser:
    """The options that all have; trackers: who is compared without --trackers, as far as the installed cv2
    has them.
    """
    known = (*names(), *baselines.available())
    made = argparse.ArgumentParser(prog=f"python -m benchmarks.quality.fused.{name}", description=about)
    made.add_argument(
        "--trackers",
        nargs="+",
        default=[each for each in trackers if each.partition(":")[0] in known],
        metavar="NAME",
        help="ours and cv2's; fused:color and fused:color+depth see these channels alone",
    )
    made.add_argument("--set", action="append", default=[], metavar="TRACKER.NAME=VALUE", help="a parameter")
    add_common(made)
    return made


def add_common(made: argparse.ArgumentParser) -> None:
    """Processes, and a file for the numbers."""
    made.add_argument("--jobs", type=count, default=1, metavar="N", help="processes, default %(default)s")
    made.add_argument("--csv", type=Path, metavar="FILE", help="write the numbers there, too")


def seeds(text: str) -> tuple[int, ...]:
    """Seeds from "0:20", the last left out, or "1,5,7"."""
    first, colon, last = text.partition(":")
    try:
        found = tuple(range(int(first), int(last))) if colon else tuple(map(int, text.split(",")))
    except ValueError:
        found = ()
    if not found or min(found) < 0:
        raise argparse.ArgumentTypeError(f"expected seeds such as 0:20 or 1,5,7, got {text!r}")
    return found


def performed(perform: Callable[[Job], Result], tasks: Iterable[Job], jobs: int) -> Iterator[Result]:
    """The results in the tasks' order; jobs: processes. ImportError names the extra that is missing."""
    if jobs == 1:
        yield from map(perform, tasks)
        return
    try:
        from joblib import Parallel, delayed
    except ImportError:
        raise ImportError(f"--jobs above 1 {NEEDED.format('evaluate')}") from None
    parallel = Parallel(n_jobs=jobs, return_as="generator", batch_size=1)
    yield from parallel(delayed(perform)(task) for task in tasks)


def markdown(head: Sequence[str], rows: Iterable[Sequence[Cell]], digits: int = 3) -> str:
    """A table; numbers with so many digits after the point, what isn't known as "-"."""
    lines = [list(head), ["---"] * len(head), *([_text(cell, digits) for cell in row] for row in rows)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def write_csv(path: Path | None, head: Sequence[str], rows: Iterable[Sequence[Cell]]) -> None:
    """The numbers in full; empty where not known."""
    if path is None:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows([["" if _unknown(cell) else cell for cell in row] for row in rows])


def mean(values: ArrayLike) -> float:
    """Over what is known; NaN where nothing is."""
    known = np.asarray(values, np.float64)
    known = known[~np.isnan(known)]
    return float(known.mean()) if known.size else float("nan")


def _text(cell: Cell, digits: int) -> str:
    if isinstance(cell, str):
        return cell
    return "-" if _unknown(cell) else str(cell) if isinstance(cell, int) else f"{cell:.{digits}f}"


def _unknown(cell: Cell) -> bool:
    return isinstance(cell, float) and bool(np.isnan(cell))
