# SPDX-License-Identifier: MIT
"""Types that the camera modules share."""

import os

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]
PathLike = str | os.PathLike[str]
Size = tuple[int, int]
"""Width and height of an image, pixels."""
