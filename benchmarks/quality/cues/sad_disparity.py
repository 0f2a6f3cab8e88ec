# SPDX-License-Identifier: MIT
"""sad_disparity compared with cv2.StereoBM on Middlebury's stereo pairs.

    python -m benchmarks.quality.cues.sad_disparity

Both match with the same window and x-Sobel prefilter. Errors are over pixels for which both give a disparity,
and the true one is known and within the searched range. "dense" rejects nothing; "kept" rejects by a
uniqueness of 15 %, the default of both. StereoBM gives no disparity in the first D - 1 columns, so
sad_disparity computes only the others. The rates count the disparities evaluated in the pixels that both
compute (GDE/s: 1e9 per second), in the fastest round, on one thread.
"""

import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.evaluation.one_pass import one_thread

from benchmarks.quality.common import middlebury
from benchmarks.quality.common.arguments import bare_parser
from benchmarks.quality.common.middlebury import STEREO_BM_FRACTION, StereoPair
from benchmarks.quality.common.tables import Cell, markdown
from benchmarks.quality.common.timing import fastest

UNIQUENESS = {"dense": 0, "kept": 15}  # percent
GAINS = (1.0, 0.9)  # of the right image
BAD_ERROR = 1.0  # px
COLUMNS = (
    *("pair", "D", "mean px: BM", "ours", "bad %: BM", "ours"),
    *("kept %: BM", "ours", "GDE/s: BM", "ours", "times as fast"),
)


class Result(NamedTuple):
    """One matcher's errors, density and speed."""

    mean: float  # px, of the errors
    bad: float  # percent of the pixels that are off by more than BAD_ERROR
    kept: float  # percent of those with truth that have a disparity
    rate: float  # 1e9 disparities per second


def measure(
    pair: StereoPair, window: int = 5, uniqueness: int = 0, gain: float = 1.0, rounds: int = 25
) -> tuple[Result, Result]:
    """The results of StereoBM and sad_disparity; the right image is made ``gain`` times as bright."""
    height, width = pair.left.shape
    right = np.rint(pair.right * gain).astype(np.uint8)
    matcher = cv2.StereoBM.create(pair.disparities, window)
    matcher.setUniquenessRatio(uniqueness)
    matcher.setTextureThreshold(0)
    region, limits = (pair.disparities - 1, 0, width, height), (0, pair.disparities - 1)

    def theirs() -> NDArray[np.generic]:
        return np.asarray(matcher.compute(pair.left, right))

    def ours() -> NDArray[np.generic]:
        return _core.sad_disparity(pair.left, right, region, False, limits, (window, uniqueness, True))

    seconds = fastest((theirs, ours), rounds)
    fixed = theirs()[:, pair.disparities - 1 :].astype(np.float32) / STEREO_BM_FRACTION
    found = (np.where(fixed < 0, np.float32(np.nan), fixed), np.asarray(ours(), np.float32))
    truth = pair.truth[:, pair.disparities - 1 :]
    known = truth <= pair.disparities - 2
    both = known & np.isfinite(found[0]) & np.isfinite(found[1])
    work = (width - pair.disparities + 1) * height * pair.disparities / 1e9
    results = []
    for each, time in zip(found, seconds, strict=True):
        errors = np.abs(each[both] - truth[both])
        kept = np.isfinite(each[known]).mean()
        results.append(
            Result(
                float(errors.mean()), 100 * float((errors > BAD_ERROR).mean()), 100 * float(kept), work / time
            )
        )
    return results[0], results[1]


def table(pairs: Iterable[StereoPair], window: int, uniqueness: int, gain: float, rounds: int = 25) -> str:
    """Markdown, a line per pair: COLUMNS; and the means of the errors."""
    lines: list[list[Cell]] = []
    errors = []
    for pair in pairs:
        theirs, ours = measure(pair, window, uniqueness, gain, rounds)
        errors.append((theirs.mean, ours.mean, theirs.bad, ours.bad))
        kept = f"{theirs.kept:.1f}", f"{ours.kept:.1f}"
        rates = f"{theirs.rate:.2f}", f"{ours.rate:.2f}", f"{ours.rate / theirs.rate:.1f}"
        lines.append([pair.name, str(pair.disparities), *_errors(errors[-1]), *kept, *rates])
    lines.append(["mean", "", *_errors(np.mean(errors, axis=0).tolist()), *[""] * 5])
    return markdown(COLUMNS, lines)


def report(pairs: Sequence[StereoPair], windows: Sequence[int], rounds: int = 25) -> Iterator[str]:
    """A table with a title for each window, dense and kept, with the right images unchanged and darker."""
    for window in windows:
        for name, uniqueness in UNIQUENESS.items():
            for gain in GAINS:
                light = "" if gain == 1 else f", the right image {1 - gain:.0%} darker"
                lines = table(pairs, window, uniqueness, gain, rounds)
                yield f"{window}x{window}, {name}{light}\n\n{lines}\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    parser = bare_parser("cues.sad_disparity", __doc__)
    middlebury.add_arguments(parser)
    parser.add_argument("--windows", default="5", help="sides, separated by commas; default %(default)s")
    options = parser.parse_args(arguments)
    pairs = middlebury.load_all(parser, options)
    windows = [int(window) for window in options.windows.split(",")]
    with one_thread():
        for text in report(pairs, windows, options.rounds):
            print(text)
    return 0


def _errors(values: Sequence[float]) -> list[str]:
    theirs, ours, their_bad, our_bad = values
    return [f"{theirs:.4f}", f"{ours:.4f}", f"{their_bad:.3f}", f"{our_bad:.3f}"]


if __name__ == "__main__":
    sys.exit(main())
