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
    inside: Floats,
    around: Floats,
    target: Cube,
    surround: Cube,
    rate: float,
    rare: float,
) -> tuple[Cube, Cube, Cube]:
    """Samples both patterns, and calls learn_histograms."""
    require_shape("ellipse", ellipse, (4,))
    require_finite("ellipse", ellipse)
    for name, pattern in (("inside", inside), ("around", around)):
        require_shape(name, pattern, (len(pattern), 2))
        require_finite(name, pattern)
    within, without = (sample_ellipses(image, ellipse[None], pattern) for pattern in (inside, around))
    return learn_histograms(within, without, target, surround, rate, rare, UNSEEN)
