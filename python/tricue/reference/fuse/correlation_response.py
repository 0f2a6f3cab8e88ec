# SPDX-License-Identifier: MIT
"""The answers of correlation filters with many channels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]


def correlation_response(cells: Floats, numerators: Complexes, denominators: Floats, ridge: float) -> Floats:
    """Takes the transforms of numpy.fft, channel by channel: F⁻¹{sum_k A_k Z_k / (B + λ)}."""
    require_filters(cells, numerators, denominators)
    require_ridge(ridge)
    spectrum = np.fft.rfft2(cells.astype(np.float64))
    answers = []
    for numerator, denominator in zip(numerators, denominators, strict=True):
        shrunk = denominator + ridge * max(float(denominator.mean(dtype=np.float64)), 1e-12)
        answer = np.fft.irfft2((numerator * spectrum).sum(axis=0) / shrunk, cells.shape[1:])
        answers.append(np.fft.fftshift(answer))
    return np.array(answers, np.float32)


def require_filters(cells: Floats, numerators: Complexes, denominators: Floats) -> None:
    """Refuse no cells, no filters, and filters that aren't for them."""
    require_cells(cells)
    channels, rows, columns = cells.shape
    count, half = len(numerators), (rows, columns // 2 + 1)
    if count < 1:
        refuse("numerators", "at least one filter", numerators.shape)
    if numerators.shape != (count, channels, *half):
        refuse("numerators", f"shape {(count, channels, *half)}", numerators.shape)
    if denominators.shape != (count, *half):
        refuse("denominators", f"shape {(count, *half)}", denominators.shape)


def require_cells(cells: Floats) -> None:
    """Refuse no cells."""
    if cells.size < 1:
        refuse("cells", "at least one channel and cell", cells.shape)


def require_filter(cells: Floats, numerator: Complexes, denominator: Floats) -> None:
    """Refuse no cells, and a filter that isn't for them."""
    require_cells(cells)
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
