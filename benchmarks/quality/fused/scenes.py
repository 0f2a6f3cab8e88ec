# SPDX-License-Identifier: MIT
"""Trackers on scenes with exact truth: ``python -m benchmarks.quality.fused.scenes --trackers fused CSRT``.

tricue.scenes.stress_scene, each scene drawn once for all trackers. Overlap and position count in frames in
which at least half of the target is visible. "found again": of the times away or hidden, those after which
the overlap is above 0.5 within 10 frames from where the target is wholly visible; "faithful": of the scenes
with look-alikes, those in which none was TRACKED for more than 5 frames in a row; "LOST told": of the scenes
with black or other pictures, those in which LOST was said within 3 frames. In AUROC, over the frames of all
scenes of the row, frames without anything of the target count as lost.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from itertools import product

import numpy as np
from tricue.scenes.stress.scene import STRESS_CHANNELS, STRESS_KINDS

from benchmarks.quality.fused.options import Cell, markdown, mean, parser, performed, seeds, write_csv
from benchmarks.quality.fused.scene_runs import Followed, Task, perform
from benchmarks.quality.fused.status_metrics import GOOD, Said
from benchmarks.quality.fused.variants import Participant, participants

TRACKERS = ("fused", "color-particle", "depth-particle", "flow-depth", "stereo-head", "CSRT")
NUMBERS = (
    *("mean IoU", "IoU > 0.5", "position, median m", "90 %", "with position"),
    *("found again", "faithful", "LOST told", "AUROC", "ms/frame"),
)
ALL = "mean"  # of all kinds


def tasks(
    found: Sequence[Participant], channels: Iterable[str], kinds: Iterable[str], seeds: Iterable[int]
) -> list[Task]:
    """A scene each, all trackers in it."""
    return [Task(kind, seed, sight, found) for sight, kind, seed in product(channels, kinds, seeds)]


def numbers_of(runs: Sequence[Followed]) -> list[float]:
    """NUMBERS of one tracker's runs, in that order; every frame counts the same."""
    said = Said.pooled([each.said for each in runs])
    seen = np.concatenate([each.seen for each in runs])
    overlaps, errors = said.overlaps[seen], np.concatenate([each.errors for each in runs])[seen]
    known = errors[np.isfinite(errors)]
    median, high = np.percentile(known, [50, 90]).tolist() if known.size else [float("nan")] * 2
    return [
        float(overlaps.mean()),
        float((overlaps > GOOD).mean()),
        *(median, high, float(known.size / errors.size)),
        *(mean([getattr(each, name) for each in runs]) for name in ("found", "faithful", "told")),
        *(said.auroc, said.milliseconds),
    ]


def grouped(results: Iterable[Followed]) -> Mapping[tuple[str, str, str], list[Followed]]:
    """By channels, kind and tracker, and with the kind ALL for all kinds together."""
    found: dict[tuple[str, str, str], list[Followed]] = {}
    for each in results:
        for kind in (each.kind, ALL):
            found.setdefault((each.channels, kind, each.tracker), []).append(each)
    return found


def overall(runs: Sequence[Followed]) -> list[float]:
    """NUMBERS of runs in several kinds of scenes, each kind counting the same in the overlaps."""
    kinds = {each.kind: [other for other in runs if other.kind == each.kind] for each in runs}
    each = np.array([numbers_of(same) for same in kinds.values()])
    return [*(mean(each[:, column]) for column in (0, 1)), *numbers_of(runs)[2:]]


def rows(results: Iterable[Followed]) -> list[list[Cell]]:
    """Channels, kind, tracker, and NUMBERS."""
    groups = grouped(results)
    order = sorted(
        groups, key=lambda key: (STRESS_CHANNELS.index(key[0]), [*STRESS_KINDS, ALL].index(key[1]))
    )
    return [[*key, *(overall if key[1] == ALL else numbers_of)(groups[key])] for key in order]


def tables(results: Sequence[Followed]) -> str:
    """Markdown, one table of each set of channels."""
    parts, lines = [], rows(results)
    for channels in dict.fromkeys(str(line[0]) for line in lines):
        own = [line[1:] for line in lines if line[0] == channels]
        parts.append(f"{channels}\n\n{markdown(['kind', 'tracker', *NUMBERS], own)}")
    return "\n\n".join(parts)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    made = parser("scenes", __doc__, TRACKERS)
    made.add_argument("--channels", nargs="+", choices=STRESS_CHANNELS, default=list(STRESS_CHANNELS))
    made.add_argument("--kinds", nargs="+", choices=STRESS_KINDS, default=list(STRESS_KINDS))
    made.add_argument("--seeds", type=seeds, default=seeds("0:20"), metavar="A:B", help="default 0:20")
    options = made.parse_args(arguments)
    try:
        found = participants(options.trackers, options.set)
    except (TypeError, ValueError) as error:
        made.error(str(error))
    todo = tasks(found, options.channels, options.kinds, options.seeds)
    results = [each for several in performed(perform, todo, options.jobs) for each in several]
    if not results:
        made.error("--trackers: expected one that can see the channels")
    print(tables(results))
    write_csv(options.csv, ["channels", "kind", "tracker", *NUMBERS], rows(results))
    for trouble in dict.fromkeys(
        f"{each.tracker} on {each.kind}, {each.channels}: {each.trouble}" for each in results if each.trouble
    ):
        print(trouble, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
