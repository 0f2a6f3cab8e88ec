# SPDX-License-Identifier: MIT
"""Trackers from many starts: ``python -m benchmarks.quality.fused.robust [DATASET] --trackers fused CSRT``.

Three protocols on each sequence, each a mean of the success AUC over its runs: "plain", one pass; "starts",
from the frames at 0, 1/4, 1/2 and 3/4 of the sequence to its end, and the same on the reversed sequence;
"third", one pass over every third frame. A start without a true box is put off to the next frame with one.
"""

import argparse
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import one_pass
from tricue.evaluation.dataset import Entry, Opened, find_entries
from tricue.evaluation.rows import bounded

from benchmarks.quality import sequences
from benchmarks.quality.fused.options import Cell, markdown, mean, parser, performed, write_csv
from benchmarks.quality.fused.status_metrics import Said
from benchmarks.quality.fused.variants import Participant, participants

PROTOCOLS = ("plain", "starts", "third")
STARTS = (0.0, 0.25, 0.5, 0.75)
TRACKERS = ("fused", "CSRT")
POOLED = ("AUROC", "lost", "TRACKED of lost", "not TRACKED of good", "ms/frame")
Numbers = NDArray[np.intp]


class Task(NamedTuple):
    """One tracker on one sequence, by all protocols."""

    participant: Participant
    entry: Entry


class Result(NamedTuple):
    """What came of it: the runs of each protocol. refused: why there are none, or ""."""

    tracker: str
    sequence: str
    runs: Mapping[str, Sequence[Said]]
    refused: str = ""


def orders(protocol: str, frames: int) -> list[Numbers]:
    """The frames' numbers in the order in which each run of a protocol sees them."""
    numbers = np.arange(frames)
    if protocol == "plain":
        return [numbers]
    if protocol == "third":
        return [numbers[::3]]
    firsts = [int(share * frames) for share in STARTS]
    return [way[first:] for first in firsts for way in (numbers, numbers[::-1])]


def perform(task: Task) -> Result:
    """Decode the sequence and run the tracker by all protocols."""
    participant, opened = task.participant, task.entry.open()
    names = participant.label, task.entry.name
    if reason := participant.refuses(opened):
        return Result(*names, {}, reason)
    frames = list(map(participant.view(opened), opened.source))
    runs = {
        protocol: [
            said
            for order in orders(protocol, len(frames))
            if (said := follow(participant, opened, frames, order)) is not None
        ]
        for protocol in PROTOCOLS
    }
    return Result(*names, runs)


def follow(participant: Participant, opened: Opened, frames: Sequence[Frame], order: Numbers) -> Said | None:
    """Track through the frames in an order, from the first with a true box; None where fewer than two are
    left.
    """
    truth, absent = opened.truth(len(frames)), opened.absent(len(frames))
    known = ~np.isnan(truth[order]).any(axis=1)
    order = order[int(np.argmax(known)) :] if known.any() else order[:0]
    if len(order) < 2:
        return None
    tracker = participant.contender(opened)
    run = one_pass.run(tracker, (frames[number] for number in order), Box(*truth[order[0]].tolist()))
    return Said.of(run, bounded(run.boxes, opened), truth[order], absent[order])


def by_tracker(results: Iterable[Result]) -> dict[str, list[Result]]:
    """The results that there are, by tracker, in their order."""
    found: dict[str, list[Result]] = {}
    for each in results:
        if not each.refused:
            found.setdefault(each.tracker, []).append(each)
    return found


def auc(result: Result, protocol: str) -> float:
    """The mean over the runs of a protocol."""
    return mean([said.auc for said in result.runs[protocol]])


def pooled(results: Iterable[Result]) -> Said:
    """All frames of all runs."""
    return Said.pooled([said for each in results for runs in each.runs.values() for said in runs])


def means(results: Sequence[Result]) -> list[float]:
    """Of each protocol, over the sequences."""
    return [mean([auc(each, protocol) for each in results]) for protocol in PROTOCOLS]


def numbers_of(said: Said) -> list[float]:
    """POOLED, in that order."""
    return [said.auroc, said.lost, said.tracked_of_lost, said.doubted_of_good, said.milliseconds]


def tables(results: Sequence[Result]) -> str:
    """Markdown: the AUC by tracker, protocol and sequence, and what the pooled frames say of each tracker."""
    found = by_tracker(results)
    sequences = list(dict.fromkeys(each.sequence for each in results))
    lines: list[list[Cell]] = []
    for tracker, each in found.items():
        for protocol, average in zip(PROTOCOLS, means(each), strict=True):
            by_name = {result.sequence: auc(result, protocol) for result in each}
            lines.append([tracker, protocol, *(by_name.get(name, np.nan) for name in sequences), average])
    said: list[list[Cell]] = [[tracker, *numbers_of(pooled(each))] for tracker, each in found.items()]
    first = markdown(["tracker", "protocol", *sequences, "mean"], lines)
    return f"{first}\n\n{markdown(['tracker', *POOLED], said)}"


def rows(results: Iterable[Result]) -> list[list[Cell]]:
    """For CSV: a line a tracker, sequence and protocol."""
    return [
        [
            each.tracker,
            each.sequence,
            protocol,
            len(runs),
            auc(each, protocol),
            *numbers_of(Said.pooled(runs)),
        ]
        for each in results
        for protocol, runs in each.runs.items()
        if runs
    ]


def tasks(found: Sequence[Participant], root: Path) -> list[Task]:
    """Every tracker on every sequence at or under a folder."""
    entries = find_entries(root)
    return [Task(participant, entry) for participant in found for entry in entries]


def add_dataset(made: argparse.ArgumentParser) -> None:
    """The folder of sequences, by default the recorded color sequences."""
    made.add_argument(
        "dataset",
        type=Path,
        nargs="?",
        default=sequences.data_folder() / "color",
        metavar="DATASET",
        help="sequences with true boxes, default %(default)s",
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    made = parser("robust", __doc__, TRACKERS)
    add_dataset(made)
    options = made.parse_args(arguments)
    try:
        todo = tasks(participants(options.trackers, options.set), options.dataset)
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    results = list(performed(perform, todo, options.jobs))
    for each in results:
        if each.refused:
            print(f"left out {each.tracker} on {each.sequence}: {each.refused}", file=sys.stderr)
    print(tables(results))
    head = ("tracker", "sequence", "protocol", "runs", "AUC", *POOLED)
    write_csv(options.csv, head, rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
