# SPDX-License-Identifier: MIT
"""The most likely window around an ellipse, by its pixels' ranks and its color contrast."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import require_finite, require_shape
from tricue.reference.cues.color.rank_likelihood import ColorAppearance, Factors, Pattern, rank_likelihood


def rank_search(
    image: NDArray[np.uint8],
    ellipse: Floats,
    offsets: Floats,
    pattern: Pattern,
    appearance: ColorAppearance,
    factors: Factors,
) -> tuple[Floats, float, float]:
    """Calls rank_likelihood for all windows, and takes its maximum."""
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    require_shape("offsets", offsets, (len(offsets), 4))
    require_finite("offsets", offsets)
    center, axes = ellipse[:2], ellipse[2:]
    moved = np.concatenate([center + axes * offsets[:, :2], axes * offsets[:, 2:]], axis=1)
    windows = np.concatenate([ellipse[None], moved])
    log_likelihood = rank_likelihood(image, windows, pattern, appearance, factors)
    best = int(np.argmax(log_likelihood))
    return windows[best], float(log_likelihood[best]), float(log_likelihood[0])
