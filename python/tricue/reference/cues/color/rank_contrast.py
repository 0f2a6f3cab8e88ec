# SPDX-License-Identifier: MIT
"""The default measurement of the color tracker: the order of the pixels, and colors against the surround."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.color_lookup import color_lookup
from tricue.reference.cues.color.rank_distance import rank_distance
from tricue.reference.cues.color.sample_ellipses import sample_ellipses

Floats = NDArray[np.float64]


def rank_contrast(
    image: NDArray[np.uint8],
    ellipses: Floats,
    inside: Floats,
    around: Floats,
    models: NDArray[np.float32],
    table: NDArray[np.float32],
) -> tuple[Floats, Floats]:
    """Joins sample_ellipses, rank_distance and color_lookup."""
    for name, pattern in (("inside", inside), ("around", around)):
        if len(pattern) < 1:
            refuse(name, "at least one place", "none")
    within, without = (sample_ellipses(image, ellipses, pattern) for pattern in (inside, around))
    mean_inside, mean_around = (
        color_lookup(samples, table).mean(axis=1, dtype=np.float64) for samples in (within, without)
    )
    return rank_distance(within, models), mean_inside - mean_around
