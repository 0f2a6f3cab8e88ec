# SPDX-License-Identifier: MIT
"""Overlap and center error against true boxes, summarized as in OTB (Wu, Lim, Yang 2013).

Boxes are (M, 4) arrays (x, y, width, height) in pixels, a row per frame. A row of NaN in the truth says that
the frame has no truth, and such frames are left out of every summary; a row of NaN in the result says that
the tracker gave no box, and counts as a miss.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

OVERLAP_THRESHOLDS: Array = np.arange(21) / 20.0  # OTB's: 0, 0.05, ..., 1


@dataclass(frozen=True, slots=True)
class Score:
    """One result in four numbers: shares in [0, 1], and an error in pixels; NaN where no frame has truth."""

    auc: float
    """Area under the success curve, the mean over OVERLAP_THRESHOLDS."""
    precision: float
    """Share of frames whose center error is at most 20 px."""
    success: float
    """Share of frames whose overlap is above 0.5."""
    mean_error: float
    """Mean center error in pixels."""


def overlaps(boxes: ArrayLike, truth: ArrayLike) -> Array:
    """Intersection over union, row by row, (M,), in [0, 1]; 0 for a missing box, NaN without truth."""
    found, true = _pairs(boxes, truth)
    low = np.maximum(found[:, :2], true[:, :2])
    high = np.minimum(found[:, :2] + found[:, 2:], true[:, :2] + true[:, 2:])
    common = np.prod(np.maximum(high - low, 0.0), axis=1)
    union = np.prod(found[:, 2:], axis=1) + np.prod(true[:, 2:], axis=1) - common
    return _missing(common / union, found, true, 0.0)


def center_errors(boxes: ArrayLike, truth: ArrayLike) -> Array:
    """Distance between the centers, row by row, (M,), pixels; inf for a missing box, NaN without truth."""
    found, true = _pairs(boxes, truth)
    offset = (found[:, :2] + found[:, 2:] / 2) - (true[:, :2] + true[:, 2:] / 2)
    return _missing(np.hypot(offset[:, 0], offset[:, 1]), found, true, np.inf)


def success_curve(overlap: ArrayLike, thresholds: ArrayLike = OVERLAP_THRESHOLDS) -> Array:
    """Share of the frames with truth whose overlap is above each threshold."""
    return _share(
        np.asarray(overlap, dtype=np.float64), lambda known: known > np.asarray(thresholds)[:, None]
    )


def precision_curve(error: ArrayLike, thresholds: ArrayLike) -> Array:
    """Share of the frames with truth whose center error is at most each threshold (pixels)."""
    return _share(np.asarray(error, dtype=np.float64), lambda known: known <= np.asarray(thresholds)[:, None])


def score(boxes: ArrayLike, truth: ArrayLike) -> Score:
    """Summarize a result: both arguments (M, 4)."""
    overlap, error = overlaps(boxes, truth), center_errors(boxes, truth)
    known = error[~np.isnan(error)]
    return Score(
        auc=float(success_curve(overlap).mean()),
        precision=float(precision_curve(error, [20.0])[0]),
        success=float(success_curve(overlap, [0.5])[0]),
        mean_error=float(known.mean()) if known.size else float("nan"),
    )


def _share(values: Array, holds: Callable[[Array], NDArray[np.bool_]]) -> Array:
    known = values[~np.isnan(values)]
    passed = holds(known)
    return passed.mean(axis=1) if known.size else np.full(passed.shape[0], np.nan)


def _missing(values: Array, found: Array, true: Array, miss: float) -> Array:
    values[np.isnan(found).any(axis=1)] = miss
    values[np.isnan(true).any(axis=1)] = np.nan
    return values


def _pairs(boxes: ArrayLike, truth: ArrayLike) -> tuple[Array, Array]:
    found, true = _boxes(boxes, "boxes"), _boxes(truth, "truth")
    if found.shape != true.shape:
        raise ValueError(f"boxes: expected as many rows as truth ({len(true)}), got {len(found)}")
    return found, true


def _boxes(value: ArrayLike, name: str) -> Array:
    array = np.asarray(value, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 4:
        raise ValueError(f"{name}: expected an array of shape (M, 4), got {array.shape}")
    bad = np.any(array[:, 2:] <= 0, axis=1) | np.any(np.isinf(array), axis=1)
    if bad.any():
        raise ValueError(f"{name}: expected finite boxes with width and height above 0, got {array[bad][0]}")
    return array
