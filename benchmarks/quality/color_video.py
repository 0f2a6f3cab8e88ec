# SPDX-License-Identifier: MIT
"""Trackers from many starts, backward, and at a third of the frame rate.

    python -m benchmarks.quality.robustness [DATASET] --trackers fused CSRT

There are three protocols, each with the mean success AUC over its runs on a sequence: "plain", one pass;
"starts", from the frames at 0, 1/4, 1/2 and 3/4 of the sequence to its end, and the same on the reversed
sequence; "third", one pass over every third frame. A run starts on the first of its frames with a true box.
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
from tricue.evaluation.dataset import Entry, OpenedSequence, find_entries
from tricue.evaluation.rows import clip_to_image

from benchmarks.quality.common import sequences
from benchmarks.quality.common.arguments import parser
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Variant, parse_variants

PROTOCOLS = ("plain", "starts", "third")
STARTS = (0.0, 0.25, 0.5, 0.75)
TRACKERS = ("fused", "CSRT")
POOLED = ("AUROC", "lost", "TRACKED of lost", "not TRACKED of good", "ms/frame")
Numbers = NDArray[np.intp]


class RobustnessTask(NamedTuple):
    """One tracker on one sequence, by all protocols."""

    variant: Variant
    entry: Entry


class RobustnessResult(NamedTuple):
    """One tracker on one sequence: the runs of each protocol. unsupported: why there are none, or ""."""

    tracker: str
    sequence: str
    runs: Mapping[str, Sequence[FrameResults]]
    unsupported: str = ""


def orders(protocol: str, frames: int) -> list[Numbers]:
    """The frames' numbers in the order in which each run of a protocol sees them."""
    numbers = np.arange(frames)
    if protocol == "plain":
        return [numbers]
    if protocol == "third":
        return [numbers[::3]]
    firsts = [int(share * frames) for share in STARTS]
    return [way[first:] for first in firsts for way in (numbers, numbers[::-1])]


def run_protocols(task: RobustnessTask) -> RobustnessResult:
    """Decode the sequence and run the tracker by all protocols."""
    variant, opened = task.variant, task.entry.open()
    names = variant.label, task.entry.name
    if reason := variant.unsupported(opened):
        return RobustnessResult(*names, {}, reason)
    frames = list(map(variant.view(opened), opened.source))
    runs = {
        protocol: [
            results
            for order in orders(protocol, len(frames))
            if (results := run_order(variant, opened, frames, order)) is not None
        ]
        for protocol in PROTOCOLS
    }
    return RobustnessResult(*names, runs)


def run_order(
    variant: Variant, opened: OpenedSequence, frames: Sequence[Frame], order: Numbers
) -> FrameResults | None:
    """Track through the frames in an order, from the first with a true box; None where fewer than two are
    left.
    """
    truth, absent = opened.truth(len(frames)), opened.absent(len(frames))
    known = ~np.isnan(truth[order]).any(axis=1)
    order = order[int(np.argmax(known)) :] if known.any() else order[:0]
    if len(order) < 2:
        return None
    tracker = variant.make(opened)
    run = one_pass.run(tracker, (frames[number] for number in order), Box(*truth[order[0]].tolist()))
    return FrameResults.of(run, clip_to_image(run.boxes, opened), truth[order], absent[order])


def by_tracker(results: Iterable[RobustnessResult]) -> dict[str, list[RobustnessResult]]:
    """The results with runs, by tracker, in their order."""
    found: dict[str, list[RobustnessResult]] = {}
    for each in results:
        if not each.unsupported:
            found.setdefault(each.tracker, []).append(each)
    return found


def auc(result: RobustnessResult, protocol: str) -> float:
    """The mean over the runs of a protocol."""
    return mean([run.auc for run in result.runs[protocol]])


def pooled(results: Iterable[RobustnessResult]) -> FrameResults:
    """All frames of all runs."""
    return FrameResults.pooled([run for each in results for runs in each.runs.values() for run in runs])


def means(results: Sequence[RobustnessResult]) -> list[float]:
    """The AUC of each protocol, over the sequences."""
    return [mean([auc(each, protocol) for each in results]) for protocol in PROTOCOLS]


def numbers_of(frames: FrameResults) -> list[float]:
    """POOLED, in that order."""
    return [frames.auroc, frames.lost, frames.tracked_of_lost, frames.untracked_of_good, frames.milliseconds]


def tables(results: Sequence[RobustnessResult]) -> str:
    """Markdown: the AUC by tracker, protocol and sequence; POOLED numbers of each tracker's frames."""
    found = by_tracker(results)
    sequences = list(dict.fromkeys(each.sequence for each in results))
    lines: list[list[Cell]] = []
    for tracker, each in found.items():
        for protocol, average in zip(PROTOCOLS, means(each), strict=True):
            by_name = {result.sequence: auc(result, protocol) for result in each}
            lines.append([tracker, protocol, *(by_name.get(name, np.nan) for name in sequences), average])
    pooled_lines: list[list[Cell]] = [[tracker, *numbers_of(pooled(each))] for tracker, each in found.items()]
    first = markdown(["tracker", "protocol", *sequences, "mean"], lines)
    return f"{first}\n\n{markdown(['tracker', *POOLED], pooled_lines)}"


def rows(results: Iterable[RobustnessResult]) -> list[list[Cell]]:
    """For CSV: a line a tracker, sequence and protocol."""
    return [
        [
            each.tracker,
            each.sequence,
            protocol,
            len(runs),
            auc(each, protocol),
            *numbers_of(FrameResults.pooled(runs)),
        ]
        for each in results
        for protocol, runs in each.runs.items()
        if runs
    ]


def tasks(variants: Sequence[Variant], root: Path) -> list[RobustnessTask]:
    """Every tracker on every sequence at or under a folder."""
    entries = find_entries(root)
    return [RobustnessTask(variant, entry) for variant in variants for entry in entries]


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
    made = parser("robustness", __doc__, TRACKERS)
    add_dataset(made)
    options = made.parse_args(arguments)
    try:
        todo = tasks(parse_variants(options.trackers, options.set), options.dataset)
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    results = list(run_parallel(run_protocols, todo, options.jobs))
    for each in results:
        if each.unsupported:
            print(f"left out {each.tracker} on {each.sequence}: {each.unsupported}", file=sys.stderr)
    print(tables(results))
    head = ("tracker", "sequence", "protocol", "runs", "AUC", *POOLED)
    write_csv(options.csv, head, rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
