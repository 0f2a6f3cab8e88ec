# SPDX-License-Identifier: MIT
"""``tricue compare OLD NEW``: two folders of tricue evaluate, and what got worse."""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from tricue.cli.arguments import number, output_file
from tricue.evaluation.compare import Comparison, compare_folders
from tricue.evaluation.differences import BETTER, signed
from tricue.evaluation.report.compare_page import write_compare_page

EXAMPLES = """\
examples:
  tricue compare before/ after/                         differences with intervals, sequences that lost most
  tricue compare before/ after/ --report compare.html   the same as a page
  tricue compare before/ after/ --fail-if-worse         exit code 1 if a tracker is shown to be worse
  tricue compare before/ after/ --fail-under -0.01      or if the mean of one fell by more than 0.01
"""
WORSE = 1
MOST = 5
"""Number of sequences printed per tracker."""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument("old", type=Path, metavar="OLD", help="a folder that tricue evaluate wrote")
    command.add_argument("new", type=Path, metavar="NEW", help="another one, with the same sequences")
    command.add_argument(
        "--number",
        choices=tuple(BETTER),
        default="auc",
        help="the column of rows.csv that is compared, default %(default)s",
    )
    command.add_argument("--report", type=output_file, metavar="FILE", help="also write an HTML page")
    command.add_argument(
        "--fail-if-worse", action="store_true", help="exit code 1 if a tracker is shown to be worse"
    )
    command.add_argument(
        "--fail-under",
        type=number,
        metavar="GAIN",
        help="exit code 1 if a tracker's mean gain is below this, such as -0.01",
    )


def run(options: argparse.Namespace) -> int:
    """Run the command: tables on stdout. The exit code is 1 if something got worse and that was asked for."""
    found = compare_folders(options.old, options.new, options.number)
    print(table(found))
    for note in found.notes:
        print(note)
    for change in found.changes:
        worst = [line for line in change.worst_first() if change.better * (line[2] - line[1]) < 0][:MOST]
        if worst:
            listed = ", ".join(f"{name} {old:.3f} to {new:.3f}" for name, old, new in worst)
            print(f"{change.tracker}, {change.protocol}, lost most: {listed}")
    if options.report:
        print(f"wrote {write_compare_page(found, options.old, options.new, options.report)}")
    failures = [*_failures(found, options)]
    for failure in failures:
        print(f"failed: {failure}", file=sys.stderr)
    return WORSE if failures else 0


def _failures(found: Comparison, options: argparse.Namespace) -> Iterator[str]:
    """Why the exit code is 1."""
    for each in found.changes:
        if options.fail_if_worse and each.verdict == "worse":
            yield f"{each.tracker}, {each.protocol}: worse"
        elif options.fail_under is not None and each.gain < options.fail_under:
            gain = signed(each.gain, 3)
            yield f"{each.tracker}, {each.protocol}: a mean gain of {gain}, under {options.fail_under:g}"


def table(found: Comparison) -> str:
    """A line per tracker, group and protocol, as Markdown."""
    rows = [["tracker", "group", "protocol", "sequences", "old", "new", "difference", "95 %", ""]]
    rows.append(["---"] * len(rows[0]))
    for each in found.changes:
        mean, low, high = each.difference
        rows.append(
            [
                each.tracker,
                each.group,
                each.protocol,
                str(len(each.by_sequence)),
                f"{each.old:.3f}",
                f"{each.new:.3f}",
                signed(mean, 3),
                f"[{signed(low, 3)}, {signed(high, 3)}]" if each.difference.known else "-",
                each.verdict,
            ]
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        f"| {' | '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))} |"
        for row in rows
    )
