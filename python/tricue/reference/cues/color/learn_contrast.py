# SPDX-License-Identifier: MIT
"""The colors of a target and of its surround, learned from samples in and around an ellipse."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import require_finite, require_shape
from tricue.reference.cues.color.detail.learn_histograms import Cube, learn_histograms
from tricue.reference.cues.color.sample_ellipses import sample_ellipses

UNSEEN = 0.0  # P(target) of a color that neither target nor surround has


def learn_contrast(
    image: NDArray[np.uint8],
    ellipse: Floats,
    pattern: tuple[Floats, Floats],
    target: Cube,
    surround: Cube,
    rate: float,
    rare: float,
) -> tuple[Cube, Cube, Cube]:
    """Samples the ellipse and its surround, and calls learn_histograms."""
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    for name, places in zip(("inside", "around"), pattern, strict=True):
        require_shape(name, places, (len(places), 2))
        require_finite(name, places)
    within, without = (sample_ellipses(image, ellipse[None], places) for places in pattern)
    return learn_histograms(within, without, target, surround, rate, rare, UNSEEN)
