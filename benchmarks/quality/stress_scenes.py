# SPDX-License-Identifier: MIT
"""Trackers on rendered stress scenes, tricue.scenes.stress, whose truth is exact.

    python -m benchmarks.quality.stress_scenes --trackers fused CSRT
    python -m benchmarks.quality.stress_scenes --trackers fused CSRT --kinds leaving hidden --away 300

Overlap and position are over frames in which at least half of the target is visible. "recovered": share of
the absences and occlusions after which the overlap is above 0.5 within the first 10 frames with the target
fully visible; "faithful": share of the scenes with look-alikes, or without the target for a while, in which
nothing else was TRACKED for more than 5 frames in a row; "LOST reported": share of the scenes with black or
unrelated images in which LOST was reported within 3 such frames. AUROC is over the frames of all scenes in
the row; frames without any visible part of the target count as lost.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from itertools import product

import numpy as np
from tricue.scenes.stress.plan import AWAY_FRAMES
from tricue.scenes.stress.scene import STRESS_CHANNELS, STRESS_KINDS

from benchmarks.quality.common.arguments import parser, seeds
from benchmarks.quality.common.frame_results import GOOD_OVERLAP, FrameResults
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.scene_runs import SceneResult, SceneTask, run_scene
from benchmarks.quality.common.tables import Cell, markdown, mean, write_csv
from benchmarks.quality.common.variants import Variant, parse_variants

TRACKERS = ("fused", "color-particle", "depth-particle", "flow-depth", "stereo-head", "CSRT")
NUMBERS = (
    *("mean IoU", "IoU > 0.5", "position, median m", "90 %", "with position"),
    *("recovered", "faithful", "LOST reported", "AUROC", "ms/frame"),
)
CSV_COLUMNS = ("channels", "kind", "tracker", *NUMBERS)
ALL_KINDS = "mean"
"""The kind in rows over all kinds."""


def tasks(
    variants: Sequence[Variant],
    channels: Iterable[str],
    kinds: Iterable[str],
    seeds: Iterable[int],
    away: int | None = None,
) -> list[SceneTask]:
    """A task per scene, with all trackers."""
    return [
        SceneTask(kind, seed, each, variants, away) for each, kind, seed in product(channels, kinds, seeds)
    ]


def numbers_of(runs: Sequence[SceneResult]) -> list[float]:
    """NUMBERS of one tracker's runs, in that order; every frame counts the same."""
    frames = FrameResults.pooled([each.frames for each in runs])
    counted = np.concatenate([each.counted for each in runs])
    overlaps, errors = frames.overlaps[counted], np.concatenate([each.errors for each in runs])[counted]
    known = errors[np.isfinite(errors)]
    median, high = np.percentile(known, [50, 90]).tolist() if known.size else [float("nan")] * 2
    return [
        float(overlaps.mean()),
        float((overlaps > GOOD_OVERLAP).mean()),
        *(median, high, float(known.size / errors.size)),
        *(
            mean([getattr(each, name) for each in runs])
            for name in ("recovered", "faithful", "reported_lost")
        ),
        *(frames.auroc, frames.milliseconds),
    ]


def grouped(results: Iterable[SceneResult]) -> Mapping[tuple[str, str, str], list[SceneResult]]:
    """By channels, kind and tracker, and with the kind ALL_KINDS for all kinds together."""
    found: dict[tuple[str, str, str], list[SceneResult]] = {}
    for each in results:
        for kind in (each.kind, ALL_KINDS):
            found.setdefault((each.channels, kind, each.tracker), []).append(each)
    return found


def overall(runs: Sequence[SceneResult]) -> list[float]:
    """NUMBERS of runs in several kinds of scenes, each kind counting the same in the overlaps."""
    kinds = {each.kind: [other for other in runs if other.kind == each.kind] for each in runs}
    each = np.array([numbers_of(same) for same in kinds.values()])
    return [*(mean(each[:, column]) for column in (0, 1)), *numbers_of(runs)[2:]]


def rows(results: Iterable[SceneResult]) -> list[list[Cell]]:
    """Channels, kind, tracker, and NUMBERS."""
    groups = grouped(results)
    order = sorted(
        groups, key=lambda key: (STRESS_CHANNELS.index(key[0]), [*STRESS_KINDS, ALL_KINDS].index(key[1]))
    )
    return [[*key, *(overall if key[1] == ALL_KINDS else numbers_of)(groups[key])] for key in order]


def tables(results: Sequence[SceneResult]) -> str:
    """Markdown, a table per set of channels."""
    parts, lines = [], rows(results)
    for channels in dict.fromkeys(str(line[0]) for line in lines):
        own = [line[1:] for line in lines if line[0] == channels]
        parts.append(f"{channels}\n\n{markdown(['kind', 'tracker', *NUMBERS], own)}")
    return "\n\n".join(parts)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    made = parser("stress_scenes", __doc__, TRACKERS)
    made.add_argument("--channels", nargs="+", choices=STRESS_CHANNELS, default=list(STRESS_CHANNELS))
    made.add_argument("--kinds", nargs="+", choices=STRESS_KINDS, default=list(STRESS_KINDS))
    made.add_argument("--seeds", type=seeds, default=seeds("0:20"), metavar="A:B", help="default 0:20")
    made.add_argument(
        "--away",
        type=int,
        metavar="N",
        help="frames, instead of 30 and 20, in which leaving and hidden targets are gone",
    )
    options = made.parse_args(arguments)
    if options.away is not None and not set(options.kinds) <= set(AWAY_FRAMES):
        made.error(f"--away: expected --kinds of {', '.join(AWAY_FRAMES)}")
    try:
        variants = parse_variants(options.trackers, options.set)
    except (TypeError, ValueError) as error:
        made.error(str(error))
    todo = tasks(variants, options.channels, options.kinds, options.seeds, options.away)
    results = [each for several in run_parallel(run_scene, todo, options.jobs) for each in several]
    if not results:
        made.error("--trackers: expected one that can use the channels")
    print(tables(results))
    write_csv(options.csv, CSV_COLUMNS, rows(results))
    for trouble in dict.fromkeys(
        f"{each.tracker} on {each.kind}, {each.channels}: {each.trouble}" for each in results if each.trouble
    ):
        print(trouble, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
