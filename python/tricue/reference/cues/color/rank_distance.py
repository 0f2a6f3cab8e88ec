# SPDX-License-Identifier: MIT
"""The distance between orders of corresponding pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse
from tricue.reference.cues.color.color_ranks import color_ranks


def rank_distance(samples: NDArray[np.uint8], models: NDArray[np.float32]) -> NDArray[np.float32]:
    """(N, M): twice the mean absolute difference between the ranks of each ellipse and each model (M, 3,
    n).
    """
    ranks = color_ranks(samples)
    if models.shape[1:] != ranks.shape[1:]:
        refuse("models", f"3 x {samples.shape[2]} ranks, as many as samples", models.shape)
    differences = np.abs(ranks[:, None] - models[None])
    return (2 * differences.mean(axis=(2, 3), dtype=np.float64)).astype(np.float32)
