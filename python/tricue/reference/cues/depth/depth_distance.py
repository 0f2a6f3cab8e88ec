# SPDX-License-Identifier: MIT
"""Distance of depth histograms (Sabeti, Parvizi, Wu 2008, equation (38))."""

import numpy as np

from tricue.reference.base.arrays import Depth, Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.depth.detail import depth_reader

ReferenceHistogram = tuple[Floats, float]


def depth_distance(
    depth: Depth, rectangles: Floats, model: ReferenceHistogram, pattern: Floats, occluder_margin: float
) -> Floats:
    """Compares the histogram of one rectangle at a time with the model."""
    _require(rectangles, pattern, model, occluder_margin)
    measured = np.empty((len(rectangles), 3))
    histogram, reach = model
    levels = len(histogram)
    for i, rectangle in enumerate(rectangles):
        z, seen = rectangle[4], depth_reader.read(depth, rectangle, pattern)
        counts = depth_reader.count(seen, z, levels, reach)
        counted = counts.sum()
        distance = np.sqrt(np.sum((counts / counted - histogram) ** 2) / 2) if counted else 1.0  # (38)
        before = np.count_nonzero(seen < z - occluder_margin)
        measured[i] = min(distance, 1.0), counted / len(pattern), before / len(pattern)
    return measured


def _require(rectangles: Floats, pattern: Floats, model: ReferenceHistogram, occluder_margin: float) -> None:
    histogram, reach = model
    require_shape("rectangles", rectangles, (len(rectangles), 5))
    require_finite("rectangles", rectangles)
    depth_reader.require(pattern, reach)
    if not 0 <= occluder_margin < np.inf:
        refuse("occluder_margin", "a finite number, not negative", float(occluder_margin))
    _require_model(histogram)


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
