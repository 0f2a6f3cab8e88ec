# SPDX-License-Identifier: MIT
"""The arrays that the modules of the fused tracker exchange."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]  # (H, W, 3) BGR, or (H, W) gray
Plane = NDArray[np.float32]
Floats = NDArray[np.float64]

NO_PLANE: Plane = np.empty((0, 0), np.float32)  # for a cue without evidence
