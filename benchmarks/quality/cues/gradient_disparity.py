# SPDX-License-Identifier: MIT
"""gradient_disparity round predictions on Middlebury pairs.

``python -m benchmarks.quality.cues.gradient_disparity`` prints a table.

The prediction goes through the pair's disparities a pixel at a time, and each time the whole image is
measured round it, as a tracker does round its target's. Pixels whose match the right image shows count as

- near, with a true disparity within 2 px of the prediction: the error's median over those that are read, and
  how many are;
- far, 4 px or more from it: how many are reported within 1 px of the prediction, of all far ones and of those
  that are read, which is what a tracker would take for its target;
- nearer, by 4 to 6 px, as what passes in front of a target: how many are read, and their errors' median.

Beside the default of three levels stand the paper's one level without windows, and cv2.StereoBM, 5x5, over
the 16 disparities round the prediction. Times are of whole images, the fastest of some rounds, one thread.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.evaluation.one_pass import one_thread

from benchmarks.quality.cues.disparity import FRACTION, PAIRS, Pair, fastest, load
from benchmarks.quality.sequences import data_folder

Floats = NDArray[np.float32]
Image = NDArray[np.uint8]
Method = Callable[[Image, Image, float], Floats]

NEAR, FAR, NEARER = 2.0, 4.0, 6.0  # px from the prediction
REPORTED = 1.0  # px from the prediction: taken for the target
COUNT = 16  # disparities of StereoBM
COLUMNS = (
    *("pair", "method", "median px", "read %", "far as near %", "of those read %"),
    *("nearer: read %", "median px", "ms"),
)


class Result(NamedTuple):
    """What one method did on one pair; shares in percent, NaN where there is no such pixel."""

    median: float  # px, of the errors of near pixels
    read: float  # of the near pixels
    far_as_near: float  # of the far pixels
    far_as_near_read: float  # of the far pixels that are read
    nearer_read: float  # of the pixels that are nearer by 4 to 6 px
    nearer_median: float  # px
    milliseconds: float


def three_levels(left: Image, right: Image, prediction: float) -> Floats:
    """The default."""
    return _core.gradient_disparity(left, right, prediction)[0]


def one_level(left: Image, right: Image, prediction: float) -> Floats:
    """The paper's: one level, each pixel alone."""
    return _core.gradient_disparity(left, right, prediction, levels=1, sigma=2.0, radius=0, max_step=2.0)[0]


def block_matching(left: Image, right: Image, prediction: float) -> Floats:
    """StereoBM over the same range, with its own rejection of 15 %."""
    first = round(prediction) - COUNT // 2
    matcher = cv2.StereoBM.create(COUNT, 5)
    matcher.setMinDisparity(first)
    matcher.setUniquenessRatio(15)
    found = np.asarray(matcher.compute(left, right), np.float32) / FRACTION
    return np.where(found >= first, found, np.float32(np.nan))


METHODS: dict[str, Method] = {
    "three levels": three_levels,
    "one level": one_level,
    "StereoBM": block_matching,
}


def predictions(pair: Pair) -> list[float]:
    """A pixel apart, through all disparities of the pair, between whole numbers as well as on them."""
    return list(np.arange(float(np.nanmin(pair.truth)), float(np.nanmax(pair.truth)) + 0.01, 1.0))


def measure(pair: Pair, method: Method, rounds: int = 5) -> Result:
    """All predictions' pixels together."""
    columns = np.arange(pair.left.shape[1], dtype=np.float32)
    seen = pair.truth <= columns  # NaN isn't
    counts = np.zeros(6)  # near, read of them; far, read, reported near; nearer
    errors, nearer_errors = [], []
    for prediction in predictions(pair):
        found = method(pair.left, pair.right, prediction)
        read, error = np.isfinite(found), abs(found - pair.truth)
        off = pair.truth - np.float32(prediction)
        near, far = seen & (abs(off) <= NEAR), seen & (abs(off) >= FAR)
        nearer = seen & (off >= FAR) & (off <= NEARER)
        taken = far & read & (abs(found - np.float32(prediction)) <= REPORTED)
        counts += [each.sum() for each in (near, near & read, far, far & read, taken, nearer)]
        errors.append(error[near & read])
        nearer_errors.append(error[nearer & read])
    near_count, near_read, far_count, far_read, taken_count, nearer_count = counts
    nearer_all = np.concatenate(nearer_errors)
    middle = float(np.nanmedian(pair.truth))
    (seconds,) = fastest([lambda: method(pair.left, pair.right, middle)], rounds)
    return Result(
        _median(np.concatenate(errors)),
        _percent(near_read, near_count),
        _percent(taken_count, far_count),
        _percent(taken_count, far_read),
        _percent(nearer_all.size, nearer_count),
        _median(nearer_all),
        1e3 * seconds,
    )


def table(pairs: Iterable[Pair], rounds: int = 5) -> Iterator[str]:
    """Markdown: COLUMNS, a line per pair and method."""
    yield _line(COLUMNS)
    yield _line(["---"] * len(COLUMNS))
    for pair in pairs:
        for name, method in METHODS.items():
            result = measure(pair, method, rounds)
            yield _line(
                [
                    pair.name,
                    name,
                    f"{result.median:.3f}",
                    *(f"{value:.1f}" for value in (result.read, result.far_as_near, result.far_as_near_read)),
                    f"{result.nearer_read:.1f}",
                    f"{result.nearer_median:.3f}",
                    f"{result.milliseconds:.2f}",
                ]
            )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.quality.cues.gradient_disparity")
    parser.add_argument("folder", type=Path, nargs="?", help="of the pairs; found through TRICUE_DATA")
    parser.add_argument("--rounds", type=int, default=25, help="of timing, default %(default)s")
    options = parser.parse_args(arguments)
    folder = options.folder or data_folder() / "disparity"
    names = [name for name in PAIRS if (folder / name).is_dir()]
    if not names:
        parser.error(f"folder: expected pairs such as {next(iter(PAIRS))} under {folder}")
    with one_thread():
        for line in table([load(folder, name) for name in names], options.rounds):
            print(line)
    return 0


def _median(values: NDArray[np.floating]) -> float:
    return float(np.median(values)) if values.size else float("nan")


def _percent(part: float, whole: float) -> float:
    return 100 * part / whole if whole else float("nan")


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    sys.exit(main())
