# SPDX-License-Identifier: MIT
"""How much a tracker's word is worth: what it said in frames in which it had the target, or hadn't."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from tricue.evaluation import confidence, metrics
from tricue.evaluation.one_pass import Run
from tricue.track.base.track import Status

GOOD = 0.5
"""Above this overlap a frame is a good one."""
Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Said:
    """N frames of one or several runs, the first of each included, in which the tracker was told the box."""

    overlaps: Array
    """(N,) NaN where the truth isn't known."""
    absent: Flags
    """(N,) whether nothing of the target is in sight; such frames count as lost, whatever the overlap."""
    scores: Array
    tracked: Flags
    """(N,) whether the status was TRACKED."""
    seconds: Array
    """One per update."""

    @classmethod
    def of(cls, run: Run, boxes: Array, truth: Array, absent: Flags) -> "Said":
        """What a run said; boxes: its boxes as they are to be judged."""
        tracked = np.array([status is Status.TRACKED for status in run.statuses], np.bool_)
        return cls(metrics.overlaps(boxes, truth), absent, run.scores, tracked, run.seconds)

    @classmethod
    def pooled(cls, parts: Sequence["Said"]) -> "Said":
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
        """Share of the lost frames that were called TRACKED."""
        return confidence.said_ok_while_lost(self.overlaps, self.tracked, self.absent).of_lost

    @property
    def doubted_of_good(self) -> float:
        """Share of the good frames that weren't called TRACKED."""
        good = (self.overlaps > GOOD) & ~self.absent
        return float((~self.tracked[good]).mean()) if good.any() else float("nan")

    @property
    def milliseconds(self) -> float:
        """Mean of an update."""
        return float(1e3 * self.seconds.mean())
