# SPDX-License-Identifier: MIT
"""The pixels of an image at given places: the image in other coordinates."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse


def pick_pixels(image: NDArray[np.uint8], places: NDArray[np.int64]) -> NDArray[np.uint8]:
    """Indexes the flattened image."""
    height, width, _ = image.shape
    if image.size and height > 1 and image.strides[0] != 3 * width:
        refuse("image", "rows without padding", f"{image.strides[0]} bytes a row")
    pixels = height * width
    strange = places[(places < 0) | (places >= pixels)]
    if strange.size:
        refuse("places", f"0 to {pixels - 1}", int(strange.min() if strange.min() < 0 else strange.max()))
    picked: NDArray[np.uint8] = image.reshape(-1, 3)[places]
    return picked
