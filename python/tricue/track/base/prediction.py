# SPDX-License-Identifier: MIT
"""Where a particle filter expects its target next."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Prediction(NamedTuple):
    """p(x' | x) = N(x + drift, diag(scale²)) between lower and upper, (n,) each: n is the state's size."""

    drift: Floats
    scale: Floats
    lower: Floats
    upper: Floats
