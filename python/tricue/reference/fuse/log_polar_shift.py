# SPDX-License-Identifier: MIT
"""A shift in log-polar coordinates, which is a change of size or a turn."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Plane
from tricue.reference.base.checks import refuse, require_count
from tricue.reference.cues.color.hog_color_cells import hog_color_cells
from tricue.reference.cues.color.pick_pixels import pick_pixels
from tricue.reference.fuse.correlation_response import correlation_response
from tricue.reference.fuse.detail.parabola import parabola_offset

MIN_SHARE = 0.05  # of the maximum: lower bound of a neighbor before its logarithm is taken
MAX_PENALTY = float(np.finfo(np.float32).max)  # infinity times 0 columns isn't a number


def log_polar_shift(
    patch: NDArray[np.uint8],
    places: NDArray[np.int64],
    taper: Plane,
    filter: NDArray[np.complex64],  # noqa: A002
    range: tuple[int, int, float],  # noqa: A002
) -> tuple[float, float]:
    """Calls the twins of its parts, and finds the peak around the middle."""
    max_right, max_down, penalty = range
    require_count("max_right", max_right, 0, (taper.shape[1] - 1) // 2)
    require_count("max_down", max_down, 0, (len(taper) - 1) // 2)
    if not math.isfinite(penalty):
        refuse("penalty", "a finite number", penalty)
    if len(filter) != 1:
        refuse("filter", "one filter", len(filter))
    response = correlation_response(hog_color_cells(pick_pixels(patch, places), taper), filter)[0]
    row, column = len(response) // 2, response.shape[1] // 2
    near = response[row - max_down : row + max_down + 1, column - max_right : column + max_right + 1]
    squares = np.arange(-max_right, max_right + 1, dtype=np.float32) ** 2
    with np.errstate(over="ignore"):
        evidence = near - np.float32(np.clip(penalty, -MAX_PENALTY, MAX_PENALTY)) * squares
    row, column = divmod(int(evidence.argmax()), near.shape[1])
    return column - max_right + gaussian_peak_offset(near[row], column), float(near[row, column])


def gaussian_peak_offset(values: Plane, index: int) -> float:
    """Offset of a peak from the maximum, by a Gaussian: a parabola through the logarithms."""
    if not 0 < index < len(values) - 1 or values[index] <= 0:
        return 0.0
    before, top, after = values[index - 1 : index + 2].tolist()
    return parabola_offset(*(math.log(max(each, MIN_SHARE * top)) for each in (before, top, after)))
