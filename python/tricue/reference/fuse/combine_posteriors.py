# SPDX-License-Identifier: MIT
"""P(target | two cues) of every pixel."""

import numpy as np

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse

MIN_SUM = np.float32(1e-9)  # so that contradictory posteriors, 0 and 1, give a finite result


def combine_posteriors(first: Plane, second: Plane) -> Plane:
    """Multiplies the probabilities of both classes for all pixels at once."""
    if second.shape != first.shape:
        refuse("second", f"shape {first.shape}", second.shape)
    target, rest = first * second, (1 - first) * (1 - second)
    combined: Plane = target / np.maximum(rest + target, MIN_SUM)
    return combined
