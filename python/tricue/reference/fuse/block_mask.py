# SPDX-License-Identifier: MIT
"""The pixels of the target's blocks (Okada, Shirai, Miura 1996, section 4.4)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import MAX_IMAGE_SIDE, require_count, require_shape
from tricue.reference.fuse.detail.rectangle_pixels import rectangle_pixels


def block_mask(blocks: NDArray[np.float64], height: int, width: int) -> NDArray[np.uint8]:
    """Sets the pixels of one block at a time."""
    for name, size in (("height", height), ("width", width)):
        require_count(name, size, 0, MAX_IMAGE_SIDE)
    require_shape("blocks", blocks, (len(blocks), 4))
    mask = np.zeros((height, width), np.uint8)
    for x0, y0, x1, y1 in blocks:
        mask[rectangle_pixels((x0, y0, x1, y1), mask.shape, "blocks")] = 1
    return mask
