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
MIN_MEAN = 1e-12  # lower bound of a denominator's mean


def learn_size_filter(
    patch: NDArray[np.uint8],
    places: NDArray[np.int64],
    taper: Plane,
    label: Complexes,
    numerator: Complexes,
    denominator: Plane,
    first_numerator: Complexes,
    first_denominator: Plane,
    rate: float,
    first_weight: float,
    ridge: float,
) -> tuple[Complexes, Plane, Complexes]:
    """Calls the twins of its parts, blends and divides."""
    require_share(first_weight)
    if not 0 < ridge < math.inf:
        refuse("ridge", "a finite number above 0", float(ridge))
    cells = hog_color_cells(pick_pixels(patch, places), taper)
    half = cells.shape[1], cells.shape[2] // 2 + 1
    if first_numerator.shape != (len(cells), *half):
        refuse("first_numerator", f"shape {(len(cells), *half)}", first_numerator.shape)
    if first_denominator.shape != half:
        refuse("first_denominator", f"shape {half}", first_denominator.shape)
    learned = correlation_train(cells, label, numerator, denominator, rate)
    upper, lower = (
        own + np.float32(first_weight) * (first - own)
        for own, first in zip(learned, (first_numerator, first_denominator), strict=True)
    )
    least = np.float32(ridge * max(float(lower.mean(dtype=float)), MIN_MEAN))
    return *learned, (upper / (lower + least))[None]
