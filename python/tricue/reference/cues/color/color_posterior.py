# SPDX-License-Identifier: MIT
"""Look-up of an image's pixels in a table over colors."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.cues.color.color_lookup import color_lookup


def color_posterior(image: NDArray[np.uint8], table: NDArray[np.float32]) -> NDArray[np.float32]:
    """Calls color_lookup with all pixels as the samples of one ellipse."""
    samples = image.reshape(1, -1, 3).transpose(0, 2, 1)
    return color_lookup(samples, table).reshape(image.shape[:2])
