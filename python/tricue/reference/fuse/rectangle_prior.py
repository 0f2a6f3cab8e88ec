# SPDX-License-Identifier: MIT
"""The prior of rectangles: by the target's mean size and a measured state."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite, require_shape

MeanSize = tuple[Floats, Floats]
MeasuredState = tuple[Floats, Floats, float]


def rectangle_prior(states: Floats, mean_size: MeanSize, measured: MeasuredState) -> Floats:
    """Sums the squared deviations of the sizes and of the states."""
    _require(states, mean_size, measured)
    (size, spread), (state, deviation, max_cost) = mean_size, measured
    off = np.log(states[:, -2:] / size) / spread
    with np.errstate(over="ignore"):
        away = (((states - state) / deviation) ** 2).sum(axis=1)
    prior: Floats = -(off**2).sum(axis=1) / 2 - np.minimum(away / 2, max_cost)
    return prior


def _require(states: Floats, mean_size: MeanSize, measured: MeasuredState) -> None:
    (size, spread), (state, deviation, max_cost) = mean_size, measured
    dimensions = states.shape[1]
    if dimensions < 2:
        refuse("states", "2 columns or more", dimensions)
    require_finite("states", states)
    _require_positive("states", "sizes above 0", states[:, -2:])
    for name, values in (("size", size), ("spread", spread)):
        require_shape(name, values, (2,))
        require_finite(name, values)
        _require_positive(name, "numbers above 0", values)
    require_shape("state", state, (dimensions,))
    require_finite("state", state)
    require_shape("deviation", deviation, (dimensions,))
    _require_positive("deviation", "numbers above 0", deviation)
    if not max_cost >= 0:
        refuse("max_cost", "a number of at least 0", float(max_cost))


def _require_positive(name: str, expected: str, values: Floats) -> None:
    strange = values[~(values > 0)]
    if strange.size:
        refuse(name, expected, float(strange.flat[0]))
