# SPDX-License-Identifier: MIT
"""gradient_flow and pyramid_flow, compared with cv2's dense flows and Lucas-Kanade.

    python -m benchmarks.quality.cues.dense_flow

Errors are average endpoint errors in pixels. All methods are measured over the same pixels: the half of those
with a true flow that rank first by tricue's reliabilities, angle^2 contrast. The square root of that is about
the smaller singular value of equation (4), so its inverse bounds the flow's error; on synthetic frames, the
errors of one level fall with nearly these powers (``fit``). Pixels without a flow rank last. Times are the
fastest of some rounds, on one thread; Lucas-Kanade's is for that half. "kept" pixels have a tracker's minimum
reliabilities.
"""

import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue import _core
from tricue.evaluation.one_pass import one_thread

from benchmarks.quality.common.arguments import bare_parser
from benchmarks.quality.common.moving_waves import moving_waves
from benchmarks.quality.common.opencv_flows import Floats, Image, dis, farneback, lucas_kanade
from benchmarks.quality.common.sequences import data_folder
from benchmarks.quality.common.tables import markdown
from benchmarks.quality.common.timing import fastest

SIGMA, PYRAMID_SIGMA, LEVELS = 2.0, 1.0, 3
MIN_ANGLE, MIN_CONTRAST = 0.1, 1.0  # reliabilities of flow that a tracker keeps
MIN_FIT_ANGLE = 0.3
SHIFTS = (0.5, 1, 2, 3, 4, 6)  # px
BASELINES = ("Farneback", "DIS ultrafast", "DIS medium", "Lucas-Kanade")
COLUMNS = (
    "frames",
    "flow",
    "kept %",
    "AEE",
    *BASELINES,
    "of DIS",
    "ms",
    *(f"ms {name}" for name in BASELINES),
)


class Frames(NamedTuple):
    """Gray frames (H, W) and the true flow (H, W, 2) of the first one's pixels, NaN where unknown."""

    name: str
    previous: Image
    current: Image
    truth: Floats


class RatedFlow(NamedTuple):
    """Flow (H, W, 2), NaN where there is none, and its reliabilities (H, W)."""

    flow: Floats
    angle: Floats
    contrast: Floats


class Result(NamedTuple):
    """One of METHODS: percent of pixels kept; errors and seconds, first its own, then the BASELINES'."""

    kept: float
    errors: tuple[float, ...]
    seconds: tuple[float, ...]


class FlowMethod(NamedTuple):
    """A kernel: u, v, angle, contrast from two frames; and the sign of u, v for the first frame's pixels."""

    kernel: Callable[[Image, Image], tuple[Floats, Floats, Floats, Floats]]
    sign: int

    def find(self, frames: Frames) -> RatedFlow:
        """Every pixel's flow."""
        u, v, angle, contrast = self.kernel(frames.previous, frames.current)
        return RatedFlow(self.sign * np.dstack([u, v]), angle, contrast)


def one_level(sigma: float = SIGMA) -> FlowMethod:
    """gradient_flow, whose flow is for the time halfway between the frames."""
    return FlowMethod(lambda previous, current: _core.gradient_flow(previous, current, sigma, 0, 0), 1)


def pyramid(sigma: float = PYRAMID_SIGMA) -> FlowMethod:
    """pyramid_flow; its flow is for the second frame's pixels, so the frames are exchanged."""
    return FlowMethod(
        lambda previous, current: _core.pyramid_flow(current, previous, sigma, LEVELS, 0, 0), -1
    )


METHODS = {"one level": one_level(), "pyramid": pyramid()}


def load(folder: Path) -> Frames:
    """``NAME1.png``, ``NAME2.png`` and ``NAME.flo`` in a folder NAME. OSError if one is missing."""
    paths = [folder / f"{folder.name}{end}" for end in ("1.png", "2.png", ".flo")]
    if not all(path.is_file() for path in paths):
        raise OSError(f"folder: expected {', '.join(path.name for path in paths)} in {folder}")
    previous, current = (
        np.asarray(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE), np.uint8) for path in paths[:2]
    )
    truth = np.asarray(cv2.readOpticalFlow(str(paths[2])), np.float32)
    known = (abs(truth) < 1e9).all(axis=2, keepdims=True)
    return Frames(folder.name, previous, current, np.where(known, truth, np.float32(np.nan)))


def synthetic(seed: int = 0) -> list[Frames]:
    """Textures that shift as a whole by SHIFTS, and two that rotate and grow or shrink."""
    rng = np.random.default_rng(seed)
    cases = [(f"shift {shift:g} px", 0.0, 1.0, shift) for shift in SHIFTS]
    cases += [("turn and grow", 2.0, 1.03, 0.5), ("turn and shrink", -1.5, 0.98, 0.5)]
    return [
        Frames(name, *moving_waves(degrees, growth, shift, rng, noise=2.0))
        for name, degrees, growth, shift in cases
    ]


