# SPDX-License-Identifier: MIT
"""Trackers on recorded color video: forward, backward, from many starts, at a third of the frame rate.

    python -m benchmarks.quality.color_video [DATASET] --trackers fused CSRT
    python -m benchmarks.quality.color_video --save before.json --jobs 2
    python -m benchmarks.quality.color_video --set fused.ridge=0.02 --against before.json --jobs 2
    python -m benchmarks.quality.color_video --draws 3 --mirrored --jobs 2

There are four protocols, each with the mean success AUC over its runs on a sequence: "forward" and
"backward", one pass each; "starts", from the frames at 0, 1/4, 1/2 and 3/4 of the sequence to its end, and
the same on the reversed sequence; "third", one pass over every third frame. A run starts on the first of its
frames with a true box. A group's number is the mean over its sequences; a sequence may be in several groups.

A single run depends on a few pixels. With --draws, each run is repeated from first boxes that are shifted by
a tenth of the true box's size and differ from it by up to a tenth in their sides; with --mirrored, left and
right are exchanged. Both show how much of a difference is chance.

The last three tables pool the frames of all runs, each run once. "Lost": the overlap is under 0.1, or there
is no target; "on target": above 0.3. AUROC is the chance that a frame on the target scores above a lost one.
Scores are sorted into ten bins: "deviation" is the largest difference between the mean score and the share of
frames on the target, over bins with at least 1 % of the frames; "calibration error" is the mean difference.
The 95 % bootstrap intervals of these numbers are over recordings, and wide: a few recordings have most of the
lost frames.

With --against, more tables follow, with the paired differences from a stored run and their 95 % bootstrap
intervals over sequences. Version 0.1.0's parameters were chosen on the group "tuned"; StreetWalker, in
"others", is from the same recording as one of these.
"""

import sys
from collections.abc import Sequence

from benchmarks.quality.common import comparison, saved_runs
from benchmarks.quality.common.arguments import add_dataset, add_runs, parser
from benchmarks.quality.common.color_tables import CSV_COLUMNS, csv_rows, tables
from benchmarks.quality.common.recordings import MirroredRecording, Recording
from benchmarks.quality.common.sequence_runs import find_tasks, run_sequences
from benchmarks.quality.common.tables import write_csv
from benchmarks.quality.common.variants import parse_variants

TRACKERS = ("fused", "CSRT")


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    made = parser("color_video", __doc__, TRACKERS)
    add_dataset(made)
    add_runs(made)
    made.add_argument("--mirrored", action="store_true", help="left and right exchanged")
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
        todo = find_tasks(variants, options.dataset, options.only)
        before = saved_runs.load(options.against) if options.against else {}
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    recording = MirroredRecording if options.mirrored else Recording
    results = run_sequences(todo, options.jobs, recording, options.draws)
    print(tables(results))
    if options.against:
        print(f"\n{comparison.against_stored(results, before)}")
    if options.save:
        saved_runs.save(options.save, variants, results)
    write_csv(options.csv, CSV_COLUMNS, csv_rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
