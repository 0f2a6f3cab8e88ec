# SPDX-License-Identifier: MIT
"""Overlap and errors against the truth, summarized as in OTB and TrackingNet.

That is Wu, Lim and Yang 2013, and for the normalized precision Mueller et al. 2018.

Boxes are (M, 4) arrays (x, y, width, height) in pixels, a row per frame. A row of NaN in the truth means a
frame without truth; such frames are excluded from all summaries. A row of NaN in the result means that the
tracker gave no box; it counts as a miss. Curves and thresholds equal those of the got10k toolkit to the last
bit, so that frames exactly on a threshold fall on the same side.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.arrays import Floats

OVERLAP_THRESHOLDS: Floats = np.linspace(0.0, 1.0, 21)
"""OTB's: 0, 0.05, ..., 1."""
PRECISION_THRESHOLDS: Floats = np.arange(51.0)
"""OTB's: 0, 1, ..., 50 px."""
NORM_PRECISION_THRESHOLDS: Floats = np.arange(51) / 100.0
"""TrackingNet's: 0, 0.01, ..., 0.5 of the true box's size."""


@dataclass(frozen=True, slots=True)
class Score:
    """A result in five numbers: shares in [0, 1] and an error in pixels; NaN if no frame has truth."""

    auc: float
    """Area under the success curve, the mean over OVERLAP_THRESHOLDS."""
    precision: float
    """Share of frames whose center error is at most 20 px."""
    norm_precision: float
    """Area under the normalized precision curve, the mean over NORM_PRECISION_THRESHOLDS."""
    success: float
    """Share of frames whose overlap is above 0.5."""
    mean_error: float
    """Mean center error in pixels."""


def overlaps(boxes: ArrayLike, truth: ArrayLike) -> Floats:
    """Intersection over union, row by row, (M,), in [0, 1]; 0 for a missing box, NaN without truth."""
    found, true = _pairs(boxes, truth)
    low = np.maximum(found[:, :2], true[:, :2])
    high = np.minimum(found[:, :2] + found[:, 2:], true[:, :2] + true[:, 2:])
    common = np.prod(np.maximum(high - low, 0.0), axis=1)
    union = np.prod(found[:, 2:], axis=1) + np.prod(true[:, 2:], axis=1) - common
    # got10k adds an epsilon to the union, which rounds away for unions of 4 square pixels or more.
    return _missing(np.minimum(common / union, 1.0), found, true, 0.0)


def center_errors(boxes: ArrayLike, truth: ArrayLike) -> Floats:
    """Distance between the centers, row by row, (M,), pixels; inf for a missing box, NaN without truth."""
    found, true = _pairs(boxes, truth)
    return _missing(_lengths(_centers(found) - _centers(true)), found, true, np.inf)


def normalized_center_errors(boxes: ArrayLike, truth: ArrayLike) -> Floats:
    """As center_errors, with the offset along x divided by the true width, along y by the true height.

    P_norm of Mueller et al. 2018 (eq. 2).
    """
    found, true = _pairs(boxes, truth)
    return _missing(_lengths((_centers(found) - _centers(true)) / true[:, 2:]), found, true, np.inf)


def position_errors(found: ArrayLike, true: ArrayLike) -> Floats:
    """Distance between positions in the camera frame, row by row, (M,), meters; both arguments are (M, 3).

    If the truth has only a depth (x or y is NaN), the error along z. NaN if the truth has no depth or the
    tracker gave no position.
    """
    estimated, known = _positions(found, "found"), _positions(true, "true")
    if estimated.shape != known.shape:
        raise ValueError(f"found: expected as many rows as true ({len(known)}), got {len(estimated)}")
    offset = estimated - known
    return np.where(np.isnan(known[:, :2]).any(axis=1), np.abs(offset[:, 2]), _lengths(offset))


def success_curve(overlap: ArrayLike, thresholds: ArrayLike = OVERLAP_THRESHOLDS) -> Floats:
    """Share of the frames with truth whose overlap is above each threshold; NaN if no frame has truth."""
    return _share(
        np.asarray(overlap, dtype=np.float64), lambda known: known > np.asarray(thresholds)[:, None]
    )


def precision_curve(error: ArrayLike, thresholds: ArrayLike = PRECISION_THRESHOLDS) -> Floats:
    """Share of the frames with truth whose error is at most each threshold; NaN if no frame has truth."""
    return _share(np.asarray(error, dtype=np.float64), lambda known: known <= np.asarray(thresholds)[:, None])


def score(boxes: ArrayLike, truth: ArrayLike) -> Score:
    """Summarize a result: both arguments (M, 4)."""
    overlap, error = overlaps(boxes, truth), center_errors(boxes, truth)
    normalized, known = normalized_center_errors(boxes, truth), error[~np.isnan(error)]
    return Score(
        auc=float(success_curve(overlap).mean()),
        precision=float(precision_curve(error, [20.0])[0]),
        norm_precision=float(precision_curve(normalized, NORM_PRECISION_THRESHOLDS).mean()),
        success=float(success_curve(overlap, [0.5])[0]),
        mean_error=float(known.mean()) if known.size else float("nan"),
    )


def _centers(boxes: Floats) -> Floats:
    """The centers (M, 2) of boxes of whole pixels, half a pixel off the corners' middle, as in OTB's code."""
    center: Floats = boxes[:, :2] + (boxes[:, 2:] - 1) / 2
    return center


def _lengths(vectors: Floats) -> Floats:
    length: Floats = np.sqrt(np.sum(np.power(vectors, 2), axis=1))
    return length


def _share(values: Floats, holds: Callable[[Floats], NDArray[np.bool_]]) -> Floats:
    known = values[~np.isnan(values)]
    passed = holds(known)
    return passed.mean(axis=1) if known.size else np.full(passed.shape[0], np.nan)


def share(flags: NDArray[np.bool_]) -> float:
    """The share of the flags that are set; NaN without any."""
    return float(flags.mean()) if flags.size else float("nan")


def as_flags(value: ArrayLike, name: str, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """An array of flags of that shape; ValueError for anything else."""
    array = np.asarray(value)
    if array.dtype != np.bool_ or array.shape != shape:
        raise ValueError(f"{name}: expected bool of shape {shape}, got {array.dtype} of shape {array.shape}")
    return array


def _missing(values: Floats, found: Floats, true: Floats, miss: float) -> Floats:
    values[np.isnan(found).any(axis=1)] = miss
    values[np.isnan(true).any(axis=1)] = np.nan
    return values


def _pairs(boxes: ArrayLike, truth: ArrayLike) -> tuple[Floats, Floats]:
    found, true = _boxes(boxes, "boxes"), _boxes(truth, "truth")
    if found.shape != true.shape:
        raise ValueError(f"boxes: expected as many rows as truth ({len(true)}), got {len(found)}")
    return found, true


def _boxes(value: ArrayLike, name: str) -> Floats:
    array = np.asarray(value, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 4:
        raise ValueError(f"{name}: expected an array of shape (M, 4), got {array.shape}")
    bad = np.any(array[:, 2:] <= 0, axis=1) | np.any(np.isinf(array), axis=1)
    if bad.any():
        raise ValueError(f"{name}: expected finite boxes with width and height above 0, got {array[bad][0]}")
    return array


def _positions(value: ArrayLike, name: str) -> Floats:
    array = np.asarray(value, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected an array of shape (M, 3), got {array.shape}")
    return array
