# SPDX-License-Identifier: MIT
"""Whether trackers drift: a dozen frames of a face, played to and fro for thousands of updates.

    python -m benchmarks.quality.drift [DATASET] [--trackers fused color-particle]

The frames are those of the sequence David at 160x120, from three starts in steps of 1, 5 and 10. What is in
them never changes, so whatever overlap is lost from the first pass to the last five is drift.
"""

import sys
from collections.abc import Iterator
from typing import NamedTuple

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue.evaluation import metrics

from benchmarks.quality.common import arguments, sequences

SIZE = (160, 120)
STARTS, STEPS = (0, 120, 300), (1, 5, 10)
LENGTH = 12  # frames
ORDER = (*range(1, LENGTH), *range(LENGTH - 2, -1, -1))  # of a pass, after the first frame
UPDATES = 3000
LAST = 5  # passes


class Case(NamedTuple):
    """A dozen frames and their true boxes."""

    start: int
    step: int
    frames: list[NDArray[np.uint8]]
    boxes: NDArray[np.float64]


def cases(sequence: sequences.Sequence) -> Iterator[Case]:
    """All, of a sequence of at least 411 frames."""
    first = np.asarray(sequence.frames[0].color)
    scale = np.tile([SIZE[0] / first.shape[1], SIZE[1] / first.shape[0]], 2)
    for start in STARTS:
        for step in STEPS:
            numbers = range(start, start + LENGTH * step, step)
            images = [np.asarray(sequence.frames[number].color) for number in numbers]
            small = [cv2.resize(each, SIZE, interpolation=cv2.INTER_AREA).astype(np.uint8) for each in images]
            yield Case(start, step, small, sequence.truth[list(numbers)] * scale)


def drift(tracker: str, case: Case, updates: int = UPDATES) -> tuple[float, float]:
    """The mean overlaps in the first pass and in the last five."""
    followed = tricue.create(tracker)
    followed.init(case.frames[0], tuple(case.boxes[0]))
    shown = [ORDER[number % len(ORDER)] for number in range(updates)]
    boxes = [followed.update(case.frames[index]).box for index in shown]
    overlaps = metrics.overlaps(boxes, case.boxes[shown])
    return float(np.mean(overlaps[: len(ORDER)])), float(np.mean(overlaps[-LAST * len(ORDER) :]))


def main() -> int:
    """A line a case and tracker."""
    parser = arguments.bare_parser("drift", __doc__)
    parser.add_argument("--trackers", nargs="+", default=["fused", "color-particle"], metavar="NAME")
    arguments.add_dataset(parser)
    options = parser.parse_args()
    print("| tracker | from frame | step | first pass | last passes | ratio |")
    print("| --- | --- | --- | --- | --- | --- |")
    for tracker in options.trackers:
        for case in cases(sequences.load(options.dataset / "David")):
            first, last = drift(tracker, case)
            numbers = f"{first:.3f} | {last:.3f} | {last / first:.2f}"
            print(f"| {tracker} | {case.start} | {case.step} | {numbers} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
