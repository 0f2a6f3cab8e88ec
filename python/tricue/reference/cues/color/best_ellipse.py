# SPDX-License-Identifier: MIT
"""The best place of an ellipse, and its colors (Moreno et al. 2002, section 3.1)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse
from tricue.reference.base.ellipse_shape import mask_of
from tricue.reference.cues.color.detail.ellipse_counts import count
from tricue.reference.cues.color.detail.search_grid import Grid, places
from tricue.reference.cues.color.ellipse_search import ellipse_search


def best_ellipse(
    bins: NDArray[np.uint16],
    ellipse: Floats,
    grid: Grid,
    model: Floats,
    margin: float,
    mask: NDArray[np.uint8],
    weights: tuple[float, float, float],
    min_marked: int,
) -> tuple[int, int, float, float, float, Floats]:
    """Calls ellipse_search, scores all places, and counts the colors in the best one."""
    for weight in weights:
        if not np.isfinite(weight):
            refuse("weights", "finite numbers", float(weight))
    if min_marked < 0:
        refuse("min_marked", "0 or more", min_marked)
    ring, depth, depth_ring = weights
    inside, around, marked, marked_around = np.moveaxis(
        ellipse_search(bins, ellipse, grid, model, margin, mask), -1, 0
    )
    scores = inside - ring * around + depth * (marked - depth_ring * marked_around)
    best = np.unravel_index(scores.argmax(), scores.shape)
    pixels = mask_of(places(ellipse, grid)[best], bins.shape)
    counts = count(bins, pixels & (mask != 0), model.size)
    if min_marked == 0 or counts.sum() < min_marked:
        counts = count(bins, pixels, model.size)
    row, col = map(int, best)
    found = float(scores[best]), float(inside[best]), float(marked[best])
    return row, col, *found, counts / max(int(counts.sum()), 1)
