# SPDX-License-Identifier: MIT
"""Depth in the units of the VOT toolkit and the TraX protocol: 16-bit millimeters."""

import numpy as np
from numpy.typing import NDArray

MAX_MILLIMETERS = 65535


def to_millimeters(depth: NDArray[np.float32]) -> NDArray[np.uint16]:
    """Meters as millimeters; 0 (not measured) where they don't fit into 16 bits."""
    units = np.rint(1000 * depth.astype(np.float64))
    return np.where((units > 0) & (units <= MAX_MILLIMETERS), units, 0).astype(np.uint16)
