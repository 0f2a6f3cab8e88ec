# SPDX-License-Identifier: MIT
"""Trackers on recorded color video in which the target is covered by a copy of what is beside it.

    python -m benchmarks.quality.hidden_targets --jobs 2
    python -m benchmarks.quality.hidden_targets --set fused.min_score=0.3 --only David Girl

The target is visible for 60 frames, or half of a shorter sequence, then hidden for 30, 100 or 300, forward
and backward; sequences that are too short are repeated in alternating directions. "covered": the video
continues while the moving target is covered; "empty": one frame with the target covered is repeated.

"runs": the number of runs in which the overlap was 0.5 or more when the target was hidden; others don't
count. "taken up": the share of runs in which the target was TRACKED with an overlap above 0.3 within 30
frames after it became visible again. "wrong": the share of runs in which something else was TRACKED for more
than 5 frames in a row while it was hidden.
"""

import sys
from collections.abc import Iterable, Sequence
from itertools import product

from benchmarks.quality.common.arguments import add_dataset, parser
from benchmarks.quality.common.hidden_runs import COVERED, EMPTY, LENGTHS, HiddenResult, run_sequence
from benchmarks.quality.common.scene_runs import MAX_WRONG_FRAMES
from benchmarks.quality.common.sequence_runs import find_tasks, run_longest_first
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import parse_variants

TRACKERS = ("fused", "CSRT")
HEAD = ("hidden", "frames", "tracker", "runs", "taken up", "wrong")
CSV_COLUMNS = ("hidden", "frames", "backward", "tracker", "sequence", "taken up", "frames wrong")


def rows(results: Sequence[HiddenResult], trackers: Iterable[str]) -> list[list[Cell]]:
    """HEAD for each way of hiding and tracker."""
    made: list[list[Cell]] = []
    for kind, frames, tracker in product((COVERED, EMPTY), LENGTHS, trackers):
        runs = [each for each in results if (each.tracker, *each.hiding[:2]) == (tracker, kind, frames)]
        taken_up = mean([each.taken_up for each in runs])
        wrong = mean([each.wrong_frames > MAX_WRONG_FRAMES for each in runs])
        made.append([kind, frames, tracker, len(runs), taken_up, wrong])
    return made


def csv_rows(results: Iterable[HiddenResult]) -> list[list[Cell]]:
    """CSV_COLUMNS for each run."""
    return [
        [
            *(each.hiding.kind, each.hiding.frames, int(each.hiding.backward)),
            *(each.tracker, each.sequence, int(each.taken_up), each.wrong_frames),
        ]
        for each in results
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = parser("hidden_targets", __doc__, TRACKERS)
    add_dataset(made)
    made.add_argument("--only", nargs="+", default=[], metavar="NAME", help="of these sequences")
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
        todo = find_tasks(variants, options.dataset, options.only)
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    results = [each for several in run_longest_first(run_sequence, todo, options.jobs) for each in several]
    print(markdown(HEAD, rows(results, [each.label for each in variants])))
    write_csv(options.csv, CSV_COLUMNS, csv_rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
