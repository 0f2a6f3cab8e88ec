# SPDX-License-Identifier: MIT
"""The bin of every pixel in the color space of Moreno et al. 2002, section 3.1."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.detail.color_space import ColorSpace, indices, require_space

NO_BIN = 65535


def color_bins(
    image: NDArray[np.uint8],
    region: tuple[int, int, int, int],
    space: ColorSpace,
    step: int,
    gains: NDArray[np.float64] | None = None,
) -> NDArray[np.uint16]:
    """Reads every step-th pixel inside the image, and computes the bin on each axis in integers."""
    require_space(*space)
    if not 1 <= step <= 1024:
        refuse("step", "1 to 1024", step)
    x0, y0, x1, y1 = region
    for side in (x1 - x0, y1 - y0):
        if side > 32768:
            refuse("region", "sides of at most 32768 pixels", side)
    y, x = np.meshgrid(
        np.arange(y0, y1, step) + step // 2, np.arange(x0, x1, step) + step // 2, indexing="ij"
    )
    inside = (x >= 0) & (x < image.shape[1]) & (y >= 0) & (y < image.shape[0])
    found = np.full(x.shape, NO_BIN, np.uint16)
    colors = image[y[inside], x[inside]]
    if gains is not None:
        strange = gains[~(np.isfinite(gains) & (gains >= 0))]
        if strange.size:
            refuse("gains", "finite numbers, none negative", float(strange[0]))
        colors = np.rint(np.minimum(colors * np.minimum(gains, 255).astype(np.float32), 255)).astype(np.uint8)
    found[inside] = indices(colors, *space)
    return found
