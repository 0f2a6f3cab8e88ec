# SPDX-License-Identifier: MIT
"""Windows of an image, resampled on a grid; averaged where the grid is coarser than the pixels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import (
    MAX_IMAGE_SIDE,
    refuse,
    require_count,
    require_finite,
    require_shape,
)

UNIT = 64  # places are rounded to this fraction of a pixel, so that integer sums are exact in any order
MAX_READINGS = 4  # per sample along each axis; a coarser grid skips pixels, which bounds the cost


def sample_windows(
    image: NDArray[np.uint8], windows: NDArray[np.float64], rows: int, columns: int
) -> NDArray[np.uint8]:
    """Multiplies each window by the weights of its bilinear readings, first along y, then along x."""
    _require_arguments(image, windows, rows, columns)
    height, width = image.shape[:2]
    samples = np.empty((len(windows), rows, columns, *image.shape[2:]), np.uint8)
    for i, (x, y, wide, high) in enumerate(windows.tolist()):
        top, down = _weights(y, high, rows, height)
        left, across = _weights(x, wide, columns, width)
        part = image[top : top + down.shape[1], left : left + across.shape[1]].astype(np.float64)
        blends = (down @ part.reshape(len(part), -1)).reshape(rows, across.shape[1], -1)
        sums = np.einsum("cx,rxk->rck", across, blends, optimize=True)
        whole = down[0].sum() * across[0].sum()
        samples[i] = np.floor(sums / whole + 0.5).reshape(samples.shape[1:])
    return samples


def _weights(start: float, length: float, count: int, size: int) -> tuple[int, NDArray[np.float64]]:
    """The first pixel of an axis that is read, and (count, pixels) the weight, in parts of UNIT, that each
    sample gives to the pixels from there on.
    """
    step = length / count
    readings = int(min(max(np.ceil(step), 1), MAX_READINGS))
    places = start + (np.arange(count * readings) + 0.5) * (step / readings) - 0.5
    fixed = np.floor(np.clip(places, 0, size - 1) * UNIT + 0.5).astype(np.intp)
    low, share = fixed // UNIT, fixed % UNIT
    high = np.minimum(low + 1, size - 1)
    weights = np.zeros((count, high[-1] - low[0] + 1))
    sample = np.repeat(np.arange(count), readings)
    np.add.at(weights, (sample, low - low[0]), UNIT - share)
    np.add.at(weights, (sample, high - low[0]), share)
    return int(low[0]), weights


def _require_arguments(
    image: NDArray[np.uint8], windows: NDArray[np.float64], rows: int, columns: int
) -> None:
    if image.shape[0] < 1 or image.shape[1] < 1:
        refuse("image", "at least one pixel", "none")
    require_shape("windows", windows, (len(windows), 4))
    require_finite("windows", windows)
    sizes = windows[:, 2:]
    if not (sizes > 0).all():
        refuse("windows", "widths and heights above 0", float(sizes[sizes <= 0][0]))
    for name, count in (("rows", rows), ("columns", columns)):
        require_count(name, count, 1, MAX_IMAGE_SIDE)
