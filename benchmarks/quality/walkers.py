# SPDX-License-Identifier: MIT
"""Trackers on recorded depth of walkers who pass each other: from several starts, forward and backward.

    python -m benchmarks.quality.walkers [DATASET]

Eight runs on each recording (`common/protocols.py`, "starts"), each from the true box with its corner and
sides jittered by up to 5 % of the sides, once for each of --seeds, which is also the tracker's seed. The
first frame of a run, whose box is given, doesn't count.

In a crossing, something in front of the person covers more than 5 % of the true box. It lasts at least one
frame after the start; one that follows within two frames belongs to it. "right after crossings": of the
crossings that end, the share after which the overlap is above 0.3. "right": the share of all frames in which
the overlap is above 0.3.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics, one_pass
from tricue.evaluation.dataset import Entry, OpenedSequence, ReadOptions, find_entries
from tricue.evaluation.protocols import Order

from benchmarks.quality.common import sequences
from benchmarks.quality.common.arguments import parser, seeds
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Inputs, Variant, parse_variants
from benchmarks.quality.rgbd_people import MIN_RIGHT_OVERLAP, jittered

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

TRACKERS = ("depth-particle", "fused:depth", "flow-depth:depth")
MIN_NEARER = 0.3
"""Meters, by which something in front of a person is nearer."""
MIN_COVERED = 0.05
"""Share of the true box that is covered in a crossing."""
MAX_PAUSE = 2
"""Frames between two parts of one crossing."""


class WalkersTask(NamedTuple):
    """One tracker on one recording, in all orders and with all seeds."""

    variant: Variant
    entry: Entry
    seeds: Sequence[int]


class WalkersResult(NamedTuple):
    """The results of a run.

    start, way: of its order. iou, right: means over its frames. after: share of the crossings after which it
    is right; NaN without any. position_error: median, meters.
    """

    tracker: str
    sequence: str
    start: str
    way: str
    seed: int
    iou: float
    right: float
    after: float
    position_error: float
    trouble: str


def run_recording(task: WalkersTask) -> list[WalkersResult]:
    """Decode the recording once, and run the tracker in each order with each seed."""
    opened = task.entry.open()
    inputs = Inputs(("depth",), opened.intrinsics)
    if task.variant.unsupported(inputs):
        return []
    frames = [Frame(depth=frame.depth, timestamp=frame.timestamp) for frame in opened.source]
    covered = covered_shares(frames, opened.truth(len(frames)), opened.positions(len(frames)))
    view = task.variant.view(inputs)
    results = []
    for order in PROTOCOLS["starts"]:
        numbers = known_from_start(order.numbers(len(frames)), opened, len(frames))
        if len(numbers) < 2:
            continue
        seen = list(map(view, in_order(frames, numbers)))
        results += [run(task, opened, inputs, seen, order, numbers, covered, seed) for seed in task.seeds]
    return results


def known_from_start(numbers: NDArray[np.intp], opened: OpenedSequence, count: int) -> NDArray[np.intp]:
    """The numbers from the first frame with a true box on."""
    known = ~np.isnan(opened.truth(count)[numbers]).any(axis=1)
    return numbers[int(np.argmax(known)) :] if known.any() else numbers[:0]


def in_order(frames: Sequence[Frame], numbers: NDArray[np.intp]) -> list[Frame]:
    """The frames with these numbers; times increase, also if the numbers decrease."""
    first = frames[numbers[0]].timestamp
    seen = [frames[number] for number in numbers]
    if first is None:
        return seen
    return [replace(each, timestamp=abs((each.timestamp or 0.0) - first)) for each in seen]


def covered_shares(frames: Sequence[Frame], truth: Floats, positions: Floats) -> Floats:
    """(M,) the share of each true box that is nearer than the person; NaN if box or distance aren't known.

    If the person's true distance isn't known, it is the median depth in the middle half of the box.
    """
    shares = np.full(len(frames), np.nan)
    for i, frame in enumerate(frames):
        assert frame.depth is not None
        if np.isnan(truth[i]).any():
            continue
        x, y, width, height = truth[i]
        inside = frame.depth[_pixels(y, height), _pixels(x, width)]
        middle = frame.depth[_pixels(y + height / 4, height / 2), _pixels(x + width / 4, width / 2)]
        depths = middle[np.isfinite(middle) & (middle > 0)]
        z = positions[i, 2] if np.isfinite(positions[i, 2]) else np.median(depths) if depths.size else np.nan
        shares[i] = ((inside > 0) & (inside < z - MIN_NEARER)).mean() if np.isfinite(z) else np.nan
    return shares


def _pixels(start: float, length: float) -> slice:
    return slice(max(round(start), 0), max(round(start + length), round(start) + 1, 1))


def crossings(covered: Floats) -> list[int]:
    """The first frame after each crossing that ends."""
    during = np.nan_to_num(covered) > MIN_COVERED
    ends = []
    for i in range(2, len(during)):
        ended = during[i - 1] and not during[i]
        if ended and not during[i + 1 : i + MAX_PAUSE].any():
            ends.append(i)
    return ends


def run(
    task: WalkersTask,
    opened: OpenedSequence,
    inputs: Inputs,
    frames: Sequence[Frame],
    order: Order,
    numbers: NDArray[np.intp],
    covered: Floats,
    seed: int,
) -> WalkersResult:
    """One run to the end of its frames."""
    truth, positions = opened.truth(len(covered))[numbers], opened.positions(len(covered))[numbers]
    tracker = task.variant.make(inputs, seed)
    made = one_pass.run(tracker, frames, jittered(Box(*truth[0].tolist()), seed))
    overlaps = metrics.overlaps(opened.clip(made.boxes), truth)
    errors = metrics.position_errors(made.positions, positions)[1:]
    known, errors = overlaps[1:][~np.isnan(overlaps[1:])], errors[~np.isnan(errors)]
    after = [overlaps[i] for i in crossings(covered[numbers]) if not np.isnan(overlaps[i])]
    return WalkersResult(
        task.variant.label,
        task.entry.name,
        f"{order.start:g}",
        "backward" if order.backward else "forward",
        seed,
        mean(known),
        mean(known > MIN_RIGHT_OVERLAP),
        mean(np.array(after) > MIN_RIGHT_OVERLAP),
        float(np.median(errors)) if errors.size else float("nan"),
        tracker.error,
    )


def table(results: Sequence[WalkersResult]) -> str:
    """Markdown: a line per tracker, recording and way, and one for all recordings together."""
    trackers, names = ([*dict.fromkeys(each[i] for each in results)] for i in (0, 1))
    lines: list[list[Cell]] = []
    for tracker in trackers:
        means = []
        for name in names:
            for way in ("forward", "backward"):
                runs = [each for each in results if (each[0], each[1], each[3]) == (tracker, name, way)]
                numbers = [mean([each[i] for each in runs]) for i in range(5, 9)]
                means.append(numbers)
                worst = min((each.iou for each in runs), default=float("nan"))
                lines.append([tracker, name, way, *numbers[:1], worst, *numbers[1:]])
        overall = [mean([each[i] for each in means]) for i in range(4)]
        worst = min(each.iou for each in results if each.tracker == tracker)
        lines.append([tracker, "mean", "both", *overall[:1], worst, *overall[1:]])
    head = ["tracker", "recording", "way", "mean IoU", "worst run", "right", "right after crossings"]
    return markdown([*head, "position error, m"], lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = parser("walkers", __doc__, TRACKERS)
    folder = sequences.data_folder() / "rgbd"
    made.add_argument("dataset", type=Path, nargs="?", default=folder, help="default %(default)s")
    made.add_argument("--seeds", type=seeds, default=seeds("0:5"), metavar="A:B", help="default 0:5")
    made.add_argument("--only", nargs="+", metavar="NAME", help="recordings, default all")
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
        entries = find_entries(options.dataset, ReadOptions(truth="depth"))
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    chosen = [each for each in entries if options.only is None or each.name in options.only]
    todo = [WalkersTask(each, entry, options.seeds) for each in variants for entry in chosen]
    results = [each for several in run_parallel(run_recording, todo, options.jobs) for each in several]
    if not results:
        made.error("--trackers, --only: expected a tracker and a recording that it can use")
    print(table(results))
    write_csv(options.csv, WalkersResult._fields, results)
    for trouble in dict.fromkeys(
        f"{each.tracker} on {each.sequence}: {each.trouble}" for each in results if each.trouble
    ):
        print(trouble, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
