# SPDX-License-Identifier: MIT
"""The distance between orders of corresponding pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.color_ranks import color_ranks


def rank_distance(samples: NDArray[np.uint8], models: NDArray[np.float32]) -> NDArray[np.float64]:
    """(N, M): twice the mean absolute difference between the ranks of each ellipse and each model (M, 3, n).

    In units of 1/2n a mid-rank is a whole number; the models' ranks are rounded to it.
    """
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
