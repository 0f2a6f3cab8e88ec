# SPDX-License-Identifier: MIT
"""How well score and status separate frames on the target from lost ones, and whether the score is a
probability.
"""

from typing import NamedTuple

import numpy as np
from tricue.evaluation import confidence
from tricue.evaluation.confidence import Reliability

from benchmarks.quality.common.frame_results import Array, Flags, FrameResults

ON_TARGET_OVERLAP = 0.3
"""Above this overlap a frame is on the target; under 0.1 it is lost, and between them it is neither."""
BINS = 10
"""Bins of the score, equally wide."""
MIN_BIN_SHARE = 0.01
"""Share of the frames that a bin needs, to count for the largest deviation."""


class ConfidenceSummary(NamedTuple):
    """Shares in [0, 1] of pooled frames; NaN where no frame counts."""

    lost: float
    """Of the frames with known truth, those with an overlap under 0.1 or without a target."""
    auroc: float
    """The chance that a frame on the target scores above a lost one."""
    tracked_of_lost: float
    """Of the lost frames, those with status TRACKED."""
    untracked_of_on_target: float
    """Of the frames on the target, those with another status than TRACKED."""
    deviation: float
    """The largest difference between mean score and share on the target, over bins of enough frames."""
    calibration_error: float
    """The mean of that difference over all bins, weighted by their frames (expected calibration error)."""


def summarize(frames: FrameResults) -> ConfidenceSummary:
    """The summary of some frames."""
    on_target, lost = _on_target(frames), confidence.lost(frames.overlaps, frames.absent)
    known = lost | ~np.isnan(frames.overlaps)
    either = on_target | lost
    found = reliability(frames)
    shares = found.counts / max(found.counts.sum(), 1)
    deviations = np.abs(found.scores - found.overlaps)
    counted = deviations[shares >= MIN_BIN_SHARE]
    return ConfidenceSummary(
        lost=_share(lost[known]),
        auroc=confidence.auroc(frames.overlaps[either], frames.scores[either], frames.absent[either]),
        tracked_of_lost=_share(frames.tracked[lost]),
        untracked_of_on_target=_share(~frames.tracked[on_target]),
        deviation=float(counted.max()) if counted.size else float("nan"),
        calibration_error=float(np.nansum(shares * deviations)) if counted.size else float("nan"),
    )


def reliability(frames: FrameResults) -> Reliability:
    """By bin of the score: frames, mean score, and, as "overlaps", the share of frames on the target."""
    hits: Array = np.where(np.isnan(frames.overlaps), np.nan, _on_target(frames))
    return confidence.reliability(hits, frames.scores, frames.absent, BINS)


def _on_target(frames: FrameResults) -> Flags:
    flags: Flags = (frames.overlaps > ON_TARGET_OVERLAP) & ~frames.absent
    return flags


def _share(flags: Flags) -> float:
    return float(flags.mean()) if flags.size else float("nan")
