# SPDX-License-Identifier: MIT
"""Learning of the filter that localizes a target."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.hog_color_cells import hog_color_cells
from tricue.reference.fuse.regularized_filter import regularized_filter

Complexes = NDArray[np.complex64]


def learn_place_filter(
    patch: NDArray[np.uint8],
    taper: Plane,
    mask: Plane,
    label: Complexes,
    previous: Complexes,
    first: Complexes,
    temporal_weight: float,
    penalty: float,
    first_weight: float,
) -> tuple[Complexes, Complexes]:
    """Calls the twins of its parts, and mixes in the first frame's filter."""
    cells = hog_color_cells(patch, taper)
    expected = (*cells.shape[:2], cells.shape[2] // 2 + 1)
    if first.shape != expected:
        refuse("first", f"shape {expected}", first.shape)
    require_share(first_weight)
    learned = regularized_filter(cells, mask, label, previous, temporal_weight, penalty)
    return learned, np.stack([learned + np.float32(first_weight) * (first - learned), first])


def require_share(share: float) -> None:
    """Refuse a share of the first frame's filter outside [0, 1]."""
    if not 0 <= share <= 1:
        refuse("first_weight", "a number in [0, 1]", float(share))
