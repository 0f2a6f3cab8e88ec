# SPDX-License-Identifier: MIT
"""Distance of depth histograms (Sabeti, Parvizi, Wu 2008, equation (38))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse, require_finite, require_shape

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]


def depth_distance(
    depth: Depth, rectangles: Floats, model: Floats, pattern: Floats, reach: float, nearer: float
) -> Floats:
    """(N, 3): for each rectangle (x, y, width, height, z) the distance (38), over sqrt 2, of its depths less
    z from the model, 1 where none counts; the share of the places that count; the share nearer than z -
    ``nearer``.

    The places (u, v) of the pattern are in halves of width and height from the centre. What is measured, and
    within ``reach`` of z, counts.
    """
    _require(rectangles, pattern, model, reach, nearer)
    measured = np.empty((len(rectangles), 3))
    levels = len(model)
    for i, (x, y, width, height, z) in enumerate(rectangles):
        columns = np.floor(x + width / 2 * pattern[:, 0])
        rows = np.floor(y + height / 2 * pattern[:, 1])
        seen = _read(depth, rows, columns)
        level = np.floor(((seen - z) + reach) * (levels / (2 * reach)))
        level = level[(level >= 0) & (level < levels)].astype(np.intp)
        histogram = np.bincount(level, minlength=levels) / max(level.size, 1)
        distance = np.sqrt(np.sum((histogram - model) ** 2) / 2) if level.size else 1.0  # (38)
        before = np.count_nonzero(seen < z - nearer)
        measured[i] = min(distance, 1.0), level.size / len(pattern), before / len(pattern)
    return measured


def _read(depth: Depth, rows: Floats, columns: Floats) -> Floats:
    """The depths at the places that are seen: inside the image, and measured."""
    height, width = depth.shape
    inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    seen = depth[rows[inside].astype(np.intp), columns[inside].astype(np.intp)].astype(np.float64)
    measured: Floats = seen[(seen > 0) & (seen < np.inf)]
    return measured


def _require(rectangles: Floats, pattern: Floats, model: Floats, reach: float, nearer: float) -> None:
    require_shape("rectangles", rectangles, (len(rectangles), 5))
    require_shape("pattern", pattern, (len(pattern), 2))
    if len(pattern) < 1:
        refuse("pattern", "at least one place", "none")
    require_finite("rectangles", rectangles)
    _require_model(model)
    if not 0 < reach < np.inf:
        refuse("reach", "a finite number above 0", float(reach))
    require_finite("pattern", pattern)
    if not 0 <= nearer < np.inf:
        refuse("nearer", "a finite number, not negative", float(nearer))


def _require_model(model: Floats) -> None:
    if len(model) < 1:
        refuse("model", "at least one level", "none")
    strange = model[~(np.isfinite(model) & (model >= 0))]
    if strange.size:
        refuse("model", "finite numbers, none negative", float(strange[0]))
    with np.errstate(over="ignore"):
        total = float(model.sum())
    if total != 0 and not abs(total - 1) <= 1e-6:
        refuse("model", "a sum of 1, or of 0", total)
