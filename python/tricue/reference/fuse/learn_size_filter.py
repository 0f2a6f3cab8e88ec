# SPDX-License-Identifier: MIT
"""Learning of the filter that measures a target's size or turn."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.hog_color_cells import hog_color_cells
from tricue.reference.cues.color.pick_pixels import pick_pixels
from tricue.reference.fuse.correlation_train import correlation_train
from tricue.reference.fuse.learn_place_filter import require_share

Complexes = NDArray[np.complex64]
FilterParts = tuple[Complexes, Plane]
MIN_MEAN = 1e-12  # lower bound of a denominator's mean


def learn_size_filter(
    patch: NDArray[np.uint8],
    places: NDArray[np.int64],
    taper: Plane,
    label: Complexes,
    learned: FilterParts,
    first: FilterParts,
    rate: float,
    first_weight: float,
    ridge: float,
) -> tuple[FilterParts, Complexes]:
    """Calls the twins of its parts, blends and divides."""
    require_share(first_weight)
    if not 0 < ridge < math.inf:
        refuse("ridge", "a finite number above 0", float(ridge))
    cells = hog_color_cells(pick_pixels(patch, places), taper)
    half = cells.shape[1], cells.shape[2] // 2 + 1
    shapes = (len(cells), *half), half
    for name, part, shape in zip(("first_numerator", "first_denominator"), first, shapes, strict=True):
        if part.shape != shape:
            refuse(name, f"shape {shape}", part.shape)
    after = correlation_train(cells, label, *learned, rate)
    share = np.float32(first_weight)
    upper, lower = (own + share * (part - own) for own, part in zip(after, first, strict=True))
    least = np.float32(ridge * max(float(lower.mean(dtype=float)), MIN_MEAN))
    return after, (upper / (lower + least))[None]
