# SPDX-License-Identifier: MIT
"""sad_disparity beside cv2.StereoBM on Middlebury pairs: ``python -m benchmarks.quality.cues.disparity``.

Both match with the same window and x-Sobel prefilter. Errors are over the same pixels: both give a disparity,
and the true one is known and within the searched range. "dense" rejects nothing, "kept" what the uniqueness
of 15 % rejects, which is each one's default. StereoBM gives nothing in the first D - 1 columns, and ours is
asked for the others only: the rates count the disparities of the pixels that both compute (GDE/s: 1e9 a
second), in the fastest of some rounds in turn, on one thread.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.evaluation.one_pass import one_thread

from benchmarks.quality.sequences import data_folder

Floats = NDArray[np.float32]
Image = NDArray[np.uint8]

PAIRS = {"tsukuba": (16, 16), "venus": (8, 32), "sawtooth": (8, 32), "bull": (8, 32), "cones": (4, 64)}
"""Grey levels of the truth per pixel of disparity, and D, the number of disparities that are searched."""

UNIQUENESS = {"dense": 0, "kept": 15}  # percent
GAINS = (1.0, 0.9)  # of the right image
FRACTION = 16  # parts of a pixel in StereoBM's fixed-point numbers
BAD = 1.0  # px
COLUMNS = (
    *("pair", "D", "mean px: BM", "ours", "bad %: BM", "ours"),
    *("kept %: BM", "ours", "GDE/s: BM", "ours", "times as fast"),
)


class Pair(NamedTuple):
    """Rectified grey images (H, W), the left one's true disparities, NaN where unknown, and D."""

    name: str
    left: Image
    right: Image
    truth: Floats
    disparities: int


class Result(NamedTuple):
    """What one matcher did."""

    mean: float  # px, of the errors
    bad: float  # percent of the pixels that are off by more than BAD
    kept: float  # percent of those with truth that have a disparity
    rate: float  # 1e9 disparities a second


def load(folder: Path, name: str) -> Pair:
    """A pair from ``folder/name``: im2.png, im6.png and disp2.png. OSError where one isn't there."""
    images = [
        cv2.imread(str(folder / name / file), cv2.IMREAD_GRAYSCALE)
        for file in ("im2.png", "im6.png", "disp2.png")
    ]
    if any(image is None for image in images):
        raise OSError(f"folder: expected im2.png, im6.png and disp2.png in {folder / name}")
    left, right, levels = (np.asarray(image, np.uint8) for image in images)
    factor, count = PAIRS[name]
    truth = np.where(levels > 0, levels / np.float32(factor), np.float32(np.nan))
    return Pair(name, left, right, truth.astype(np.float32), count)


def measure(
    pair: Pair, window: int = 5, uniqueness: int = 0, gain: float = 1.0, rounds: int = 25
) -> tuple[Result, Result]:
    """StereoBM's result and ours, the right image made ``gain`` times as bright."""
    height, width = pair.left.shape
    right = np.rint(pair.right * gain).astype(np.uint8)
    matcher = cv2.StereoBM.create(pair.disparities, window)
    matcher.setUniquenessRatio(uniqueness)
    matcher.setTextureThreshold(0)
    region = (pair.disparities - 1, 0, width, height)

    def theirs() -> NDArray[np.generic]:
        return np.asarray(matcher.compute(pair.left, right))

    def ours() -> NDArray[np.generic]:
        return _core.sad_disparity(
            pair.left, right, region, False, 0, pair.disparities - 1, window, uniqueness
        )

    seconds = fastest((theirs, ours), rounds)
    fixed = theirs()[:, pair.disparities - 1 :].astype(np.float32) / FRACTION
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
            Result(float(errors.mean()), 100 * float((errors > BAD).mean()), 100 * float(kept), work / time)
        )
    return results[0], results[1]


def table(pairs: Iterable[Pair], window: int, uniqueness: int, gain: float, rounds: int = 25) -> str:
    """Markdown, a line per pair: COLUMNS; and the means of the errors."""
    lines: list[Sequence[str]] = [COLUMNS, ["---"] * len(COLUMNS)]
    errors = []
    for pair in pairs:
        them, us = measure(pair, window, uniqueness, gain, rounds)
        errors.append((them.mean, us.mean, them.bad, us.bad))
        kept, rates = (f"{them.kept:.1f}", f"{us.kept:.1f}"), (f"{them.rate:.2f}", f"{us.rate:.2f}")
        times = f"{us.rate / them.rate:.1f}"
        lines.append([pair.name, str(pair.disparities), *_errors(errors[-1]), *kept, *rates, times])
    lines.append(["mean", "", *_errors(np.mean(errors, axis=0).tolist()), *[""] * 5])
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def report(pairs: Sequence[Pair], windows: Sequence[int], rounds: int = 25) -> Iterator[str]:
    """A titled table for each window, dense and kept, with right images as they are and darker."""
    for window in windows:
        for name, uniqueness in UNIQUENESS.items():
            for gain in GAINS:
                light = "" if gain == 1 else f", the right image {1 - gain:.0%} darker"
                lines = table(pairs, window, uniqueness, gain, rounds)
                yield f"{window}x{window}, {name}{light}\n\n{lines}\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.quality.cues.disparity")
    parser.add_argument("folder", type=Path, nargs="?", help="of the pairs; found through TRICUE_DATA")
    parser.add_argument("--windows", default="5", help="sides, separated by commas; default %(default)s")
    parser.add_argument("--rounds", type=int, default=25, help="of timing, default %(default)s")
    options = parser.parse_args(arguments)
    folder = options.folder or data_folder() / "disparity"
    names = [name for name in PAIRS if (folder / name).is_dir()]
    if not names:
        parser.error(f"folder: expected pairs such as {next(iter(PAIRS))} under {folder}")
    windows = [int(window) for window in options.windows.split(",")]
    with one_thread():
        for text in report([load(folder, name) for name in names], windows, options.rounds):
            print(text)
    return 0


def fastest(calls: Sequence[Callable[[], object]], rounds: int) -> list[float]:
    """Seconds of the fastest of some rounds, in which the calls take turns."""
    best = [np.inf] * len(calls)
    for _ in range(max(1, rounds)):
        for index, call in enumerate(calls):
            start = perf_counter()
            call()
            best[index] = min(best[index], perf_counter() - start)
    return best


def _errors(values: Sequence[float]) -> list[str]:
    theirs, ours, their_bad, our_bad = values
    return [f"{theirs:.4f}", f"{ours:.4f}", f"{their_bad:.3f}", f"{our_bad:.3f}"]


if __name__ == "__main__":
    sys.exit(main())
