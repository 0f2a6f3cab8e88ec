# SPDX-License-Identifier: MIT
"""Depth as VOT's toolkit and the TraX protocol have it: 16-bit millimeters."""

import numpy as np
from numpy.typing import NDArray

MAX_MILLIMETERS = 65535


def to_millimeters(depth: NDArray[np.float32]) -> NDArray[np.uint16]:
    """Meters as millimeters; 0, not measured, where they don't fit."""
    units = np.rint(1000 * depth.astype(np.float64))
    return np.where((units > 0) & (units <= MAX_MILLIMETERS), units, 0).astype(np.uint16)
