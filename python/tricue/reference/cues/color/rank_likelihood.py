# SPDX-License-Identifier: MIT
"""The color particle tracker's default likelihood: by the pixels' ranks, and by color contrast."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.color.color_lookup import color_lookup
from tricue.reference.cues.color.rank_distance import rank_distance
from tricue.reference.cues.color.sample_ellipses import sample_ellipses


def rank_likelihood(
    image: NDArray[np.uint8],
    ellipses: Floats,
    inside: Floats,
    around: Floats,
    models: NDArray[np.float32],
    shares: Floats,
    nearest: bool,
    table: NDArray[np.float32],
    sharpness: float,
    contrast_weight: float,
) -> Floats:
    """Calls sample_ellipses, rank_distance and color_lookup."""
    for name, pattern in (("inside", inside), ("around", around)):
        if len(pattern) < 1:
            refuse(name, "at least one place", "none")
        require_shape(name, pattern, (len(pattern), 2))
        require_finite(name, pattern)
    if len(models) < 1:
        refuse("models", "at least one rank map", "none")
    require_shape("shares", shares, (len(models),))
    require_finite("shares", shares)
    for name, weight in (("sharpness", sharpness), ("contrast_weight", contrast_weight)):
        if not math.isfinite(weight):
            refuse(name, "a finite number", weight)
    within, without = (sample_ellipses(image, ellipses, pattern) for pattern in (inside, around))
    mean_inside, mean_around = (
        color_lookup(samples, table).mean(axis=1, dtype=np.float64) for samples in (within, without)
    )
    distances = rank_distance(within, models)
    distance = distances.min(axis=1) if nearest else distances @ shares
    log_likelihood: Floats = contrast_weight * (mean_inside - mean_around) - sharpness * distance * distance
    return log_likelihood
