# SPDX-License-Identifier: MIT
"""The ranks of the pixels in one ellipse, and Spearman's correlation with rank maps."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Singles
from tricue.reference.base.checks import refuse, require_finite, require_shape
from tricue.reference.cues.color.color_ranks import color_ranks
from tricue.reference.cues.color.sample_ellipses import sample_ellipses


def rank_window(
    image: NDArray[np.uint8], ellipse: Floats, pattern: Floats, models: Singles, flat: float
) -> tuple[Singles, Floats]:
    """Calls sample_ellipses and color_ranks, and computes the correlations in float64."""
    _check(ellipse, pattern, models, flat)
    ranks = color_ranks(sample_ellipses(image, ellipse[None], pattern))[0]
    own = ranks.astype(np.float64)
    even = own.size / 4
    correlations = np.zeros(len(models))
    for m, model in enumerate(models.astype(np.float64)):
        both, *squares = ((a * b).sum() - even for a, b in ((own, model), (own, own), (model, model)))
        if min(squares) > flat:
            correlations[m] = np.clip(both / np.sqrt(squares[0] * squares[1]), 0, 1)
    return ranks, correlations


def _check(ellipse: Floats, pattern: Floats, models: Singles, flat: float) -> None:
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    if len(pattern) < 1:
        refuse("pattern", "at least one place", "none")
    if not flat >= 0:
        refuse("flat", "a number from 0", flat)
    if models.shape[1:] != (3, len(pattern)):
        refuse("models", f"3 x {len(pattern)} ranks, as many as samples", models.shape)
    outside = models[~((models >= 0) & (models <= 1))]
    if outside.size:
        refuse("models", "ranks in [0, 1]", float(outside[0]))
