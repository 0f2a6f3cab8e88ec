# SPDX-License-Identifier: MIT
"""A table over the colors of an image."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.cues.color.color_lookup import color_lookup


def color_posterior(image: NDArray[np.uint8], table: NDArray[np.float32]) -> NDArray[np.float32]:
    """Takes the image for the samples of one ellipse."""
    samples = image.reshape(1, -1, 3).transpose(0, 2, 1)
    return color_lookup(samples, table).reshape(image.shape[:2])
