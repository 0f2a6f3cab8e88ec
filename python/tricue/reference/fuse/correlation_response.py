# SPDX-License-Identifier: MIT
"""The answer of a correlation filter with many channels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]


def correlation_response(cells: Floats, numerator: Complexes, denominator: Floats, ridge: float) -> Floats:
    """(R, C), no shift at (R // 2, C // 2): how much the cells (K, R, C), shifted, look as those learnt.

    Danelljan et al. 2014 (6), Bolme et al. 2010: F⁻¹{sum_k A_k Z_k / (B + λ)}, of the numerators
    (K, R, C // 2 + 1) and the common denominator (R, C // 2 + 1); λ is ridge times B's mean.
    """
    require_filter(cells, numerator, denominator)
    require_ridge(ridge)
    spectrum = np.fft.rfft2(cells.astype(np.float64))
    shrunk = denominator + ridge * max(float(denominator.mean(dtype=np.float64)), 1e-12)
    answer = np.fft.irfft2((numerator * spectrum).sum(axis=0) / shrunk, cells.shape[1:])
    return np.fft.fftshift(answer).astype(np.float32)


def require_filter(cells: Floats, numerator: Complexes, denominator: Floats) -> None:
    """Refuse no cells, and a filter that isn't for them."""
    if cells.size < 1:
        refuse("cells", "at least one channel and cell", cells.shape)
    count, rows, columns = cells.shape
    half = (rows, columns // 2 + 1)
    if numerator.shape != (count, *half):
        refuse("numerator", f"shape {(count, *half)}", numerator.shape)
    if denominator.shape != half:
        refuse("denominator", f"shape {half}", denominator.shape)


def require_ridge(ridge: float) -> None:
    """Refuse what doesn't keep a division from nothing."""
    if not 0 < ridge < np.inf:
        refuse("ridge", "a finite number above 0", float(ridge))
