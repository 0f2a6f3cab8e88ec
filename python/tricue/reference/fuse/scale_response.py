# SPDX-License-Identifier: MIT
"""The answer of a correlation filter over scales."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.fuse.correlation_response import require_ridge

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]


def scale_response(looks: Floats, numerator: Complexes, denominator: Floats, ridge: float) -> Floats:
    """Takes the transforms of numpy.fft along the scales."""
    require_scale_filter(looks, numerator, denominator)
    require_ridge(ridge)
    product = (numerator * np.fft.rfft(looks.astype(np.float64), axis=0)).sum(axis=1)
    shrunk = denominator + ridge * max(float(denominator.mean(dtype=np.float64)), 1e-12)
    return np.fft.fftshift(np.fft.irfft(product / shrunk, len(looks))).astype(np.float32)


def require_scale_filter(looks: Floats, numerator: Complexes, denominator: Floats) -> None:
    """Refuse no looks, and a filter that isn't for them."""
    if looks.size < 1:
        refuse("looks", "at least one scale and channel", looks.shape)
    half = (len(looks) // 2 + 1, looks.shape[1])
    if numerator.shape != half:
        refuse("numerator", f"shape {half}", numerator.shape)
    if denominator.shape != half[:1]:
        refuse("denominator", f"shape {half[:1]}", denominator.shape)
