# SPDX-License-Identifier: MIT
"""Trackers on recorded color sequences, each from the first true box and from six slightly different ones.

The six are shifted by 8 % of the box's width or height, or smaller or larger by 6 %.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from tricue.camera.box import Box
from tricue.evaluation import metrics
from tricue.evaluation.baselines import Maker
from tricue.evaluation.one_pass import run

from benchmarks.quality.common import sequences
from benchmarks.quality.common.arguments import bare_parser
from benchmarks.quality.common.tables import markdown

SHIFT, SCALE = 0.08, 0.06


def starts(box: Box) -> list[Box]:
    """The true box, and the six that differ from it."""
    (x, y), (width, height) = box.center, box[2:]
    shifts = [(0.0, 0.0), (SHIFT, 0.0), (-SHIFT, 0.0), (0.0, SHIFT), (0.0, -SHIFT)]
    shifted = [Box(box.x + right * width, box.y + down * height, width, height) for right, down in shifts]
    sizes = [(width * scale, height * scale) for scale in (1 - SCALE, 1 + SCALE)]
    return [*shifted, *(Box(x - w / 2, y - h / 2, w, h) for w, h in sizes)]


def measure(make: Maker, sequence: sequences.Sequence) -> tuple[list[metrics.Score], float]:
    """The score of a tracker from each start, and their mean frames per second."""
    runs = [run(make(0), sequence.frames, box) for box in starts(Box(*sequence.truth[0].tolist()))]
    scores = [metrics.score(each.boxes, sequence.truth) for each in runs]
    return scores, float(np.mean([each.frames_per_second for each in runs]))


def table(trackers: Mapping[str, Maker], found: Sequence[sequences.Sequence]) -> str:
    """Markdown, a line per tracker; per sequence ``AUC (least-most)/precision frames/s`` over the starts."""
    lines = []
    for name, make in trackers.items():
        cells = []
        for sequence in found:
            scores, fps = measure(make, sequence)
            auc = [score.auc for score in scores]
            precision = np.mean([score.precision for score in scores])
            cells.append(f"{np.mean(auc):.2f} ({min(auc):.2f}-{max(auc):.2f})/{precision:.2f} {fps:.0f}")
        lines.append([name, *cells])
    return markdown(["tracker", *(sequence.name for sequence in found)], lines)


def main(
    script: str,
    about: str | None,
    names: Sequence[str],
    trackers: Mapping[str, Maker],
    arguments: Sequence[str] | None,
) -> int:
    """The main function of a script with these trackers: print the table; returns the exit code.

    names: the sequences of a run without --sequences.
    """
    parser = bare_parser(script, about)
    parser.add_argument("folder", type=Path, nargs="?", help="of sequences; default in TRICUE_DATA")
    parser.add_argument("--sequences", default=",".join(names), help="default %(default)s")
    options = parser.parse_args(arguments)
    folder = options.folder or sequences.data_folder() / "color"
    folders = {path.name: path for path in sequences.find(folder)}
    chosen = options.sequences.split(",")
    if missing := [each for each in chosen if each not in folders]:
        parser.error(f"--sequences: expected some with true boxes under {folder}, got {missing[0]!r}")
    print(table(trackers, [sequences.load(folders[each]) for each in chosen]))
    return 0
