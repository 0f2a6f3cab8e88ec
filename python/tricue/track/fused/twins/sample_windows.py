# SPDX-License-Identifier: MIT
"""Windows of an image on one grid, smoothed where they have more detail than the grid can hold."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse, require_finite, require_shape

MOST_TAPS = 4  # a sample along each axis; beyond that it skips pixels, so that its cost is bounded


def sample_windows(
    image: NDArray[np.uint8], windows: NDArray[np.float64], rows: int, columns: int
) -> NDArray[np.uint8]:
    """(N, rows, columns, 3): windows (N, 4), x, y, width, height in pixels, of an image, its edge repeated.

    A sample is the mean of up to MOST_TAPS by MOST_TAPS evenly spaced bilinear readings of the pixels it
    covers, one a pixel, rounded.
    """
    height, width = image.shape[:2]
    if height < 1 or width < 1:
        refuse("image", "at least one pixel", "none")
    require_shape("windows", windows, (len(windows), 4))
    require_finite("windows", windows)
    samples = np.empty((len(windows), rows, columns, 3), np.uint8)
    for i, (x, y, wide, high) in enumerate(windows.tolist()):
        top, down = _readings(y, high, rows, height)
        left, across = _readings(x, wide, columns, width)
        part = image[top : top + down.shape[1], left : left + across.shape[1]].astype(np.float32)
        halfway = (down @ part.reshape(down.shape[1], -1)).reshape(rows, -1, 3)
        samples[i] = np.rint(np.tensordot(across, halfway, (1, 1)).transpose(1, 0, 2))
    return samples


def _readings(start: float, length: float, count: int, size: int) -> tuple[int, NDArray[np.float32]]:
    """The first pixel that is read, and (count, pixels) how much each sample has of each pixel from there."""
    step = length / count
    taps = int(min(max(np.ceil(step), 1), MOST_TAPS))
    places = start + (np.arange(count * taps) + 0.5) * (step / taps) - 0.5
    places = np.clip(places, 0, size - 1)
    low = np.minimum(places.astype(np.intp), max(size - 2, 0))
    share = places - low
    first, last = int(low[0]), min(int(low[-1]) + 1, size - 1)
    weights = np.zeros((count, last - first + 1))
    sample = np.repeat(np.arange(count), taps)
    np.add.at(weights, (sample, low - first), (1 - share) / taps)
    np.add.at(weights, (sample, np.minimum(low + 1, last) - first), share / taps)
    return first, weights.astype(np.float32)
