# SPDX-License-Identifier: MIT
"""The stereo trackers on recorded stereo pairs, compared with cv2's trackers on the left images.

    python -m benchmarks.quality.stereo_trackers [FOLDER]

The stereo head tracker searches between the distances with disparities of a quarter of the image's width and
of 4 pixels. Its other parameters are the defaults, or those of --params.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
import tricue
from tricue.camera.box import Box
from tricue.camera.rig import StereoRig
from tricue.evaluation import baselines, metrics
from tricue.evaluation.one_pass import AnyTracker, run
from tricue.track.base.track import Status
from tricue.track.stereo_head.params import StereoHeadParams

from benchmarks.quality.common import sequences, stereo_sequences
from benchmarks.quality.common.arguments import bare_parser
from benchmarks.quality.common.stereo_sequences import StereoSequence
from benchmarks.quality.common.tables import markdown

BASELINES = ("CSRT", "KCF", "still-box")
MAX_DISPARITY_SHARE = 0.25
"""Of the image's width, at the nearest distance."""
MIN_DISPARITY = 4.0
"""Pixels, at the farthest distance."""

COLUMNS = (
    *("sequence", "tracker", "TRACKED", "AUC", "mean IoU", "IoU > 0.5", "disparity error", "updates/s"),
)

Maker = Callable[[StereoRig], AnyTracker]


class Row(NamedTuple):
    """A tracker on a sequence: shares of the frames, mean overlap, and the median error of its disparity."""

    sequence: str
    tracker: str
    tracked: float
    auc: float
    iou: float
    success: float
    disparity_error: float
    """Pixels; NaN for a tracker without positions."""
    updates: float
    """Per second."""


def makers(params: StereoHeadParams | None = None) -> dict[str, Maker]:
    """The stereo head tracker with ``params`` or its defaults, flow-depth with both cues and each alone, and
    the baselines that the installed cv2 has.
    """
    known = baselines.available()
    found: dict[str, Maker] = {
        "stereo-head": partial(_head, params or StereoHeadParams()),
        "flow-depth": partial(_flow_depth, ("flow", "disparity")),
        "flow-depth, flow alone": partial(_flow_depth, ("flow",)),
        "flow-depth, disparity alone": partial(_flow_depth, ("disparity",)),
    }
    for name in BASELINES:
        if name in known:
            found[name] = lambda rig, make=known[name]: make(0)  # type: ignore[misc]
    return found


def _head(params: StereoHeadParams, rig: StereoRig) -> AnyTracker:
    product = rig.intrinsics.fx * rig.baseline
    near, far = product / (MAX_DISPARITY_SHARE * rig.intrinsics.width), product / MIN_DISPARITY
    return tricue.StereoHeadTracker(rig=rig, **asdict(replace(params, near=near, far=far)))


def _flow_depth(cues: tuple[str, ...], rig: StereoRig) -> AnyTracker:
    return tricue.FlowDepthTracker(rig=rig, cues=cues)


def measure(name: str, make: Maker, sequence: StereoSequence) -> Row:
    """Run one tracker on one sequence from its first true box."""
    result = run(make(sequence.rig), sequence.frames, Box(*sequence.truth[0].tolist()))
    score = metrics.score(result.boxes, sequence.truth)
    rig = sequence.rig
    errors = np.abs(rig.intrinsics.fx * rig.baseline / result.positions[:, 2] - sequence.disparities)
    return Row(
        sequence.name,
        name,
        result.statuses.count(Status.TRACKED) / len(result.statuses),
        score.auc,
        float(np.nanmean(metrics.overlaps(result.boxes, sequence.truth))),
        score.success,
        float(np.nanmedian(errors)) if np.isfinite(errors).any() else float("nan"),
        result.frames_per_second,
    )


def table(rows: Sequence[Row]) -> str:
    """Markdown, a line per sequence and tracker."""
    lines = []
    for row in rows:
        error = "-" if np.isnan(row.disparity_error) else f"{row.disparity_error:.2f} px"
        shares = f"{row.tracked:.0%}", f"{row.auc:.2f}", f"{row.iou:.2f}", f"{row.success:.0%}"
        lines.append([row.sequence, row.tracker, *shares, error, f"{row.updates:,.0f}"])
    return markdown(COLUMNS, lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print the table; the exit code."""
    parser = bare_parser("stereo_trackers", __doc__)
    parser.add_argument(
        "folder", type=Path, nargs="?", help="of one or more sequences; default in TRICUE_DATA"
    )
    parser.add_argument("--unit", type=float, default=1.0, help="meters, of OpenCV's calibration files")
    parser.add_argument("--params", type=Path, help="stereo-head's parameters, a TOML file")
    options = parser.parse_args(arguments)
    params = None if options.params is None else StereoHeadParams.from_toml(options.params)
    folder = options.folder or sequences.data_folder() / "stereo"
    folders = stereo_sequences.find(folder)
    if not folders:
        parser.error(f"folder: expected stereo sequences with true boxes under {folder}")
    rows = [
        measure(name, make, sequence)
        for found in folders
        for sequence in stereo_sequences.load(found, options.unit)
        for name, make in makers(params).items()
    ]
    print(table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
