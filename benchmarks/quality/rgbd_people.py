# SPDX-License-Identifier: MIT
"""Trackers on a person among other people, in recorded color and depth.

    python -m benchmarks.quality.rgbd_people [DATASET]

Each tracker starts ten times on the first true box, with corner and sides jittered by up to 5 % of the sides.
True boxes are in the depth image's pixels. Color is registered to these by the intrinsics of both cameras and
--shift, meters to the right from the color to the depth camera; by default both cameras are in one place. In
the recordings of TRICUE_DATA, depth edges of near objects match the strongest color gradients at a shift of
0.03 to 0.04. "at the end": share of the runs whose overlap is above 0.3 in the last frame with a true box.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import metrics, one_pass
from tricue.evaluation.dataset import Entry, OpenedSequence, ReadOptions, find_entries

from benchmarks.quality.common import sequences
from benchmarks.quality.common.arguments import parser, seeds
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.registered_frames import color_camera, registered
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Inputs, Variant, parse_variants

TRACKERS = ("fused", "fused:depth", "fused:color", "depth-particle", "flow-depth", "flow-depth:depth")
MAX_JITTER = 0.05
"""Share of a box's sides."""
MIN_RIGHT_OVERLAP = 0.3
"""Above this overlap the tracker is on the right person."""


class PeopleTask(NamedTuple):
    """One tracker on one sequence, from a jittered box per seed. shift: meters, as in --shift."""

    variant: Variant
    entry: Entry
    seeds: Sequence[int]
    shift: float = 0.0


class PeopleResult(NamedTuple):
    """A run: mean overlap, whether it ended on the target, median error along z in meters."""

    tracker: str
    sequence: str
    seed: int
    iou: float
    right: float
    z_error: float
    trouble: str


def run_seeds(task: PeopleTask) -> list[PeopleResult]:
    """Decode the sequence once, and run the tracker from each box; no runs if a channel is missing."""
    opened = task.entry.open()
    camera = color_camera(opened)
    channels = ("depth",) if camera is None else ("color", "depth")
    inputs = Inputs(channels, opened.intrinsics)
    if task.variant.unsupported(inputs):
        return []
    frames = list(map(task.variant.view(inputs), registered(opened, camera, task.shift)))
    return [run(task, opened, inputs, frames, seed) for seed in task.seeds]


def jittered(box: Box, seed: int) -> Box:
    """A box near a true one: corner and sides off by up to MAX_JITTER of the sides, uniformly."""
    x, y, width, height = np.random.default_rng(seed).uniform(-MAX_JITTER, MAX_JITTER, 4).tolist()
    return Box(
        box.x + x * box.width, box.y + y * box.height, box.width * (1 + width), box.height * (1 + height)
    )


def run(
    task: PeopleTask, opened: OpenedSequence, inputs: Inputs, frames: Sequence[Frame], seed: int
) -> PeopleResult:
    """One run to the end."""
    start, count = opened.start, len(frames)
    tracker = task.variant.make(inputs)
    box = jittered(Box(*opened.boxes[start].tolist()), seed)
    made = one_pass.run(tracker, frames, box, start)
    overlaps = metrics.overlaps(opened.clip(made.boxes), opened.truth(count))[start:]
    errors = metrics.position_errors(made.positions, opened.positions(count))[start:]
    known, errors = overlaps[~np.isnan(overlaps)], errors[~np.isnan(errors)]
    z_error = float(np.median(errors)) if errors.size else float("nan")
    names = task.variant.label, task.entry.name, seed
    return PeopleResult(*names, mean(known), float(known[-1] > MIN_RIGHT_OVERLAP), z_error, tracker.error)


def table(results: Sequence[PeopleResult]) -> str:
    """Markdown, a line per tracker: overlap and share at the end of each sequence, and their means."""
    trackers, names = ([*dict.fromkeys(each[i] for each in results)] for i in (0, 1))
    lines: list[list[Cell]] = []
    for tracker in trackers:
        own = [[each for each in results if each[:2] == (tracker, name)] for name in names]
        ious, rights = ([mean([run[i] for run in runs]) for runs in own] for i in (3, 4))
        both = zip([*ious, mean(ious)], [*rights, mean(rights)], strict=True)
        z_error = mean([each.z_error for runs in own for each in runs])
        lines.append([tracker, *(number for numbers in both for number in numbers), z_error])
    columns = [column for name in (*names, "mean") for column in (f"{name}: mean IoU", "at the end")]
    return markdown(["tracker", *columns, "z error, m"], lines, 2)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = parser("rgbd_people", __doc__, TRACKERS)
    folder = sequences.data_folder() / "rgbd"
    made.add_argument("dataset", type=Path, nargs="?", default=folder, help="default %(default)s")
    made.add_argument("--seeds", type=seeds, default=seeds("0:10"), metavar="A:B", help="default 0:10")
    made.add_argument("--shift", type=float, default=0.0, metavar="M", help="meters, default 0")
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
        entries = find_entries(options.dataset, ReadOptions(truth="depth"))
    except (OSError, TypeError, ValueError) as error:
        made.error(str(error))
    todo = [PeopleTask(each, entry, options.seeds, options.shift) for each in variants for entry in entries]
    results = [each for several in run_parallel(run_seeds, todo, options.jobs) for each in several]
    if not results:
        made.error("--trackers: expected one that can use the sequences")
    print(table(results))
    write_csv(options.csv, PeopleResult._fields, results)
    for trouble in dict.fromkeys(
        f"{each.tracker} on {each.sequence}: {each.trouble}" for each in results if each.trouble
    ):
        print(trouble, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
