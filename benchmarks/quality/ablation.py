# SPDX-License-Identifier: MIT
"""The fused tracker without each of its cues.

    python -m benchmarks.quality.ablation --jobs 2

The rows are the tracker with all cues, without each of them, and cv2's CSRT. The first columns and AUROC are
those of ``color_video``, over all sequences; the next columns are the mean overlap in ``stress_scenes`` by
channels. CSRT uses color alone, which is the same for all channels, so it runs once.
"""

import sys
from collections.abc import Iterable, Sequence

from tricue.evaluation import baselines
from tricue.evaluation.tracker_spec import TrackerSpec
from tricue.scenes.stress.scene import STRESS_KINDS
from tricue.track.base.registry import tracker_class

from benchmarks.quality import stress_scenes
from benchmarks.quality.common import scene_runs, sequence_runs
from benchmarks.quality.common.arguments import add_dataset, add_output, bare_parser, seeds
from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.tables import Cell, markdown, write_csv
from benchmarks.quality.common.variants import Variant, with_settings

TRACKER, BASELINE = "fused", "CSRT"
CHANNELS = ("color", "rgbd", "stereo")
SCENES = ("all", "fast", "lookalike", "hidden")
HEAD = ("", *PROTOCOLS, "AUROC", *CHANNELS, "ms/frame")


def ablated() -> list[Variant]:
    """The tracker with all cues, without each cue that it can do without, and the baseline."""
    whole, cues = Variant(TRACKER, TrackerSpec(TRACKER)), tracker_class(TRACKER).Params().cues
    found = [whole]
    for cue in cues:
        rest = tuple(each for each in cues if each != cue)
        if _possible(rest):
            found.append(with_settings(whole, f"without {cue}", {"cues": rest}))
    if BASELINE in baselines.available():
        found.append(Variant(BASELINE, TrackerSpec(BASELINE)))
    return found


def _possible(cues: tuple[str, ...]) -> bool:
    try:
        tracker_class(TRACKER).Params(cues=cues)
    except ValueError:
        return False
    return True


def _with_new_inputs(variants: Sequence[Variant], channels: str) -> list[Variant]:
    """The variants that get more from these channels than from color alone; all variants for color."""
    return [each for each in variants if each.spec.ours or channels == "color"]


def lines(
    variants: Sequence[Variant],
    recorded: Sequence[sequence_runs.SequenceResult],
    rendered: Iterable[scene_runs.SceneResult],
) -> list[list[Cell]]:
    """HEAD for each variant; NaN where it didn't run."""
    by_tracker, groups = sequence_runs.by_tracker(recorded), stress_scenes.grouped(rendered)
    made: list[list[Cell]] = []
    for label in (variant.label for variant in variants):
        runs = by_tracker.get(label, [])
        frames = sequence_runs.pool(runs) if runs else None
        line: list[Cell] = [label, *(sequence_runs.mean_auc(runs, protocol) for protocol in PROTOCOLS)]
        line.append(summarize(frames).auroc if frames else float("nan"))
        for channels in CHANNELS:
            results = groups.get((channels, stress_scenes.ALL_KINDS, label))
            line.append(stress_scenes.overall(results)[0] if results else float("nan"))
        made.append([*line, frames.milliseconds if frames else float("nan")])
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = bare_parser("ablation", __doc__)
    add_dataset(made)
    made.add_argument("--kinds", nargs="+", choices=STRESS_KINDS, default=list(SCENES), help="of scenes")
    made.add_argument("--seeds", type=seeds, default=seeds("0:3"), metavar="A:B", help="default 0:3")
    add_output(made)
    options = made.parse_args(arguments)
    variants = ablated()
    try:
        todo = sequence_runs.find_tasks(variants, options.dataset)
    except (OSError, ValueError) as error:
        made.error(str(error))
    recorded = sequence_runs.run_sequences(todo, options.jobs)
    scenes = [
        task
        for channels in CHANNELS
        for task in stress_scenes.tasks(
            _with_new_inputs(variants, channels), (channels,), options.kinds, options.seeds
        )
    ]
    rendered = [
        each for several in run_parallel(scene_runs.run_scene, scenes, options.jobs) for each in several
    ]
    table = lines(variants, recorded, rendered)
    print(markdown(HEAD, table))
    write_csv(options.csv, HEAD, table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
