# SPDX-License-Identifier: MIT
"""The search for a head by histogram intersection (Moreno et al. 2002, equation (1))."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_finite
from tricue.reference.base.ellipse_shape import require_ellipse
from tricue.reference.cues.color.detail.ellipse_counts import NO_BIN, count, masks_of, require_bins
from tricue.reference.cues.color.detail.search_grid import Grid, places, require_grid

Bins = NDArray[np.uint16]


def ellipse_search(
    bins: Bins,
    ellipse: Floats,
    grid: Grid,
    model: Floats,
    margin: float,
    mask: NDArray[np.uint8] | None,
) -> Floats:
    """Counts the colors at every place from scratch, and intersects the histograms with the model."""
    require_ellipse(ellipse, margin)
    require_grid(grid)
    _require_model(model)
    require_bins(bins, model.size)
    if mask is not None and mask.shape != bins.shape:
        refuse("mask", f"shape {bins.shape}", mask.shape)
    marks = np.zeros(bins.shape, np.bool_) if mask is None else mask != 0

    found = np.zeros((*grid[:2], 4))
    for i, row in enumerate(places(ellipse, grid)):
        for j, place in enumerate(row):
            for k, pixels in enumerate(masks_of(place, margin, bins.shape)):
                counts = count(bins, pixels, model.size)
                n = counts.sum()
                if n > 0:
                    found[i, j, k] = np.minimum(counts, n * model / model.sum()).sum() / n
                    found[i, j, 2 + k] = np.count_nonzero(marks & pixels & (bins != NO_BIN)) / n
    return found


def _require_model(model: Floats) -> None:
    if model.size == 0:
        refuse("model", "at least one bin", "none")
    require_finite("model", model)
    if model.min() < 0:
        refuse("model", "no negative number", float(model.min()))
    with np.errstate(over="ignore"):
        total = float(model.sum())
    if not 0 < total < np.inf:
        refuse("model", "a finite sum above 0", total)
