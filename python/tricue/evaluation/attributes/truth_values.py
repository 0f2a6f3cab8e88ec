# SPDX-License-Identifier: MIT
"""Attributes measured from the true boxes and the frame rate: a value for each labeled frame."""

import numpy as np

from tricue.arrays import Floats
from tricue.evaluation.dataset import OpenedSequence


def truth_values(opened: OpenedSequence) -> dict[str, Floats]:
    """Values (M,) by attribute key; NaN without a true box, or where unknown."""
    boxes = opened.boxes[: opened.frames]
    first = boxes[opened.start]
    area = boxes[:, 2] * boxes[:, 3]
    centers = boxes[:, :2] + boxes[:, 2:] / 2
    steps = np.full(len(boxes), np.nan)
    steps[1:] = np.linalg.norm(np.diff(centers, axis=0), axis=1)
    known = opened.source.clock.timed or opened.source.rate is not None
    return {
        "absent": opened.absent(len(boxes)).astype(np.float64),
        "scale": area / (first[2] * first[3]),
        "aspect": boxes[:, 2] / boxes[:, 3] / (first[2] / first[3]),
        "fast": steps,
        "low_rate": np.where(np.isnan(area), np.nan, opened.source.fps if known else np.nan),
        "low_resolution": area,
        "out_of_view": _outside(boxes, opened),
    }


def _outside(boxes: Floats, opened: OpenedSequence) -> Floats:
    """The share of each box outside the image; for clipped boxes 1 if they touch its edge."""
    low, high = boxes[:, :2], boxes[:, :2] + boxes[:, 2:]
    if opened.clipped:
        at_edge = (low <= 0).any(axis=1) | (high >= opened.size).any(axis=1)
        return np.where(np.isnan(boxes).any(axis=1), np.nan, at_edge.astype(np.float64))
    inside = np.clip(high, 0, opened.size) - np.clip(low, 0, opened.size)
    return np.asarray(1 - np.prod(inside, axis=1) / np.prod(boxes[:, 2:], axis=1))
