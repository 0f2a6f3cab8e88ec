# SPDX-License-Identifier: MIT
"""What a frame shows of the target, according to its model (Okada, Shirai, Miura 1996, sections 4.1-4.4)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Plane
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.fuse.block_counts import MIN_MEASURED_SHARE, block_counts
from tricue.reference.fuse.detail.block_grid import BlockGrid, placed, require_numbers
from tricue.reference.fuse.detail.rectangle_pixels import Rectangle
from tricue.reference.fuse.target_pixels import target_pixels
from tricue.reference.fuse.temporal_window import temporal_window

Counts = NDArray[np.int64]


def observe_target(
    planes: Sequence[Plane],
    model: tuple[Floats, Sequence[tuple[float, float]], Floats],
    prior: tuple[Rectangle, Rectangle],
    threshold: float,
    clean: tuple[int, float, float],
    disparity: Plane | None,
    grid: BlockGrid,
    states: Counts,
    limits: tuple[float, float, float],
) -> tuple[
    tuple[int, int, int, int], int, NDArray[np.uint8], tuple[Counts, Counts, Counts, Floats, Counts], float
]:
    """Calls the twins of each step."""
    (densities, ranges, alternatives), (target, tolerance, occluder) = model, limits
    require_shape("densities", densities, (len(planes), densities.shape[1]))
    require_shape("alternatives", alternatives, densities.shape)
    if len(ranges) != len(planes):
        refuse("ranges", "as many as planes", len(ranges))
    require_numbers(grid, states, "states")
    found, _ = target_pixels(planes, list(densities), ranges, *prior, threshold, list(alternatives))
    box, count, kept = temporal_window(found, *clean)
    if disparity is not None:
        require_shape("disparity", disparity, kept.shape)
    distances = np.full(kept.shape, np.nan, np.float32) if disparity is None else disparity
    pixels, targets, measured, mean, similar = block_counts(kept, distances, placed(grid), target, tolerance)
    if disparity is None:
        measured = pixels
    mine = (states != 0) & (pixels > 0)
    hidden = mine & (measured >= MIN_MEASURED_SHARE * pixels) & (mean > occluder)
    share = int(np.count_nonzero(hidden)) / max(int(np.count_nonzero(mine)), 1)
    return box, count, kept, (pixels, targets, measured, mean, similar), share
