# SPDX-License-Identifier: MIT
"""The search around the predicted ellipse for the best match (Moreno et al. 2002, section 3.1)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import Ellipse
from tricue.track.stereo_head.search_region import SearchRegion

Floats = NDArray[np.float64]


class EllipseMatch(NamedTuple):
    """An ellipse, its score, its intersection with the model (1), and its share at the head's depth."""

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
) -> EllipseMatch:
    """The best match around an ellipse.

    histogram: (L,) the model. search: how far the center may move, cells to each side, and up and down.
    """
    across, down = search
    grid = (2 * down + 1, 2 * across + 1, 1)
    measured = k.ellipse_search(
        region.bins, region.to_cells(ellipse, step), grid, histogram, p.ring, region.coherent
    )
    scores = score_matches(measured, p)
    row, column = divmod(int(scores.argmax()), grid[1])
    x, y, minor, major = ellipse
    best = (x + step * (column - across), y + step * (row - down), minor, major)
    intersection, _, coherence, _ = measured[row, column].tolist()
    return EllipseMatch(best, float(scores[row, column]), intersection, coherence)


def score_matches(measured: Floats, p: StereoHeadParams) -> Floats:
    """(...,) scores of what ``ellipse_search`` measures, (..., 4).

    The four are the intersections of ellipse and ring with the model, and the coherent shares of both.
    """
    depth = p.depth_ring * measured[..., 3]
    np.subtract(measured[..., 2], depth, depth)
    depth *= p.depth_weight
    scores: Floats = p.ring_weight * measured[..., 1]
    np.subtract(measured[..., 0], scores, scores)
    scores += depth
    return scores
