# SPDX-License-Identifier: MIT
"""The color search alone beside its peers: ``python -m benchmarks.quality.cues.search [FOLDER]``.

Every tracker starts on the first true box and on six that are shifted by 8 % of its width or height, or
smaller or larger by 6 %.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from tricue.camera.box import Box
from tricue.evaluation import baselines, metrics
from tricue.evaluation.baselines import Maker
from tricue.evaluation.one_pass import run

from benchmarks.quality import sequences
from benchmarks.quality.cues.color_search import ColorSearch, SearchParams

NAMES = ("David", "Girl")
PEERS = ("CamShift", "meanShift", "KCF")
SHIFT, SCALE = 0.08, 0.06


def starts(box: Box) -> list[Box]:
    """The seven boxes round a true one that trackers start on."""
    (x, y), (width, height) = box.center, box[2:]
    places = [(0.0, 0.0), (SHIFT, 0.0), (-SHIFT, 0.0), (0.0, SHIFT), (0.0, -SHIFT)]
    moved = [Box(box.x + right * width, box.y + down * height, width, height) for right, down in places]
    sizes = [(width * scale, height * scale) for scale in (1 - SCALE, 1 + SCALE)]
    return [*moved, *(Box(x - w / 2, y - h / 2, w, h) for w, h in sizes)]


def measure(make: Maker, sequence: sequences.Sequence) -> tuple[list[metrics.Score], float]:
    """The score of a tracker from each start, and its frames per second in the mean of them."""
    runs = [run(make(0), sequence.frames, box) for box in starts(Box(*sequence.truth[0].tolist()))]
    return [metrics.score(each.boxes, sequence.truth) for each in runs], float(
        np.mean([each.frames_per_second for each in runs])
    )


def makers() -> dict[str, Maker]:
    """The search, itself without the gradient, and the peers that the installed cv2 has."""
    known = baselines.available()
    return {
        "color search": lambda seed: ColorSearch(),
        "color search, no gradient": lambda seed: ColorSearch(SearchParams(gradient=0.0)),
        **{name: known[name] for name in PEERS if name in known},
    }


def table(trackers: Mapping[str, Maker], found: Sequence[sequences.Sequence]) -> str:
    """Markdown, a line per tracker: per sequence ``AUC (least-most)/precision frames/s`` over the starts."""
    lines = [["tracker", *(sequence.name for sequence in found)], ["---"] * (len(found) + 1)]
    for name, make in trackers.items():
        cells = []
        for sequence in found:
            scores, fps = measure(make, sequence)
            auc = [score.auc for score in scores]
            precision = np.mean([score.precision for score in scores])
            cells.append(f"{np.mean(auc):.2f} ({min(auc):.2f}-{max(auc):.2f})/{precision:.2f} {fps:.0f}")
        lines.append([name, *cells])
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    return report("cues.search", NAMES, makers(), arguments)


def report(
    name: str, usual: Sequence[str], trackers: Mapping[str, Maker], arguments: Sequence[str] | None
) -> int:
    """Parse the arguments of a module of this package, and print its trackers' table; the exit code."""
    parser = argparse.ArgumentParser(prog=f"python -m tricue.evaluation.{name}")
    parser.add_argument("folder", type=Path, nargs="?", help="of sequences; found through TRICUE_DATA")
    parser.add_argument("--sequences", default=",".join(usual), help="default %(default)s")
    options = parser.parse_args(arguments)
    folder = options.folder or sequences.data_folder() / "color"
    folders = {path.name: path for path in sequences.find(folder)}
    names = options.sequences.split(",")
    if missing := [each for each in names if each not in folders]:
        parser.error(f"--sequences: expected some with true boxes under {folder}, got {missing[0]!r}")
    print(table(trackers, [sequences.load(folders[each]) for each in names]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
