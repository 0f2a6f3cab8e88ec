# SPDX-License-Identifier: MIT
"""Types of the arrays that twins exchange: those of ``tricue.arrays``, which a twin can't import."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]  # (H, W, 3) BGR, or (H, W) gray
Plane = NDArray[np.float32]  # (H, W), a value for each pixel
Depth = NDArray[np.float32]  # (H, W) meters, NaN where it wasn't measured
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Flags = NDArray[np.bool_]
