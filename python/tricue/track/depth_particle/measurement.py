# SPDX-License-Identifier: MIT
"""A segmented object as a measurement of the target's state, for the likelihood and the proposal."""

from functools import cache
from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats

OBJECT_DEVIATION = np.array([0.05, 0.06, 0.06, 0.06, 0.08])  # meters, of a state taken from an object
DEVIATION_FACTOR = 1.2  # times that deviation, in the likelihood
MAX_OBJECT_COST = 12.0  # nats, for a particle far from the object, since the object may be wrong


class Measurement(NamedTuple):
    """A measured state (5,) and its standard deviations (5,), meters.

    max_cost: the largest cost of a particle far from it, nats.
    """

    state: Floats
    deviation: Floats
    max_cost: float

    @classmethod
    def create(cls, state: Floats, weight: float) -> "Measurement":
        """Measure an object's state. weight: in the log-likelihood, may be 0."""
        return cls(state, *_scale(weight))


NOT_MEASURED = Measurement(np.zeros(5), np.full(5, np.inf), 0.0)


@cache
def _scale(weight: float) -> tuple[Floats, float]:
    """The deviations and the largest cost of an object's state."""
    if weight == 0:
        return NOT_MEASURED.deviation, 0.0
    return DEVIATION_FACTOR * OBJECT_DEVIATION / np.sqrt(weight), weight * MAX_OBJECT_COST
