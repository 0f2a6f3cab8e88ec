# SPDX-License-Identifier: MIT
"""Targets that leave and come back: the rates of OxUvA, and precision, recall and F of VOT long-term.

OxUvA (Valmadre et al. 2018) scores a tracker's decision, present or absent. VOT long-term (Lukezic et al.
2018) scores its confidence: a box counts if its score reaches a threshold, and the best threshold gives F.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tricue.arrays import Flags, Floats
from tricue.evaluation.metrics import as_flags, overlaps, share

FOUND_OVERLAP = 0.5
"""The overlap from which on OxUvA counts the target as found (section 4)."""
RESOLUTION = 100
"""Number of thresholds, as in the VOT toolkit."""


class Rates(NamedTuple):
    """Shares in [0, 1]; NaN if there are no such frames."""

    true_positive: float
    """Share of the visible frames reported as present with an overlap of at least FOUND_OVERLAP."""
    true_negative: float
    """Share of the absent frames reported as absent."""


class Frames(NamedTuple):
    """A sequence as the VOT toolkit counts it: arrays with one value per frame."""

    overlaps: Floats
    scores: Floats
    visible: Flags


@dataclass(frozen=True, slots=True, eq=False)
class PrecisionRecall:
    """Arrays with one point per threshold, in [0, 1]; thresholds fall from inf to -inf."""

    thresholds: Floats
    precision: Floats
    """Mean overlap of the frames with a score of at least the threshold; 1 if there are none."""
    recall: Floats
    """Sum of those overlaps divided by the number of visible frames."""

    @property
    def f(self) -> Floats:
        """Harmonic mean of precision and recall at each threshold, 0 where both are 0."""
        total = self.precision + self.recall
        return 2 * self.precision * self.recall / np.where(total > 0, total, 1.0)

    @property
    def best(self) -> "Best":
        """The threshold with the highest F; among equals the highest."""
        index = int(np.argmax(self.f))
        return Best(*(float(each[index]) for each in (self.precision, self.recall, self.f, self.thresholds)))


class Best(NamedTuple):
    """The numbers that VOT long-term reports for a tracker."""

    precision: float
    recall: float
    f: float
    threshold: float


def rates(boxes: ArrayLike, truth: ArrayLike, reported_present: ArrayLike, absent: ArrayLike) -> Rates:
    """OxUvA's rates of a result: boxes and truth are (M, 4), both flags (M,) bool.

    Frames without a true box count as negatives if ``absent`` is true, and are left out otherwise.
    """
    overlap = overlaps(boxes, truth)
    present, gone = (
        as_flags(reported_present, "reported_present", overlap.shape),
        as_flags(absent, "absent", overlap.shape),
    )
    known = ~gone & ~np.isnan(overlap)
    return Rates(share((present & (overlap >= FOUND_OVERLAP))[known]), share(~present[gone]))


def vot_frames(boxes: ArrayLike, truth: ArrayLike, scores: ArrayLike, absent: ArrayLike) -> Frames:
    """A result as the VOT toolkit counts it: boxes and truth are (M, 4), scores and absent (M,).

    The first frame, in which the tracker is started, has overlap 0 and score 0 but counts as visible. In an
    absent frame a box has overlap 0, and no box has overlap 1, since "two empty regions are identical".
    Frames with unknown truth are left out; the toolkit's format can't distinguish them from absent ones.
    """
    overlap = overlaps(boxes, truth)
    score = _values(scores, "scores", len(overlap)).copy()
    gone = as_flags(absent, "absent", overlap.shape)
    known = gone | ~np.isnan(overlap)
    no_box = np.isnan(np.asarray(boxes, dtype=np.float64)).any(axis=1)
    overlap = np.where(gone, no_box.astype(np.float64), overlap)
    overlap[:1], score[:1] = 0.0, 0.0
    return Frames(overlap[known], score[known], ~gone[known])


def precision_recall(sequences: Sequence[Frames]) -> PrecisionRecall:
    """The tracker's curve: the mean of the sequences' curves, with one set of thresholds for all.

    ValueError for a sequence without a visible frame, whose recall isn't defined.
    """
    if not sequences:
        raise ValueError("sequences: expected one or more, got none")
    limits = thresholds(np.concatenate([each.scores for each in sequences]))
    curves = [_curve(*each, limits, index) for index, each in enumerate(sequences)]
    precision, recall = np.mean(curves, axis=0)
    return PrecisionRecall(limits, precision, recall)


def thresholds(scores: ArrayLike, resolution: int = RESOLUTION) -> Floats:
    """At most ``resolution`` thresholds, from inf to -inf, that cut the sorted scores into equal shares.

    The toolkit's ``determine_thresholds``: NaN scores are left out; if there are few scores, all are
    thresholds.
    """
    if resolution < 3:
        raise ValueError(f"resolution: expected 3 or more, got {resolution}")
    values = np.asarray(scores, dtype=np.float64)
    falling = np.sort(values[~np.isnan(values)])[::-1]
    inner = resolution - 2
    if falling.size > inner:
        margin = falling.size // inner
        falling = falling[np.round(np.linspace(margin, falling.size - margin, inner)).astype(int)]
    return np.concatenate([[np.inf], falling, [-np.inf]])


def _curve(
    overlap: Floats, scores: Floats, visible: Flags, limits: Floats, index: int
) -> tuple[Floats, Floats]:
    """Precision and recall of one sequence at each threshold (Lukezic et al. 2018, eq. 1 and 2)."""
    if not visible.any():
        raise ValueError(f"sequences: expected visible frames in each, got none in sequences[{index}]")
    given = scores >= limits[:, None]
    count, total = given.sum(axis=1), given @ overlap
    return np.where(count > 0, total / np.maximum(count, 1), 1.0), total / visible.sum()


def _values(value: ArrayLike, name: str, count: int) -> Floats:
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (count,):
        raise ValueError(f"{name}: expected an array of shape ({count},), got {array.shape}")
    return array
