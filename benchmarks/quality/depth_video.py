# SPDX-License-Identifier: MIT
"""Trackers on recorded color and depth: forward, backward, from many starts, at a third of the frame rate.

    python -m benchmarks.quality.depth_video --shift 0.035 --jobs 2
    python -m benchmarks.quality.depth_video --save before.json --jobs 2
    python -m benchmarks.quality.depth_video --only paper-cup --times without --against before.json
    python -m benchmarks.quality.depth_video --shift 0.035 --draws 4 --jobs 2

The protocols, and the first boxes with --draws, are those of ``color_video``. A file such as
groundtruth_chair.txt beside groundtruth.txt has the true boxes of another target. If color isn't registered
to depth and the true boxes are in the depth image's pixels, color is registered to depth by the intrinsics of
both cameras and --shift, as in ``rgbd_people``. With "no times", frames have no timestamps, so that tricue's
trackers assume their default rate; baselines don't use times and run once.

The first table has the mean success AUC and the mean overlap. The differences are paired, with 95 % bootstrap
intervals over recordings, which are too narrow for so few recordings.

The last two tables pool the frames of all runs, each run once. "Lost" and "on target" are as in
``color_video``. Errors are along z, in meters: the median of all frames; then, of the frames that are TRACKED
on the target, the median, the median with its sign, the median standard deviation by the covariance, and the
shares of errors within one and two standard deviations; 0.683 and 0.954 would be right. True depths are from
position_z_mm.txt. Without that file they are the median depth in the inner half of the true box. Trackers see
the same measurements, so errors of the camera don't count, but differences of depth over the target do.
"""

import sys
from collections.abc import Sequence
from functools import partial

from benchmarks.quality.common import comparison, saved_runs
from benchmarks.quality.common.arguments import add_dataset, add_runs, parser
from benchmarks.quality.common.depth_recordings import DepthRecording, find_targets
from benchmarks.quality.common.depth_tables import CSV_COLUMNS, csv_rows, tables
from benchmarks.quality.common.sequence_runs import find_tasks, run_sequences
from benchmarks.quality.common.tables import write_csv
from benchmarks.quality.common.variants import Variant, parse_variants, without_times

TRACKERS = ("fused", "fused:color", "fused:depth", "CSRT")
WITH, WITHOUT, BOTH = "with", "without", "both"


def by_times(variants: Sequence[Variant], times: str) -> list[Variant]:
    """The variants with times, without or both, as --times says; baselines once, as they don't use times."""
    timed = [each for each in variants if times != WITHOUT or not each.spec.ours]
    return [*timed, *(without_times(each) for each in variants if times != WITH and each.spec.ours)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    made = parser("depth_video", __doc__, TRACKERS)
    add_dataset(made, "rgbd")
    add_runs(made)
    made.add_argument("--times", choices=(WITH, WITHOUT, BOTH), default=BOTH, help="default %(default)s")
    made.add_argument("--shift", type=float, default=0.0, metavar="M", help="meters, default 0")
    options = made.parse_args(arguments)
    try:
        variants = by_times(parse_variants(options.trackers, options.set), options.times)
        todo = find_tasks(variants, options.dataset, options.only, find_targets)
        before = saved_runs.load(options.against) if options.against else {}
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    recording = partial(DepthRecording, shift=options.shift)
    results = run_sequences(todo, options.jobs, recording, options.draws)
    print(tables(variants, results))
    if options.against:
        print(f"\n{comparison.against_stored(results, before)}")
    if options.save:
        saved_runs.save(options.save, variants, results)
    write_csv(options.csv, CSV_COLUMNS, csv_rows(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
