# SPDX-License-Identifier: MIT
"""Command-line arguments that several scripts share."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from tricue.cli.arguments import count

from benchmarks.quality.common import sequences
from benchmarks.quality.common.protocols import TRUE_BOX

PACKAGE = "benchmarks.quality"


def parser(script: str, about: str | None, trackers: Sequence[str]) -> argparse.ArgumentParser:
    """A parser for trackers, their parameters, processes and a CSV. trackers: the default of --trackers."""
    made = bare_parser(script, about)
    made.add_argument(
        "--trackers",
        nargs="+",
        default=list(trackers),
        metavar="NAME",
        help="tricue's and baselines; fused:color and fused:color+depth get these channels only",
    )
    made.add_argument("--set", action="append", default=[], metavar="TRACKER.NAME=VALUE", help="a parameter")
    add_output(made)
    return made


def bare_parser(script: str, about: str | None) -> argparse.ArgumentParser:
    """A parser without arguments; a script's help starts with its docstring."""
    return argparse.ArgumentParser(
        prog=f"python -m {PACKAGE}.{script}",
        description=about,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def add_output(made: argparse.ArgumentParser) -> None:
    """Add the number of processes, and a file for the numbers."""
    made.add_argument("--jobs", type=count, default=1, metavar="N", help="processes, default %(default)s")
    made.add_argument("--csv", type=Path, metavar="FILE", help="also write the numbers to this file")


def add_dataset(made: argparse.ArgumentParser, folder: str = "color") -> None:
    """Add the folder of sequences; the default is in the recorded data."""
    made.add_argument(
        "dataset",
        type=Path,
        nargs="?",
        default=sequences.data_folder() / folder,
        metavar="DATASET",
        help="sequences with true boxes, default %(default)s",
    )


def add_runs(made: argparse.ArgumentParser) -> None:
    """Add the choice of sequences and first boxes, and files to store the numbers in and to compare with."""
    made.add_argument(
        "--draws", type=draws, default=TRUE_BOX, metavar="N", help="first boxes a run, beside the true one"
    )
    made.add_argument("--only", nargs="+", default=[], metavar="NAME", help="of these sequences")
    made.add_argument("--save", type=Path, metavar="FILE", help="store the numbers of all runs, JSON")
    made.add_argument("--against", type=Path, metavar="FILE", help="compare with stored runs")


def draws(text: str) -> Sequence[int]:
    """The draws of first boxes, given their number."""
    return range(1, count(text) + 1)


def seeds(text: str) -> tuple[int, ...]:
    """Seeds from "0:20", which excludes 20, or from "1,5,7"."""
    first, colon, last = text.partition(":")
    try:
        found = tuple(range(int(first), int(last))) if colon else tuple(map(int, text.split(",")))
    except ValueError:
        found = ()
    if not found or min(found) < 0:
        raise argparse.ArgumentTypeError(f"expected seeds such as 0:20 or 1,5,7, got {text!r}")
    return found
