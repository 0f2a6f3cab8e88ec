# SPDX-License-Identifier: MIT
"""Trackers in rendered rooms, tricue.scenes.rooms, with realistic targets, surrounds and sensors.

    python -m benchmarks.quality.room_scenes --jobs 2
    python -m benchmarks.quality.room_scenes --channels stereo --trackers fused:color fused CSRT

Mean AUC by kind of scene, over frames in which at least half of the target is visible. Each scene counts the
same in its kind, and each kind in "mean". "difference" is the mean over scenes minus that of the first
tracker on the same scenes, with its 95 % bootstrap interval. "recovered": share of the scenes "returning" in
which the overlap is above 0.5 within the first 10 frames with the target fully visible again.
"""

import sys
from collections.abc import Sequence
from itertools import product

from tricue.evaluation import metrics
from tricue.evaluation.bootstrap import mean_interval
from tricue.scenes.rooms.scene import ROOM_CHANNELS, ROOM_KINDS, room_scene

from benchmarks.quality.common.arguments import parser, seeds
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.scene_runs import SceneResult, SceneTask, channels_of, run_variant
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Inputs, parse_variants

TRACKERS = ("fused:color", "fused", "fused:depth", "CSRT")
CSV_COLUMNS = ("kind", "seed", "tracker", "AUC", "recovered")


def run_room(task: SceneTask) -> list[SceneResult]:
    """Render the room once, and run all trackers that can use its channels."""
    inputs = Inputs(channels_of(task.channels))
    able = [each for each in task.variants if not each.unsupported(inputs)]
    if not able:
        return []
    scene = room_scene(task.kind, task.seed, channels=task.channels)
    return [run_variant(each, scene, task.channels) for each in able]


def auc(result: SceneResult) -> float:
    """Area under the success curve, over the counted frames."""
    return float(metrics.success_curve(result.frames.overlaps[result.counted]).mean())


def rows(results: Sequence[SceneResult]) -> list[list[Cell]]:
    """A line per tracker: the mean AUC of each kind and of all, the difference, recovered."""
    trackers = [*dict.fromkeys(each.tracker for each in results)]
    kinds = [*dict.fromkeys(each.kind for each in results)]
    aucs = {(each.tracker, each.kind, each.seed): auc(each) for each in results}
    scenes = [*dict.fromkeys((each.kind, each.seed) for each in results)]
    lines: list[list[Cell]] = []
    for tracker in trackers:
        own = {scene: aucs[tracker, scene[0], scene[1]] for scene in scenes}
        means = [mean([value for scene, value in own.items() if scene[0] == kind]) for kind in kinds]
        against = [own[kind, seed] - aucs[trackers[0], kind, seed] for kind, seed in scenes]
        interval = mean_interval(against, [f"{kind} {seed}" for kind, seed in scenes], least=2)
        difference = f"{interval.mean:+.3f} ({interval.low:+.3f} to {interval.high:+.3f})"
        recovered = mean([each.recovered for each in results if each.tracker == tracker])
        lines.append([tracker, *means, mean(means), difference if tracker != trackers[0] else "", recovered])
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = parser("room_scenes", __doc__, TRACKERS)
    made.add_argument("--channels", choices=ROOM_CHANNELS, default="rgbd", help="default rgbd")
    made.add_argument("--kinds", nargs="+", choices=ROOM_KINDS, default=list(ROOM_KINDS))
    made.add_argument("--seeds", type=seeds, default=seeds("0:10"), metavar="A:B", help="default 0:10")
    options = made.parse_args(arguments)
    try:
        variants = parse_variants(options.trackers, options.set)
    except (TypeError, ValueError) as error:
        made.error(str(error))
    todo = [
        SceneTask(kind, seed, options.channels, variants)
        for kind, seed in product(options.kinds, options.seeds)
    ]
    results = [each for several in run_parallel(run_room, todo, options.jobs) for each in several]
    if not results:
        made.error("--trackers: expected one that can use the channels")
    kinds = dict.fromkeys(each.kind for each in results)
    print(markdown(["tracker", *kinds, "mean", "difference", "recovered"], rows(results)))
    lines: list[list[Cell]] = [
        [each.kind, each.seed, each.tracker, auc(each), each.recovered] for each in results
    ]
    write_csv(options.csv, CSV_COLUMNS, lines)
    for trouble in dict.fromkeys(
        f"{each.tracker} on {each.kind}: {each.trouble}" for each in results if each.trouble
    ):
        print(trouble, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
