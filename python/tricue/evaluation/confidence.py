# SPDX-License-Identifier: MIT
"""How well a tracker's score predicts its overlap with the truth.

A frame counts as lost if the overlap is below LOST_OVERLAP or the target is absent. Frames whose truth is
unknown (overlap NaN, not absent) are excluded. Only :func:`reliability` needs scores that are probabilities.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.arrays import Flags, Floats
from tricue.evaluation.metrics import as_flags, share

LOST_OVERLAP = 0.1
"""Below this overlap a box counts as off the target."""


class FalselyTracked(NamedTuple):
    """How often a tracker reported TRACKED on a lost frame; NaN if no frame counts."""

    of_lost: float
    """Share of the lost frames."""
    of_all: float
    """The same frames, as a share of all frames with known truth."""


@dataclass(frozen=True, slots=True, eq=False)
class Reliability:
    """The mean overlap at each score: B bins of equal width over the scores [0, 1]."""

    edges: Floats
    """(B + 1,) from 0 to 1; a score on an inner edge belongs to the upper bin."""
    counts: NDArray[np.int64]
    """(B,) frames in each bin."""
    scores: Floats
    """(B,) mean score in each bin, NaN where it is empty."""
    overlaps: Floats
    """(B,) mean overlap in each bin, NaN where it is empty."""


def lost(overlaps: ArrayLike, absent: ArrayLike | None = None, threshold: float = LOST_OVERLAP) -> Flags:
    """(M,) whether each frame is lost: its overlap is below the threshold, or the target is absent.

    overlaps: (M,) in [0, 1]; an unknown one, NaN, isn't below. absent: (M,) bool; None if never.
    """
    overlap = np.asarray(overlaps, dtype=np.float64)
    below: Flags = overlap < threshold
    return below if absent is None else below | as_flags(absent, "absent", overlap.shape)


def auroc(overlaps: ArrayLike, scores: ArrayLike, absent: ArrayLike | None = None) -> float:
    """The probability that a frame on the target scores above a lost one, with ties counted half.

    The area under the ROC curve of "lost" by falling score, by the rank sum of Mann and Whitney (1947). 0.5
    is chance; at 1 a threshold on the score separates both kinds. NaN unless there are frames of both kinds.
    Scores may be any numbers, since only their order counts; NaN is the lowest.
    """
    overlap, score, gone = _frames(overlaps, scores, absent)
    bad = lost(overlap, gone)
    good = int((~bad).sum())
    if good in (0, bad.size):
        return float("nan")
    ordered = np.where(np.isnan(score), -np.inf, score)
    wins = _ranks(ordered)[~bad].sum() - good * (good + 1) / 2
    return float(wins / (good * (bad.size - good)))


def tracked(overlaps: ArrayLike, reported_present: ArrayLike, absent: ArrayLike | None = None) -> float:
    """How often a tracker reported the target as present, (M,) bool: the share of the frames with known
    truth, NaN without any.
    """
    overlap = np.asarray(overlaps, dtype=np.float64)
    present = as_flags(reported_present, "reported_present", overlap.shape)
    return share(present[_known(overlap, lost(overlap, absent))])


def tracked_while_lost(
    overlaps: ArrayLike, reported_present: ArrayLike, absent: ArrayLike | None = None
) -> FalselyTracked:
    """How often a tracker reported the target as present, (M,) bool, in lost frames."""
    overlap = np.asarray(overlaps, dtype=np.float64)
    present = as_flags(reported_present, "reported_present", overlap.shape)
    bad = lost(overlap, absent)
    return FalselyTracked(share(present[bad]), share((present & bad)[_known(overlap, bad)]))


def reliability(
    overlaps: ArrayLike, scores: ArrayLike, absent: ArrayLike | None = None, bins: int = 10
) -> Reliability:
    """Mean overlap by score, for a reliability diagram; in absent frames the overlap is 0.

    ValueError for a score outside [0, 1] in a frame that counts.
    """
    if bins < 1:
        raise ValueError(f"bins: expected 1 or more, got {bins}")
    overlap, score, gone = _frames(overlaps, scores, absent)
    if not np.all((score >= 0) & (score <= 1)):
        raise ValueError("scores: expected numbers in [0, 1]")
    overlap[gone] = 0.0
    edges = np.linspace(0.0, 1.0, bins + 1)
    bin_index = np.searchsorted(edges[1:-1], score, side="right")
    counts = np.bincount(bin_index, minlength=bins)
    frames = np.where(counts > 0, counts, np.nan)
    return Reliability(
        edges,
        counts,
        np.bincount(bin_index, score, bins) / frames,
        np.bincount(bin_index, overlap, bins) / frames,
    )


def _frames(overlaps: ArrayLike, scores: ArrayLike, absent: ArrayLike | None) -> tuple[Floats, Floats, Flags]:
    """Overlaps, scores and absence of the frames with known truth."""
    overlap, score = np.asarray(overlaps, dtype=np.float64), np.asarray(scores, dtype=np.float64)
    if overlap.ndim != 1:
        raise ValueError(f"overlaps: expected an array of shape (M,), got {overlap.shape}")
    if score.shape != overlap.shape:
        raise ValueError(f"scores: expected an array of shape {overlap.shape}, got {score.shape}")
    gone = np.zeros(overlap.shape, bool) if absent is None else as_flags(absent, "absent", overlap.shape)
    known = _known(overlap, gone)
    return overlap[known], score[known], gone[known]


def _known(overlap: Floats, bad: Flags) -> Flags:
    """The frames with known truth. bad: those that are lost, or without the target."""
    known: Flags = bad | ~np.isnan(overlap)
    return known


def _ranks(values: Floats) -> Floats:
    """Ranks from 1; equal values get their mean rank."""
    _, group, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    ranks: Floats = (last - (counts - 1) / 2)[group]
    return ranks
