# SPDX-License-Identifier: MIT
"""The mean gray level of each cell of an image."""

import numpy as np

from tricue.reference.base.arrays import Image
from tricue.reference.base.checks import refuse

WEIGHTS = 3735, 19235, 9798  # of blue, green and red, in parts of 2^15


def reduce_gray(image: Image, step: int, region: tuple[int, int, int, int] | None = None) -> Image:
    """Converts the image to gray in integers, averages cells, and sets those outside the region to 0."""
    height, width = image.shape[:2]
    if not 1 <= step <= min(height, width):
        refuse("step", "1 to the image's smaller side", step)
    gray = image.astype(np.int64)
    if image.ndim == 3:
        gray = (gray @ np.array(WEIGHTS) + 2**14) >> 15
    rows, columns = height // step, width // step
    cells = gray[: rows * step, : columns * step].reshape(rows, step, columns, step).sum(axis=(1, 3))
    mean = (cells + 2) >> 2 if step == 2 else np.rint(cells.astype(np.float32) * np.float32(1 / step**2))
    levels = np.asarray(mean, np.uint8)
    if region is None:
        return levels
    x0, y0, x1, y1 = region
    if not (0 <= x0 <= x1 <= columns and 0 <= y0 <= y1 <= rows):
        refuse("region", f"x0, y0, x1, y1 in order, within {columns} x {rows}", region)
    part = np.zeros_like(levels)
    part[y0:y1, x0:x1] = levels[y0:y1, x0:x1]
    return part
