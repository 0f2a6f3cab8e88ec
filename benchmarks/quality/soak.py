# SPDX-License-Identifier: MIT
"""Trackers that run for a long time, and are disturbed: memory, latency, drift.

    python -m benchmarks.quality.soak [--updates 1000000] [--trackers NAME...] [--jobs 2]

Each tracker goes through its scene of benchmarks/frame_size.py, forward and backward, in its own process.
In one of a hundred passes something covers the target for some frames; in another, frames are blank;
before another the tracker gets what is no frame, which it has to refuse; before another it is pickled, and
goes on as the copy. A tracker that has lost the target at the end of a pass, or follows something else,
starts again. The table has the resident memory after a hundredth of the updates and at the end, the
milliseconds of an update, and the overlap with the true boxes in the first and the last undisturbed passes.
"""

import argparse
import pickle
import resource
import sys
from collections.abc import Sequence
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from time import perf_counter_ns
from typing import Any, NamedTuple

import numpy as np
from tricue import Frame, Status, Track
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import one_thread

from benchmarks.frame_size import Case, cases

PERIOD = 100  # passes
COVERED, BLANK, REFUSED, PICKLED = range(4)  # passes of a period in which something happens
HIDDEN = slice(8, 16)  # frames of a pass
ASTRAY = 0.1  # overlap
HEAD = """\
| tracker | updates | refused | lost | astray | MB | at the end | ms | p99 | p99.9 | max | IoU, first | last |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"""


class Soaked(NamedTuple):
    """What a run of one tracker showed; latencies in nanoseconds, an update each; overlaps a pass each."""

    name: str
    refused: int
    lost: int
    astray: int
    early_memory: float
    memory: float
    latencies: np.ndarray
    overlaps: list[float]


def resident_megabytes() -> float:
    """Of this process, now."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def soak(case: Case, updates: int) -> Soaked:
    """Run a tracker for so many updates."""
    passes = Passes(case)
    latencies = np.zeros(updates, np.int32)
    tracker: Any = case.make(case.small)
    tracker.init(passes.frames[0], case.box(0, case.small))
    refused = lost = astray = done = 0
    early, overlaps = 0.0, list[float]()
    for number in range(updates):
        kind = number % PERIOD
        if kind == REFUSED:
            refused += _refuses(tracker)
        elif kind == PICKLED:
            tracker = pickle.loads(pickle.dumps(tracker))
        boxes = np.empty((len(passes.frames), 4))
        for index, frame in passes.of(kind):
            start = perf_counter_ns()
            track = tracker.update(frame)
            latencies[done] = min(perf_counter_ns() - start, 2**31 - 1)
            boxes[index] = track.box
            done += 1
            if done == max(updates // 100, 1):
                early = resident_megabytes()
            if done == updates:
                memory = resident_megabytes()
                return Soaked(case.name, refused, lost, astray, early, memory, latencies, overlaps)
        if kind > PICKLED + 1:  # not just after something happened
            overlaps.append(passes.overlap(boxes))
        is_lost = track.status is Status.LOST
        is_astray = not is_lost and passes.is_astray(track)
        lost, astray = lost + is_lost, astray + is_astray
        if is_lost or is_astray:
            tracker.init(passes.frames[0], case.box(0, case.small))
    raise AssertionError("a pass has at least one update")


class Passes:
    """The frames of a case forward and backward, as they are, covered, or blank."""

    def __init__(self, case: Case) -> None:
        self.frames: list[Frame] = [*case.frames, *case.frames[-2:0:-1]]
        there = [case.box(index, case.small) for index in range(len(case.frames))]
        self.boxes = np.array([*there, *there[-2:0:-1]])
        self._covered = list(self.frames)
        self._blank = list(self.frames)
        for index in range(len(self.frames))[HIDDEN]:
            self._covered[index] = covered(self.frames[index], self.boxes[index])
            self._blank[index] = blank(self.frames[index])

    def of(self, kind: int) -> list[tuple[int, Frame]]:
        """The numbers and frames of a pass; the first frame is its last, as the tracker has just seen it."""
        frames = {COVERED: self._covered, BLANK: self._blank}.get(kind, self.frames)
        return [*list(enumerate(frames))[1:], (0, frames[0])]

    def is_astray(self, track: Track) -> bool:
        """Whether a track of the first frame hardly touches the target."""
        return float(metrics.overlaps([track.box], self.boxes[:1])[0]) < ASTRAY

    def overlap(self, boxes: np.ndarray) -> float:
        """The mean overlap with the true boxes."""
        return float(np.mean(metrics.overlaps(boxes, self.boxes)))


def covered(frame: Frame, box: Sequence[float]) -> Frame:
    """The frame with noise, half a meter nearer, before the target."""
    x, y, width, height = (round(value) for value in box)
    rows, columns = slice(max(y, 0), max(y + height, 0)), slice(max(x, 0), max(x + width, 0))
    random = np.random.default_rng(0)
    channels: dict[str, Any] = {"timestamp": frame.timestamp}
    for name in ("color", "right", "depth"):
        image = getattr(frame, name)
        if image is None:
            continue
        channels[name] = image = image.copy()
        part = image[rows, columns]
        if name == "depth":
            part[...] = np.nanmin(part, initial=5.0) - 0.5
        else:
            part[...] = random.integers(0, 256, part.shape)
    return Frame(**channels)


def blank(frame: Frame) -> Frame:
    """A black frame in which no depth was measured."""
    channels: dict[str, Any] = {"timestamp": frame.timestamp}
    for name, value in (("color", 0), ("right", 0), ("depth", np.nan)):
        if getattr(frame, name) is not None:
            channels[name] = np.full_like(getattr(frame, name), value)
    return Frame(**channels)


def _refuses(tracker: Any) -> int:
    """Give the tracker what is no frame; ValueError where it takes it."""
    try:
        tracker.update("no frame")
    except TypeError:
        return 1
    raise ValueError("a tracker took what is no frame")


def row(found: Soaked) -> str:
    """The tracker's line of the table."""
    milliseconds = found.latencies / 1e6
    p50, p99, p999 = np.percentile(milliseconds, (50, 99, 99.9))
    part = max(len(found.overlaps) // 10, 1)
    first, last = np.mean(found.overlaps[:part]), np.mean(found.overlaps[-part:])
    cells = [
        found.name,
        f"{len(found.latencies):,}",
        f"{found.refused:,}",
        f"{found.lost:,}",
        f"{found.astray:,}",
        f"{found.early_memory:.1f}",
        f"{found.memory:.1f}",
        *(f"{value:.2f}" for value in (p50, p99, p999, milliseconds.max())),
        *(f"{value:.3f}" for value in (first, last)),
    ]
    return f"| {' | '.join(cells)} |"


def soaked_row(name: str, updates: int) -> str:
    """Run the case of that name on one thread."""
    case = next(case for case in cases() if case.name == name)
    with one_thread():
        return row(soak(case, updates))


def main() -> int:
    """A process a tracker."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--updates", type=int, default=1_000_000)
    parser.add_argument("--trackers", nargs="+", help="names of the table's rows; all")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    names = options.trackers or [case.name for case in cases()]
    print(HEAD, flush=True)
    context = get_context("spawn")
    with context.Pool(options.jobs, maxtasksperchild=1) as pool:
        for line in pool.imap(partial(soaked_row, updates=options.updates), names):
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
