# SPDX-License-Identifier: MIT
"""The search around the predicted ellipse for the best match (Moreno et al. 2002, section 3.1)."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse
from tricue.track.stereo_head.search_region import SearchRegion

MIN_COHERENT_CELLS = 8  # with fewer at the head's depth, all of the ellipse's cells count


class EllipseMatch(NamedTuple):
    """An ellipse, its score, its intersection (1) with the model, its share of cells at the head's depth."""

    ellipse: Ellipse
    score: float
    intersection: float
    coherence: float


def search_local(
    k: Kernels,
    region: SearchRegion,
    ellipse: Ellipse,
    histogram: Floats,
    step: int,
    search: tuple[int, int],
    p: StereoHeadParams,
) -> tuple[EllipseMatch, Floats]:
    """The best match around an ellipse, and the histogram (L,) of its colors, C of equation (2).

    histogram: (L,) the model. search: how far the center may move, cells, sideways and up or down. With
    ``learn="coherent"`` only the cells at the head's depth count for the colors. Without any cells the
    colors' histogram is 0; otherwise its sum is 1.
    """
    across, down = search
    cells, grid = region.to_cells(ellipse, step), (2 * down + 1, 2 * across + 1, 1)
    weights = p.ring_weight, p.depth_weight, p.depth_ring
    least = MIN_COHERENT_CELLS if p.learn == "coherent" else 0
    row, column, score, intersection, coherence, colors = k.best_ellipse(
        region.bins, cells, grid, histogram, p.ring, region.coherent, weights, least
    )
    x, y, minor, major = ellipse
    best = (x + step * (column - across), y + step * (row - down), minor, major)
    return EllipseMatch(best, score, intersection, coherence), colors


def score_matches(measured: Floats, p: StereoHeadParams) -> Floats:
    """The scores (...,) of the measurements (..., 4) of ``ellipse_search``.

    The four measurements are the intersections of ellipse and ring with the model, and their coherent shares.
    """
    depth = p.depth_ring * measured[..., 3]
    np.subtract(measured[..., 2], depth, depth)
    depth *= p.depth_weight
    scores: Floats = p.ring_weight * measured[..., 1]
    np.subtract(measured[..., 0], scores, scores)
    scores += depth
    return scores
