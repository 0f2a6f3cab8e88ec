# SPDX-License-Identifier: MIT
"""The depths of targets in boxes: medians of the depths near the expected one."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

NEAR, FAR = 0.001, 1000.0  # meters; depths outside of these count as not measured
MAD_TO_SIGMA = 1.4826  # from the median absolute deviation to the standard deviation of normal noise
MAX_SAMPLES = 1024


def median_depths(
    depth: Depth, boxes: Floats, samples: int, expected: float, max_offset: float, min_share: float
) -> Floats:
    """Samples one box after the other, and takes the medians of its target's depths."""
    _require_arguments(boxes, samples, expected, max_offset, min_share)
    measured = np.full((len(boxes), 3), np.nan)
    for i, (x, y, width, height) in enumerate(boxes.tolist()):
        square = max(width, height)
        depths = _sample(depth, x - square / 2, y - square / 2, square / samples, samples)
        inside = (depths > np.float32(NEAR)) & (depths < np.float32(FAR))
        center = np.float32(expected)
        if np.isnan(expected):
            counted = inside
            center = np.median(depths[inside]) if inside.any() else center
        else:
            counted = _ellipse(width, height, samples)
        chosen = depths[inside & counted & (np.abs(depths - center) < np.float32(max_offset))]
        if not len(chosen) or len(chosen) < min_share * np.count_nonzero(counted):
            continue
        z = np.median(chosen)
        spread = MAD_TO_SIGMA * float(np.median(np.abs(chosen - z)))
        measured[i] = z, spread, len(chosen) / np.count_nonzero(counted)
    return measured


def _sample(depth: Depth, left: float, top: float, step: float, samples: int) -> Depth:
    """(samples, samples) depths of the pixels under the grid's centers; NaN outside the image."""
    centers = (np.arange(samples) + 0.5) * step
    sampled = np.full((samples, samples), np.nan, np.float32)
    rows, columns = np.floor(top + centers), np.floor(left + centers)
    seen_rows = (rows >= 0) & (rows < depth.shape[0])
    seen_columns = (columns >= 0) & (columns < depth.shape[1])
    seen = rows[seen_rows].astype(int), columns[seen_columns].astype(int)
    sampled[np.ix_(seen_rows, seen_columns)] = depth[np.ix_(*seen)]
    return sampled


def _ellipse(width: float, height: float, samples: int) -> NDArray[np.bool_]:
    """(samples, samples) whether the centers of the grid's squares are in the box's ellipse."""
    offset = np.abs((np.arange(samples) + 0.5) / samples - 0.5) * 2 * max(width, height)
    with np.errstate(over="ignore"):  # for a box that is nearly a line
        return np.add.outer((offset / height) ** 2, (offset / width) ** 2) <= 1


def _require_arguments(
    boxes: Floats, samples: int, expected: float, max_offset: float, min_share: float
) -> None:
    require_shape("boxes", boxes, (len(boxes), 4))
    require_finite("boxes", boxes)
    sizes = boxes[:, 2:]
    if not (sizes > 0).all():
        refuse("boxes", "widths and heights above 0", float(sizes[sizes <= 0][0]))
    if not 1 <= samples <= MAX_SAMPLES:
        refuse("samples", f"1 to {MAX_SAMPLES}", samples)
    if np.isinf(expected):
        refuse("expected", "a finite number or NaN", float(expected))
    if not 0 < max_offset < np.inf:
        refuse("max_offset", "a finite number above 0", float(max_offset))
    if not 0 <= min_share <= 1:
        refuse("min_share", "0 to 1", float(min_share))
