# SPDX-License-Identifier: MIT
"""Array types that the scene modules share."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Picture = NDArray[np.float32]
"""Levels of 255 before rounding, (H, W, 3) BGR or (H, W)."""
