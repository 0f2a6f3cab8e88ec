# SPDX-License-Identifier: MIT
"""Results of frames, pooled over runs: overlaps, and how well score and status tell good from lost frames."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from tricue.evaluation import confidence, metrics
from tricue.evaluation.one_pass import Run
from tricue.track.base.track import Status

GOOD_OVERLAP = 0.5
"""Above this overlap a frame is a good one."""
Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class FrameResults:
    """N frames of one or several runs, with the first of each, whose box is given."""

    overlaps: Array
    """(N,) NaN where the truth is unknown."""
    absent: Flags
    """(N,) whether nothing of the target is visible; such frames count as lost, whatever the overlap."""
    scores: Array
    """(N,)"""
    tracked: Flags
    """(N,) whether the status is TRACKED."""
    seconds: Array
    """One per update."""

    @classmethod
    def of(cls, run: Run, boxes: Array, truth: Array, absent: Flags) -> "FrameResults":
        """The frames of a run; boxes: the run's, in the form in which they are compared with the truth."""
        tracked = np.array([status is Status.TRACKED for status in run.statuses], np.bool_)
        return cls(metrics.overlaps(boxes, truth), absent, run.scores, tracked, run.seconds)

    @classmethod
    def pooled(cls, parts: Sequence["FrameResults"]) -> "FrameResults":
        """The frames of all parts, one after the other."""
        return cls(*(np.concatenate([getattr(each, name) for each in parts]) for name in cls.__slots__))

    @property
    def auc(self) -> float:
        """Area under the success curve."""
        return float(metrics.success_curve(self.overlaps).mean())

    @property
    def auroc(self) -> float:
        """The chance that a frame on the target scores above a lost one."""
        return confidence.auroc(self.overlaps, self.scores, self.absent)

    @property
    def lost(self) -> float:
        """Share of the frames with known truth whose overlap is under 0.1, or without a target."""
        bad = confidence.lost(self.overlaps, self.absent)
        return float(bad[bad | ~np.isnan(self.overlaps)].mean())

    @property
    def tracked_of_lost(self) -> float:
        """Share of the lost frames with status TRACKED."""
        return confidence.tracked_while_lost(self.overlaps, self.tracked, self.absent).of_lost

    @property
    def untracked_of_good(self) -> float:
        """Share of the good frames with another status than TRACKED."""
        good = (self.overlaps > GOOD_OVERLAP) & ~self.absent
        return float((~self.tracked[good]).mean()) if good.any() else float("nan")

    @property
    def milliseconds(self) -> float:
        """Mean of an update."""
        return float(1e3 * self.seconds.mean())
