# SPDX-License-Identifier: MIT
"""Windows of an image on one grid, smoothed where they have more detail than the grid can hold."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import (
    MAX_IMAGE_SIDE,
    refuse,
    require_count,
    require_finite,
    require_shape,
)

UNIT = 64  # parts of a pixel that places are rounded to: sums of integers have the same bits in any order
MAX_READINGS = 4  # of a sample along each axis; beyond that it skips pixels, so that its cost is bounded


def sample_windows(
    image: NDArray[np.uint8], windows: NDArray[np.float64], rows: int, columns: int
) -> NDArray[np.uint8]:
    """Multiplies each window by the weights of its bilinear readings, rows first."""
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
    """The first pixel of an axis that is read, and (count, pixels) how much each sample has of the
    pixels from there on, in parts of UNIT.
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
