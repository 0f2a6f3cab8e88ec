# SPDX-License-Identifier: MIT
"""The boundary value of the skin classifier (Sabeti, Parvizi, Wu 2008, equations (4)-(10))."""

import numpy as np
from numpy.typing import NDArray


def skin_boundary(image: NDArray[np.uint8], reference: NDArray[np.uint8]) -> NDArray[np.int16]:
    """Computes both maxima over the channels in integers."""
    colors = image.astype(np.int16)
    delta = np.abs(colors - reference.astype(np.int16)).max(axis=2)  # (5)-(8)
    eta = colors.max(axis=2)  # (9)
    boundary: NDArray[np.int16] = eta - delta  # (10)
    return boundary