def reliable_half(found: RatedFlow, known: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(H, W): the half of the known pixels that rank first by angle^2 contrast; without flow, last."""
    rank = np.where(np.isfinite(found.flow[..., 0]), found.angle**2 * found.contrast, -1)
    order = np.argsort(-rank[known], kind="stable")[: max(1, int(known.sum()) // 2)]
    half = np.zeros(known.shape, np.bool_)
    half.flat[np.flatnonzero(known)[order]] = True
    return half


def measure(frames: Frames, method: FlowMethod, rounds: int = 10) -> Result:
    """Errors and times of a method and of the BASELINES on its reliable half."""
    known = np.asarray(np.isfinite(frames.truth).all(axis=2))
    found = method.find(frames)
    half = reliable_half(found, known)
    flows: list[Callable[[], object]] = [lambda: method.kernel(frames.previous, frames.current)]
    errors = [_error(found.flow, frames.truth, half)]
    for dense in (
        farneback(),
        dis(cv2.DISOPTICAL_FLOW_PRESET_ULTRAFAST),
        dis(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM),
    ):
        errors.append(_error(dense(frames.previous, frames.current), frames.truth, half))
        flows.append(lambda dense=dense: dense(frames.previous, frames.current))  # type: ignore[misc]
    errors.append(_error(lucas_kanade(frames.previous, frames.current, half), frames.truth, half))
    flows.append(lambda: lucas_kanade(frames.previous, frames.current, half))
    kept = np.isfinite(found.flow[..., 0]) & (found.angle >= MIN_ANGLE) & (found.contrast >= MIN_CONTRAST)
    return Result(100 * float(kept[known].mean()), tuple(errors), tuple(fastest(flows, rounds)))


def table(cases: Iterable[Frames], rounds: int = 10) -> str:
    """Markdown, a line per case and method: COLUMNS."""
    lines = []
    for frames in cases:
        for name, method in METHODS.items():
            result = measure(frames, method, rounds)
            ratio = result.errors[0] / result.errors[1 + BASELINES.index("DIS ultrafast")]
            errors = [f"{error:.3f}" for error in result.errors]
            times = [f"{1e3 * seconds:.2f}" for seconds in result.seconds]
            lines.append([frames.name, name, f"{result.kept:.0f}", *errors, f"{ratio:.2f}", *times])
    return markdown(COLUMNS, lines)


def fit(cases: Iterable[Frames], sigma: float = SIGMA) -> tuple[float, float]:
    """Exponents of angle and contrast in one level's error, by least squares on their logarithms.

    Only above MIN_FIT_ANGLE: at smaller angles the largest errors are missing, as flow that long is rejected.
    """
    rows = []
    for frames in cases:
        found = one_level(sigma).find(frames)
        error = np.linalg.norm(found.flow - frames.truth, axis=2)
        used = np.isfinite(error) & (error > 0) & (found.angle > MIN_FIT_ANGLE)
        rows.append(np.log(np.stack([error[used], found.angle[used], found.contrast[used]])))
    error, angle, contrast = np.concatenate(rows, axis=1)
    terms = np.stack([angle, contrast, np.ones_like(angle)], axis=1)
    powers = np.linalg.lstsq(terms, error, rcond=None)[0]
    return float(powers[0]), float(powers[1])


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table and the fit; the exit code."""
    parser = bare_parser("cues.dense_flow", __doc__)
    parser.add_argument("folder", type=Path, nargs="?", help="of RubberWhale; default in TRICUE_DATA")
    parser.add_argument("--rounds", type=int, default=10, help="of timing, default %(default)s")
    options = parser.parse_args(arguments)
    folder = options.folder or data_folder() / "flow" / "RubberWhale"
    if not folder.is_dir():
        parser.error(f"folder: expected frames and flow in {folder}")
    with one_thread():
        print(table([load(folder), *synthetic()], options.rounds))
    powers = fit(
        frames for frames in synthetic() if frames.name in ("shift 0.5 px", "shift 1 px", "turn and shrink")
    )
    print(
        "\nOn synthetic frames the error of one level goes with angle^{:.2f} contrast^{:.2f}.".format(*powers)
    )
    return 0


def _error(flow: Floats, truth: Floats, pixels: NDArray[np.bool_]) -> float:
    """Average endpoint error; a pixel without flow counts as 0 flow."""
    return float(np.linalg.norm(np.nan_to_num(flow[pixels]) - truth[pixels], axis=1).mean())


if __name__ == "__main__":
    sys.exit(main())
