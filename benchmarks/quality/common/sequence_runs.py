# SPDX-License-Identifier: MIT
"""Trackers on whole recorded sequences: each is decoded once, for all trackers and all protocols."""

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeVar

from tricue.evaluation.dataset import Entry, OpenedSequence, find_entries
from tricue.evaluation.protocols import Order

from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.protocols import TRUE_BOX, belongs, run_orders
from benchmarks.quality.common.recordings import Recording
from benchmarks.quality.common.tables import mean
from benchmarks.quality.common.variants import Variant

Result = TypeVar("Result")
MakeRecording = Callable[[OpenedSequence], Recording]


class SequenceTask(NamedTuple):
    """A sequence, and the trackers to run on it."""

    entry: Entry
    variants: Sequence[Variant]


class SequenceResult(NamedTuple):
    """The runs of one tracker on a sequence. unsupported: why there are none, or ""."""

    tracker: str
    sequence: str
    runs: Mapping[Order, FrameResults]
    unsupported: str = ""

    def runs_of(self, protocol: str) -> list[FrameResults]:
        """The runs of a protocol for which the sequence is long enough."""
        return [run for order, run in self.runs.items() if belongs(order, protocol)]

    def auc(self, protocol: str) -> float:
        """The mean AUC over the runs of a protocol; NaN without one."""
        return mean([run.auc for run in self.runs_of(protocol)])

    def overlap(self, protocol: str) -> float:
        """The mean of the mean overlaps of a protocol's runs; NaN without one."""
        return mean([run.mean_overlap for run in self.runs_of(protocol)])


def find_tasks(
    variants: Sequence[Variant],
    root: Path,
    only: Sequence[str] = (),
    find: Callable[[Path], Sequence[Entry]] = find_entries,
) -> list[SequenceTask]:
    """Tasks for sequences at or under a folder, all or by name. ValueError for an unknown name."""
    entries = find(root)
    names = [each.name for each in entries]
    if unknown := [name for name in only if name not in names]:
        raise ValueError(f"--only: expected some of {', '.join(names)}, got {unknown[0]!r}")
    return [SequenceTask(entry, variants) for entry in entries if not only or entry.name in only]


def run_longest_first(
    run: Callable[[SequenceTask], Result], tasks: Sequence[SequenceTask], jobs: int
) -> list[Result]:
    """The results in the order of the tasks.

    The longest sequences run first, so that all processes end at about the same time.
    """
    lengths = [len(task.entry.open().boxes) for task in tasks]
    longest_first = sorted(range(len(tasks)), key=lambda index: -lengths[index])
    found = run_parallel(run, [tasks[index] for index in longest_first], jobs)
    by_index = dict(zip(longest_first, found, strict=True))
    return [by_index[index] for index in range(len(tasks))]


def run_sequences(
    tasks: Sequence[SequenceTask],
    jobs: int,
    recording: MakeRecording = Recording,
    draws: Sequence[int] = TRUE_BOX,
) -> list[SequenceResult]:
    """The results in the order of the tasks. Trackers that can't run are named on stderr."""
    run = partial(run_sequence, recording=recording, draws=draws)
    results = [each for several in run_longest_first(run, tasks, jobs) for each in several]
    for each in results:
        if each.unsupported:
            print(f"left out {each.tracker} on {each.sequence}: {each.unsupported}", file=sys.stderr)
    return results


def run_sequence(
    task: SequenceTask, recording: MakeRecording = Recording, draws: Sequence[int] = TRUE_BOX
) -> list[SequenceResult]:
    """Decode a sequence, unless no tracker supports it, and run all trackers with all protocols."""
    found = recording(task.entry.open())
    results = []
    for variant in task.variants:
        if reason := variant.unsupported(found.inputs):
            results.append(SequenceResult(variant.label, task.entry.name, {}, reason))
        else:
            frames = list(map(variant.view(found.inputs), found.frames))
            runs = run_orders(variant, found, frames, draws)
            results.append(SequenceResult(variant.label, task.entry.name, runs))
    return results


def by_tracker(results: Iterable[SequenceResult]) -> dict[str, list[SequenceResult]]:
    """The results with runs, by tracker, in their order."""
    found: dict[str, list[SequenceResult]] = {}
    for each in results:
        if each.runs:
            found.setdefault(each.tracker, []).append(each)
    return found


def mean_auc(results: Iterable[SequenceResult], protocol: str) -> float:
    """The mean AUC of a protocol over sequences; NaN if none has a run of it."""
    return mean([each.auc(protocol) for each in results])


def pool(results: Iterable[SequenceResult], protocol: str | None = None) -> FrameResults:
    """All frames of a protocol's runs, or of all runs, each once."""
    runs = [each.runs.values() if protocol is None else each.runs_of(protocol) for each in results]
    return FrameResults.pooled([run for several in runs for run in several])
