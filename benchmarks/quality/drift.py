# SPDX-License-Identifier: MIT
"""Whether trackers drift: a dozen frames of a face, played forward and backward for thousands of updates.

    python -m benchmarks.quality.drift [DATASET] [--trackers fused color-particle] [--seeds 0:5] [--jobs 2]

The frames are from the sequence David, at 160x120, from three starts in steps of 1, 5 and 10. Their content
never changes, so any overlap that is lost between the first pass and the last five is drift. A tracker that
draws random numbers runs once per seed; its overlaps are means over the seeds.
"""

import sys
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue.cli.arguments import count
from tricue.evaluation import metrics

from benchmarks.quality.common import arguments, sequences
from benchmarks.quality.common.parallel import run_parallel

SIZE = (160, 120)
STARTS, STEPS = (0, 120, 300), (1, 5, 10)
LENGTH = 12  # frames
ORDER = (*range(1, LENGTH), *range(LENGTH - 2, -1, -1))  # of the frames in a pass, after the first frame
UPDATES = 3000
LAST = 5  # passes


class Case(NamedTuple):
    """A dozen frames and their true boxes."""

    start: int
    step: int
    frames: list[NDArray[np.uint8]]
    boxes: NDArray[np.float64]


def cases(sequence: sequences.Sequence) -> Iterator[Case]:
    """All cases from a sequence of at least 411 frames."""
    first = np.asarray(sequence.frames[0].color)
    scale = np.tile([SIZE[0] / first.shape[1], SIZE[1] / first.shape[0]], 2)
    for start in STARTS:
        for step in STEPS:
            numbers = range(start, start + LENGTH * step, step)
            images = [np.asarray(sequence.frames[number].color) for number in numbers]
            small = [cv2.resize(each, SIZE, interpolation=cv2.INTER_AREA).astype(np.uint8) for each in images]
            yield Case(start, step, small, sequence.truth[list(numbers)] * scale)


def drift(tracker: str, case: Case, updates: int = UPDATES, seed: int = 0) -> tuple[float, float]:
    """The mean overlaps in the first pass and in the last five."""
    followed = tricue.create(tracker, seed=seed)
    followed.init(case.frames[0], tuple(case.boxes[0]))
    shown = [ORDER[number % len(ORDER)] for number in range(updates)]
    boxes = [followed.update(case.frames[index]).box for index in shown]
    overlaps = metrics.overlaps(boxes, case.boxes[shown])
    return float(np.mean(overlaps[: len(ORDER)])), float(np.mean(overlaps[-LAST * len(ORDER) :]))


def drift_by_seed(tracker: str, seeds: Sequence[int], case: Case) -> NDArray[np.float64]:
    """(2, seeds): the overlaps of :func:`drift` for each seed."""
    return np.transpose([drift(tracker, case, seed=seed) for seed in seeds])


def main() -> int:
    """Print a line per case and tracker."""
    parser = arguments.bare_parser("drift", __doc__)
    parser.add_argument("--trackers", nargs="+", default=["fused", "color-particle"], metavar="NAME")
    parser.add_argument("--seeds", type=arguments.seeds, default=range(5), metavar="A:B", help="default 0:5")
    parser.add_argument("--jobs", type=count, default=1, metavar="N", help="processes, default %(default)s")
    arguments.add_dataset(parser)
    options = parser.parse_args()
    print("| tracker | from frame | step | first pass | last passes | ratio | lowest of a seed |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    found = list(cases(sequences.load(options.dataset / "David")))
    for tracker in options.trackers:
        seeds = options.seeds if tricue.create(tracker).traits.random else options.seeds[:1]
        runs = run_parallel(partial(drift_by_seed, tracker, seeds), found, options.jobs)
        for case, (first, last) in zip(found, runs, strict=True):
            means = f"{first.mean():.3f} | {last.mean():.3f} | {last.mean() / first.mean():.2f}"
            print(f"| {tracker} | {case.start} | {case.step} | {means} | {(last / first).min():.2f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
