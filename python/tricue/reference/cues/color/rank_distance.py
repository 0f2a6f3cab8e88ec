# SPDX-License-Identifier: MIT
"""The distance between the ranks of corresponding pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.color_ranks import color_ranks


def rank_distance(samples: NDArray[np.uint8], models: NDArray[np.float32]) -> NDArray[np.float64]:
    """Compares in units of 1/(2n), in which mid-ranks are whole numbers."""
    n = samples.shape[2]
    ranks = np.rint(color_ranks(samples) * (2 * n)).astype(int)
    if models.shape[1:] != ranks.shape[1:]:
        refuse("models", f"3 x {n} ranks, as many as samples", models.shape)
    outside = models[~((models >= 0) & (models <= 1))]
    if outside.size:
        refuse("models", "ranks in [0, 1]", float(outside[0]))
    expected = (models * np.float32(2 * n) + np.float32(0.5)).astype(int)
    sums = np.abs(ranks[:, None] - expected[None]).sum(axis=(2, 3))
    distances: NDArray[np.float64] = sums / (3.0 * n * n)
    return distances
