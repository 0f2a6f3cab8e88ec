# SPDX-License-Identifier: MIT
"""The fused tracker without each of its cues: ``python -m benchmarks.quality.fused.ablation --jobs 2``.

A row with all cues, one without each, and cv2's CSRT. The first columns are those of ``robust`` on recorded
color sequences, AUROC too; the last the mean overlap in scenes, as in ``scenes``, by their channels. The peer
sees color alone, which is the same in all of them, so that it runs on that once.
"""

import argparse
import sys
from collections.abc import Iterable, Sequence

from tricue.evaluation import baselines
from tricue.evaluation.tracker_spec import Entrant
from tricue.scenes.stress.scene import STRESS_KINDS
from tricue.track.base.registry import tracker_class

from benchmarks.quality.fused import robust, scene_runs, scenes
from benchmarks.quality.fused.options import Cell, add_common, markdown, performed, seeds, write_csv
from benchmarks.quality.fused.variants import Participant, with_settings

TRACKER, PEER = "fused", "CSRT"
CHANNELS = ("color", "rgbd", "stereo")
SCENES = ("all", "fast", "lookalike", "hidden")
HEAD = ("", *robust.PROTOCOLS, "AUROC", *CHANNELS, "ms/frame")


def contestants() -> list[Participant]:
    """The tracker with all cues, without each of them where the others can go on, and the peer."""
    whole, cues = Participant(TRACKER, Entrant(TRACKER)), tracker_class(TRACKER).Params().cues
    found = [whole]
    for cue in cues:
        rest = tuple(each for each in cues if each != cue)
        if _possible(rest):
            found.append(with_settings(whole, f"without {cue}", {"cues": rest}))
    if PEER in baselines.available():
        found.append(Participant(PEER, Entrant(PEER)))
    return found


def _possible(cues: tuple[str, ...]) -> bool:
    try:
        tracker_class(TRACKER).Params(cues=cues)
    except ValueError:
        return False
    return True


def _able(found: Sequence[Participant], channels: str) -> list[Participant]:
    """Those who see more in a scene than in one of color alone, or all in that."""
    return [each for each in found if each.entrant.ours or channels == "color"]


def lines(
    found: Sequence[Participant],
    recorded: Sequence[robust.Result],
    drawn: Iterable[scene_runs.Followed],
) -> list[list[Cell]]:
    """HEAD for each contestant; NaN where it didn't run."""
    by_tracker, groups = robust.by_tracker(recorded), scenes.grouped(drawn)
    made: list[list[Cell]] = []
    for each in (participant.label for participant in found):
        runs = by_tracker.get(each, [])
        said = robust.pooled(runs) if runs else None
        line: list[Cell] = [each, *(robust.means(runs)), said.auroc if said else float("nan")]
        for channels in CHANNELS:
            followed = groups.get((channels, scenes.ALL, each))
            line.append(scenes.overall(followed)[0] if followed else float("nan"))
        made.append([*line, said.milliseconds if said else float("nan")])
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = argparse.ArgumentParser(prog="python -m benchmarks.quality.fused.ablation", description=__doc__)
    robust.add_dataset(made)
    made.add_argument("--kinds", nargs="+", choices=STRESS_KINDS, default=list(SCENES), help="of scenes")
    made.add_argument("--seeds", type=seeds, default=seeds("0:3"), metavar="A:B", help="default 0:3")
    add_common(made)
    options = made.parse_args(arguments)
    found = contestants()
    try:
        todo = robust.tasks(found, options.dataset)
    except (OSError, ValueError) as error:
        made.error(str(error))
    todo.sort(key=lambda task: -task.participant.entrant.slowness)  # so that all processes end together
    recorded = list(performed(robust.perform, todo, options.jobs))
    scenery = [
        task
        for channels in CHANNELS
        for task in scenes.tasks(_able(found, channels), (channels,), options.kinds, options.seeds)
    ]
    drawn = [each for several in performed(scene_runs.perform, scenery, options.jobs) for each in several]
    table = lines(found, recorded, drawn)
    print(markdown(HEAD, table))
    write_csv(options.csv, HEAD, table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
