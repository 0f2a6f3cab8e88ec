# SPDX-License-Identifier: MIT
"""Trackers on recorded color video as from a worse camera: darker, blurred, smaller, slower, and more.

    python -m benchmarks.quality.degraded_video --jobs 2
    python -m benchmarks.quality.degraded_video --trackers fused CSRT --changes gray blur

One forward pass over each sequence, degraded in one way at a time (``common/degradations.py``); no parameters
were chosen on these. AUC is the mean over the sequences. "TRACKED of lost" and "not TRACKED of on target" are
shares of all sequences' frames with an overlap under 0.1 and above 0.3, respectively. If the first box is too
large or too small, the boxes are rescaled by the inverse factor before they are compared with the truth.
"""

import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import one_pass

from benchmarks.quality.common.arguments import add_dataset, parser
from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.degradations import DEGRADATIONS, Degradation, scale_box
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.recordings import Recording
from benchmarks.quality.common.sequence_runs import SequenceTask, find_tasks, run_longest_first
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Variant, parse_variants

TRACKERS = ("fused", "CSRT")
HEAD = ("change", "tracker", "sequences", "AUC", "TRACKED of lost", "not TRACKED of on target")
CSV_COLUMNS = ("change", "tracker", "sequence", "AUC")


class DegradedResult(NamedTuple):
    """One tracker on one changed sequence. change: its name in DEGRADATIONS."""

    change: str
    tracker: str
    sequence: str
    frames: FrameResults


def run_sequence(task: SequenceTask, changes: Sequence[str]) -> list[DegradedResult]:
    """All trackers that can use a color sequence, after each change."""
    recording = Recording(task.entry.open())
    able = [each for each in task.variants if not each.unsupported(recording.inputs)]
    if recording.opened.channel != "color":
        return []
    return [
        DegradedResult(change, variant.label, task.entry.name, run)
        for change in changes
        for variant in able
        if (run := run_degraded(variant, recording, DEGRADATIONS[change])) is not None
    ]


def run_degraded(variant: Variant, recording: Recording, change: Degradation) -> FrameResults | None:
    """The tracker on the changed recording, from the first seen frame with a true box on.

    None if fewer than two frames are left.
    """
    opened, frames = recording.opened, recording.frames
    truth, absent = opened.truth(len(frames)), opened.absent(len(frames))
    numbers = np.arange(0, len(frames), change.step)
    known = ~np.isnan(truth[numbers]).any(axis=1)
    numbers = numbers[int(np.argmax(known)) :] if known.any() else numbers[:0]
    if len(numbers) < 2:
        return None
    first = scale_box(Box(*truth[numbers[0]].tolist()), change.box)
    start = Box(*(np.array(first) * change.scale).tolist())
    run = one_pass.run(variant.make(recording.inputs), _shown(frames, numbers, change), start)
    boxes = [scale_box(Box(*box), 1 / change.box) for box in (run.boxes / change.scale).tolist()]
    return FrameResults.of(run, opened.clip(np.array(boxes)), truth[numbers], absent[numbers])


def _shown(frames: Sequence[Frame], numbers: Iterable[int], change: Degradation) -> Iterator[Frame]:
    """The changed frames with these numbers, color alone."""
    for number in numbers:
        frame = frames[number]
        assert frame.color is not None, "a color sequence"
        yield replace(frame, color=change.apply(frame.color, int(number)), depth=None, right=None)


def rows(results: Sequence[DegradedResult]) -> list[list[Cell]]:
    """HEAD for each change and tracker, in their order."""
    made: list[list[Cell]] = []
    for change, tracker in dict.fromkeys((each.change, each.tracker) for each in results):
        runs = [each.frames for each in results if (each.change, each.tracker) == (change, tracker)]
        found = summarize(FrameResults.pooled(runs))
        auc = mean([each.auc for each in runs])
        made.append([change, tracker, len(runs), auc, found.tracked_of_lost, found.untracked_of_on_target])
    return made


def csv_rows(results: Iterable[DegradedResult]) -> list[list[Cell]]:
    """CSV_COLUMNS for each run."""
    return [[each.change, each.tracker, each.sequence, each.frames.auc] for each in results]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = parser("degraded_video", __doc__, TRACKERS)
    add_dataset(made)
    made.add_argument("--only", nargs="+", default=[], metavar="NAME", help="of these sequences")
    made.add_argument("--changes", nargs="+", choices=DEGRADATIONS, default=list(DEGRADATIONS))
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
        todo = find_tasks(variants, options.dataset, options.only)
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    run = partial(run_sequence, changes=options.changes)
    results = [each for several in run_longest_first(run, todo, options.jobs) for each in several]
    results.sort(key=lambda each: options.changes.index(each.change))
    print(markdown(HEAD, rows(results)))
    write_csv(options.csv, CSV_COLUMNS, csv_rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
