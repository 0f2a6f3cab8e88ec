# SPDX-License-Identifier: MIT
"""The answer of a correlation filter with many channels."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.checks import refuse


def correlation_response(
    cells: NDArray[np.float32],
    numerator: NDArray[np.complex64],
    denominator: NDArray[np.float32],
    ridge: float,
) -> NDArray[np.float32]:
    """(R, C), no shift at (R // 2, C // 2): how much the cells (K, R, C), shifted, look as those learnt.

    Bolme et al. 2010, Danelljan et al. 2014 (6): F⁻¹{sum_k A_k Z_k / (B + λ)}, of the numerators
    (K, R, C // 2 + 1) and the common denominator (R, C // 2 + 1); λ is ridge times B's mean.
    """
    count, rows, columns = cells.shape
    half = (rows, columns // 2 + 1)
    if numerator.shape != (count, *half):
        refuse("numerator", f"shape {(count, *half)}", numerator.shape)
    if denominator.shape != half:
        refuse("denominator", f"shape {half}", denominator.shape)
    if not ridge > 0:
        refuse("ridge", "a number above 0", float(ridge))
    product = (numerator * np.fft.rfft2(cells)).sum(axis=0)
    answer = np.fft.irfft2(
        product / (denominator + ridge * max(float(denominator.mean()), 1e-12)), (rows, columns)
    )
    return np.fft.fftshift(answer).astype(np.float32)
