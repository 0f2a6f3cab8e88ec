# SPDX-License-Identifier: MIT
"""Results of frames, pooled over runs: overlaps, scores, statuses, times."""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray
from tricue.evaluation import confidence, metrics
from tricue.evaluation.one_pass import Run
from tricue.track.base.track import Status

from benchmarks.quality.common.tables import mean

GOOD_OVERLAP = 0.5
"""Above this overlap a frame is a good one."""
Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class FrameResults:
    """N frames of one or several runs, including the first of each, whose box is given."""

    overlaps: Array
    """(N,) overlaps with the true boxes, NaN where these are unknown."""
    absent: Flags
    """(N,) whether nothing of the target is visible; such frames count as lost, whatever the overlap."""
    scores: Array
    """(N,) the tracks' scores."""
    tracked: Flags
    """(N,) whether the status is TRACKED."""
    seconds: Array
    """(N,) times of the updates, NaN in the first frame of a run and where the tracker had failed."""
    depth_errors: Array
    """(N,) meters, the position's z minus the true one; NaN where either is unknown."""
    depth_sigmas: Array
    """(N,) meters, the standard deviation of z by the track's covariance; NaN without one."""

    @classmethod
    def of(
        cls, run: Run, boxes: Array, truth: Array, absent: Flags, depths: Array | None = None
    ) -> "FrameResults":
        """The frames of a run. boxes: the run's, in the form that is compared with the truth.
        depths: (N,) the target's true z, meters, NaN where unknown; None if all are.
        """
        tracked = np.array([status is Status.TRACKED for status in run.statuses], np.bool_)
        seconds = np.full(len(run.statuses), np.nan)
        seconds[1 : 1 + len(run.seconds)] = run.seconds
        overlaps, sigmas = metrics.overlaps(boxes, truth), np.sqrt(run.covariances[:, 2, 2])
        errors = run.positions[:, 2] - (np.nan if depths is None else depths)
        return cls(overlaps, absent, run.scores, tracked, seconds, errors, sigmas)

    @classmethod
    def pooled(cls, parts: Sequence["FrameResults"]) -> "FrameResults":
        """The frames of all parts, one after the other."""
        return cls(*(np.concatenate([getattr(each, field.name) for each in parts]) for field in fields(cls)))

    @property
    def auc(self) -> float:
        """Area under the success curve."""
        return float(metrics.success_curve(self.overlaps).mean())

    @property
    def mean_overlap(self) -> float:
        """The mean overlap over the frames with known truth."""
        return mean(self.overlaps)

    @property
    def auroc(self) -> float:
        """The chance that a frame on the target scores above a lost one."""
        return confidence.auroc(self.overlaps, self.scores, self.absent)

    @property
    def milliseconds(self) -> float:
        """The mean time of an update."""
        return float(1e3 * np.nanmean(self.seconds))
