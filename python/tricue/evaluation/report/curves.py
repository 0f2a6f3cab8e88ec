# SPDX-License-Identifier: MIT
"""Curves of a tracker on a group of sequences: means over sequences of the means over seeds."""

from collections.abc import Callable, Sequence

import numpy as np

from tricue.arrays import Floats
from tricue.evaluation import confidence, metrics
from tricue.evaluation.evaluate import RunResult


def success(results: Sequence[RunResult]) -> Floats:
    """(21,) share of frames with an overlap above each of metrics.OVERLAP_THRESHOLDS; NaN where unknown."""
    return _mean(results, lambda each: metrics.success_curve(each.scored.overlaps))


def precision(results: Sequence[RunResult]) -> Floats:
    """(51,) share with a center error of at most each of metrics.PRECISION_THRESHOLDS; NaN where unknown."""

    def curve(each: RunResult) -> Floats:
        return metrics.precision_curve(metrics.center_errors(each.scored.boxes, each.scored.truth))

    return _mean(results, curve)


def norm_precision(results: Sequence[RunResult]) -> Floats:
    """(51,) share with a normalized center error of at most each of metrics.NORM_PRECISION_THRESHOLDS; NaN
    where unknown.
    """

    def curve(each: RunResult) -> Floats:
        errors = metrics.normalized_center_errors(each.scored.boxes, each.scored.truth)
        return metrics.precision_curve(errors, metrics.NORM_PRECISION_THRESHOLDS)

    return _mean(results, curve)


def reliability(results: Sequence[RunResult]) -> confidence.Reliability:
    """Reliability over the frames of all the runs."""
    overlaps, scores, absent = (
        np.concatenate([getattr(each.scored, name) for each in results])
        for name in ("overlaps", "scores", "absent")
    )
    return confidence.reliability(overlaps, scores, absent)


def _mean(results: Sequence[RunResult], curve: Callable[[RunResult], Floats]) -> Floats:
    by_sequence: dict[str, list[Floats]] = {}
    for each in results:
        by_sequence.setdefault(each.row.sequence, []).append(curve(each))
    means = np.array([np.mean(curves, axis=0) for curves in by_sequence.values()])
    known = means[~np.isnan(means).any(axis=1)]
    return np.asarray(known.mean(axis=0) if len(known) else np.full(means.shape[1], np.nan))
