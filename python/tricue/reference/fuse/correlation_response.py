# SPDX-License-Identifier: MIT
"""The responses of multi-channel correlation filters."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Singles
from tricue.reference.base.checks import refuse

Complexes = NDArray[np.complex64]


def correlation_response(cells: Singles, filters: Complexes) -> Singles:
    """Computes F⁻¹{sum_k A_k Z_k} with numpy.fft."""
    require_filters(cells, filters)
    spectrum = np.fft.rfft2(cells.astype(np.float64))
    answers = [np.fft.irfft2((each * spectrum).sum(axis=0), cells.shape[1:]) for each in filters]
    return np.fft.fftshift(answers, axes=(1, 2)).astype(np.float32)


def require_filters(cells: Singles, filters: Complexes) -> None:
    """Refuse empty cells, missing filters, and filters of another size than the cells."""
    require_cells(cells)
    channels, rows, columns = cells.shape
    expected = (len(filters), channels, rows, columns // 2 + 1)
    if len(filters) < 1:
        refuse("filters", "at least one filter", filters.shape)
    if filters.shape != expected:
        refuse("filters", f"shape {expected}", filters.shape)


def require_cells(cells: Singles) -> None:
    """Refuse empty cells."""
    if cells.size < 1:
        refuse("cells", "at least one channel and cell", cells.shape)


def require_filter(cells: Singles, numerator: Complexes, denominator: Singles) -> None:
    """Refuse empty cells, and a filter of another size than the cells."""
    require_cells(cells)
    count, rows, columns = cells.shape
    half = (rows, columns // 2 + 1)
    if numerator.shape != (count, *half):
        refuse("numerator", f"shape {(count, *half)}", numerator.shape)
    if denominator.shape != half:
        refuse("denominator", f"shape {half}", denominator.shape)
