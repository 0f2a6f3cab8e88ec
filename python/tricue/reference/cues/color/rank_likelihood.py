# SPDX-License-Identifier: MIT
"""The color particle tracker's default likelihood: by the pixels' ranks, and by color contrast."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Singles
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.color.color_lookup import color_lookup
from tricue.reference.cues.color.rank_distance import rank_distance
from tricue.reference.cues.color.sample_ellipses import sample_ellipses

Pattern = tuple[Floats, Floats]
ColorAppearance = tuple[Singles, Floats, bool, Singles]
Factors = tuple[float, float]


def rank_likelihood(
    image: NDArray[np.uint8],
    ellipses: Floats,
    pattern: Pattern,
    appearance: ColorAppearance,
    factors: Factors,
) -> Floats:
    """Calls sample_ellipses, rank_distance and color_lookup."""
    inside, around = pattern
    models, shares, nearest, table = appearance
    sharpness, contrast_weight = factors
    for name, places in (("inside", inside), ("around", around)):
        if len(places) < 1:
            refuse(name, "at least one place", "none")
        require_shape(name, places, (len(places), 2))
        require_finite(name, places)
    if len(models) < 1:
        refuse("models", "at least one rank map", "none")
    require_shape("shares", shares, (len(models),))
    require_finite("shares", shares)
    for name, weight in (("sharpness", sharpness), ("contrast_weight", contrast_weight)):
        if not math.isfinite(weight):
            refuse(name, "a finite number", weight)
    within, without = (sample_ellipses(image, ellipses, places) for places in pattern)
    mean_inside, mean_around = (
        color_lookup(samples, table).mean(axis=1, dtype=np.float64) for samples in (within, without)
    )
    distances = rank_distance(within, models)
    distance = distances.min(axis=1) if nearest else distances @ shares
    log_likelihood: Floats = contrast_weight * (mean_inside - mean_around) - sharpness * distance * distance
    return log_likelihood
