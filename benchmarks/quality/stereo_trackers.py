# SPDX-License-Identifier: MIT
"""Trackers of pairs beside OpenCV's in the left images: ``python -m benchmarks.quality.compare_stereo``.

The distances between which the stereo head tracker looks for a target are those where a pair's disparity is
a quarter of the image's width and 4 pixels. All other parameters are the defaults, or its of a file.
"""

import argparse
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
from tricue.evaluation.one_pass import Contender, run
from tricue.track.base.track import Status
from tricue.track.stereo_head.params import StereoHeadParams

from benchmarks.quality import sequences, stereo_sequences
from benchmarks.quality.stereo_sequences import StereoSequence

PEERS = ("CSRT", "KCF", "still-box")
WIDEST, NARROWEST = 0.25, 4.0  # of the image's width; pixels of disparity

Maker = Callable[[StereoRig], Contender]


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
    """Tricue's trackers of pairs, the head's with ``params`` or the defaults, flow-depth also by one cue, and
    the installed cv2's peers.
    """
    known = baselines.available()
    found: dict[str, Maker] = {
        "stereo-head": partial(_head, params or StereoHeadParams()),
        "flow-depth": partial(_walker, ("flow", "disparity")),
        "flow-depth, flow alone": partial(_walker, ("flow",)),
        "flow-depth, disparity alone": partial(_walker, ("disparity",)),
    }
    for name in PEERS:
        if name in known:
            found[name] = lambda rig, make=known[name]: make(0)  # type: ignore[misc]
    return found


def _head(params: StereoHeadParams, rig: StereoRig) -> Contender:
    product = rig.intrinsics.fx * rig.baseline
    near, far = product / (WIDEST * rig.intrinsics.width), product / NARROWEST
    return tricue.StereoHeadTracker(rig=rig, **asdict(replace(params, near=near, far=far)))


def _walker(cues: tuple[str, ...], rig: StereoRig) -> Contender:
    return tricue.FlowDepthTracker(rig=rig, cues=cues)


def measure(name: str, make: Maker, sequence: StereoSequence) -> Row:
    """Run one tracker over one sequence from its first true box."""
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
    lines = [
        "| sequence | tracker | TRACKED | AUC | mean IoU | IoU > 0.5 | disparity error | updates/s |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in rows:
        error = "-" if np.isnan(row.disparity_error) else f"{row.disparity_error:.2f} px"
        shares = f"{row.tracked:.0%} | {row.auc:.2f} | {row.iou:.2f} | {row.success:.0%}"
        lines.append(f"| {row.sequence} | {row.tracker} | {shares} | {error} | {row.updates:,.0f} |")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print the table; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.quality.compare_stereo", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", help="a sequence or more; found through TRICUE_DATA")
    parser.add_argument("--unit", type=float, default=1.0, help="metres, of OpenCV's calibration files")
    parser.add_argument("--params", type=Path, help="a file of stereo-head's parameters, TOML")
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
