# SPDX-License-Identifier: MIT
"""gradient_disparity near predicted disparities, on Middlebury's stereo pairs.

    python -m benchmarks.quality.cues.gradient_disparity

The prediction is varied over the pair's disparities in steps of a pixel. For each prediction, the whole image
is measured near it, as a tracker does near its target's disparity. Pixels whose match is in the right image
are

- near, with a true disparity within 2 px of the prediction: the median error of those that get a disparity,
  and their share ("read");
- far, 4 px or more from it: the share with a disparity within 1 px of the prediction, which a tracker would
  take for its target, of all far pixels and of those that get a disparity;
- nearer, by 4 to 6 px, like an object that passes in front of a target: the share that gets a disparity, and
  the median error.

The default, three levels, is compared with the paper's one level without windows, and with cv2.StereoBM, 5x5,
over the 16 disparities around the prediction. Times are for whole images, the fastest of some rounds, on one
thread.
"""

import sys
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.evaluation.one_pass import one_thread
from tricue.track.flow_depth.cues import GradientMatching

from benchmarks.quality.common import middlebury
from benchmarks.quality.common.arguments import bare_parser
from benchmarks.quality.common.middlebury import STEREO_BM_FRACTION, StereoPair
from benchmarks.quality.common.tables import markdown
from benchmarks.quality.common.timing import fastest

Floats = NDArray[np.float32]
Image = NDArray[np.uint8]
Method = Callable[[Image, Image, float], Floats]

MAX_NEAR, MIN_FAR, MAX_NEARER = 2.0, 4.0, 6.0
"""Pixels between the true disparity and the prediction."""
MAX_ON_TARGET = 1.0
"""Pixels between a measured disparity and the prediction, within which it counts as the target's."""
STEREO_BM_DISPARITIES = 16
COLUMNS = (
    *("pair", "method", "median px", "read %", "far as near %", "of those read %"),
    *("nearer: read %", "median px", "ms"),
)


class Result(NamedTuple):
    """One method on one pair; shares in percent, NaN without such pixels."""

    median: float  # px, of the errors of near pixels
    read: float  # of the near pixels
    far_as_near: float  # of the far pixels
    far_as_near_read: float  # of the far pixels that are read
    nearer_read: float  # of the pixels that are nearer by 4 to 6 px
    nearer_median: float  # px
    milliseconds: float


def three_levels(left: Image, right: Image, prediction: float) -> Floats:
    """The default."""
    return _core.gradient_disparity(left, right, prediction, GradientMatching())[0]


def one_level(left: Image, right: Image, prediction: float) -> Floats:
    """The paper's method: one level, each pixel alone."""
    matching = GradientMatching(levels=1, sigma=2.0, radius=0, max_step=2.0)
    return _core.gradient_disparity(left, right, prediction, matching)[0]


def block_matching(left: Image, right: Image, prediction: float) -> Floats:
    """StereoBM over the same range, with its own uniqueness check of 15 %."""
    first = round(prediction) - STEREO_BM_DISPARITIES // 2
    matcher = cv2.StereoBM.create(STEREO_BM_DISPARITIES, 5)
    matcher.setMinDisparity(first)
    matcher.setUniquenessRatio(15)
    found = np.asarray(matcher.compute(left, right), np.float32) / STEREO_BM_FRACTION
    return np.where(found >= first, found, np.float32(np.nan))


METHODS: dict[str, Method] = {
    "three levels": three_levels,
    "one level": one_level,
    "StereoBM": block_matching,
}


def predictions(pair: StereoPair) -> list[float]:
    """Predictions a pixel apart, over all disparities of the pair, not only at whole numbers."""
    return list(np.arange(float(np.nanmin(pair.truth)), float(np.nanmax(pair.truth)) + 0.01, 1.0))


def measure(pair: StereoPair, method: Method, rounds: int = 5) -> Result:
    """Measure a method; the pixels of all predictions are pooled."""
    columns = np.arange(pair.left.shape[1], dtype=np.float32)
    matched = pair.truth <= columns  # NaN isn't
    counts = np.zeros(6)  # near, read of them; far, read, taken for the target; nearer
    errors, nearer_errors = [], []
    for prediction in predictions(pair):
        found = method(pair.left, pair.right, prediction)
        read, error = np.isfinite(found), abs(found - pair.truth)
        off = pair.truth - np.float32(prediction)
        near, far = matched & (abs(off) <= MAX_NEAR), matched & (abs(off) >= MIN_FAR)
        nearer = matched & (off >= MIN_FAR) & (off <= MAX_NEARER)
        taken = far & read & (abs(found - np.float32(prediction)) <= MAX_ON_TARGET)
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


def table(pairs: Iterable[StereoPair], rounds: int = 5) -> str:
    """Markdown: COLUMNS, a line per pair and method."""
    lines = []
    for pair in pairs:
        for name, method in METHODS.items():
            result = measure(pair, method, rounds)
            shares = (result.read, result.far_as_near, result.far_as_near_read, result.nearer_read)
            lines.append(
                [
                    *(pair.name, name, f"{result.median:.3f}"),
                    *(f"{share:.1f}" for share in shares),
                    *(f"{result.nearer_median:.3f}", f"{result.milliseconds:.2f}"),
                ]
            )
    return markdown(COLUMNS, lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    parser = bare_parser("cues.gradient_disparity", __doc__)
    middlebury.add_arguments(parser)
    options = parser.parse_args(arguments)
    pairs = middlebury.load_all(parser, options)
    with one_thread():
        print(table(pairs, options.rounds))
    return 0


def _median(values: NDArray[np.floating]) -> float:
    return float(np.median(values)) if values.size else float("nan")


def _percent(part: float, whole: float) -> float:
    return 100 * part / whole if whole else float("nan")


if __name__ == "__main__":
    sys.exit(main())
